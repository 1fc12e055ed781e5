"""Lines of the whole core to break: how its parts are put together, which no unit's bench sees."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType

from verif.core import cases
from verif.core.cases import ONE, STEPPED, THREE, Case
from verif.env.run import Outcome
from verif.env.simulators import Simulator
from verif.env.unit import Break

_SEED = 1
_EXAMPLES = 50

RUNS: Mapping[str, Case] = MappingProxyType(
    {
        "pictures": Case("pictures", ONE, share=0.2, scenes=200),
        "frames": Case("frames", ONE, share=0.3),
        "faults": Case("faults", ONE, share=0.3),
        "corrupt": Case("corrupt", ONE),
        "resets": Case("resets", ONE),
        "rooms": Case("rooms", ONE, share=0.3),
        "streams": Case("streams", ONE, share=0.3),
        "many units": Case("pictures", THREE, share=0.2, scenes=100),
        "many pixels": Case("rooms", STEPPED, share=0.1),
    }
)
"""What `Break.set` names: the run that must fail. Small builds, but where it takes a large one."""

_TOP = "raytracer.v"
_TRACE = "trace/trace_unit.v"

BREAKS = (
    # Rays: no place for transmitted ones, none for what does not come back, a triangle never met by
    # primary rays, normals of triangles traced as rays.
    Break(_TOP, "({1'b0, reflects} + {1'b0, transmits}),", "({1'b0, reflects}),", "rooms"),
    Break(_TOP, ".settle_count (settle_count),", ".settle_count ({1'b0, settle_count[0]}),", "pictures"),
    Break(
        _TOP, "{primary_slot, {OBJECT_W + 1{1'b0}},", "{primary_slot, {1'b1, {OBJECT_W{1'b0}}},", "pictures"
    ),
    Break(
        _TOP, "unit_valid && !unit_is_basis && !unit_is_edges)", "unit_valid && !unit_is_basis)", "pictures"
    ),
    # Slots: one is taken that has no room for its ray; too few bits for the work of a pixel.
    Break(_TOP, ".slot_ready(slot_ready && room),", ".slot_ready(slot_ready),", "many pixels"),
    Break(_TOP, "COUNT_W = MAX_DEPTH + LIGHT_COUNT_W + 2;", "COUNT_W = 3;", "rooms"),
    # Registers: the depth of the next frame, the size of the next frame; go.
    Break(_TOP, ".max_depth     (depth_reg),", ".max_depth     (depth),", "frames"),
    Break(_TOP, "        if (size_lock) begin", "        if (swap) begin", "frames"),
    Break("control.v", "if (waiting_reg && go)", "if (waiting_reg)", "frames"),
    Break("control.v", "if (rst || swap) waiting_reg", "if (swap) waiting_reg", "faults"),
    # Counters: rays that are sent for rays that are born.
    Break(_TOP, ".secondary      (child_valid),", ".secondary      (ray_valid && ray_ready),", "pictures"),
    # Shading: light where there is none, places not given back, ambient light in every step.
    Break("shade/shader.v", "step_hit && step < lights,", "step_hit,", "pictures"),
    Break("shade/shader.v", "assign shadow_back = {1'b0, plain_valid} +", "assign shadow_back =", "pictures"),
    Break("shade/children.v", "transmits && !turned_branching}", "1'b0}", "pictures"),
    Break("shade/lighting.v", "end_first ? end_local : {3 * SHADE_W{1'b0}}", "end_local", "pictures"),
    # Tests: equal distances, the triangle that a ray starts on, what belongs to a shadow ray's term.
    Break(_TRACE, "found_distance < nearest_reg", "found_distance <= nearest_reg", "pictures"),
    Break(_TRACE, "wire skip_next = own_reg ==", "wire skip_next = 1'b0 && own_reg ==", "pictures"),
    Break(_TRACE, "wire blank = test_void_reg || row_dead;", "wire blank = test_void_reg;", "pictures"),
    # Two rays in one trace unit; a term that is offered and not taken.
    Break("trace/dispatch.v", "left = ray_free & ~shadow_start;", "left = ray_free;", "many units"),
    Break(
        "flow/merge.v",
        "assign in_ready  = grant & {PORTS{free}};",
        "assign in_ready  = in_valid;",
        "many units",
    ),
    # Frames: a sphere's kind is not looked at; a frame that ends in its last fields is waited for.
    Break(
        "scene/loader.v",
        "if (field[0] != (section_reg == S_TRIANGLE))",
        "if (!field[0] && section_reg == S_TRIANGLE)",
        "corrupt",
    ),
    Break(
        "scene/loader.v",
        "starved = reading && lacking;",
        "starved = reading && lacking && section_reg != S_TAIL;",
        "corrupt",
    ),
    # Reset: one state does not see it.
    Break(
        "control.v",
        "if (rst) state_reg <= S_IDLE;",
        "if (rst && state_reg != S_START_CAMERA) state_reg <= S_IDLE;",
        "resets",
    ),
    # Pixels: present where they are not; a reset that leaves one behind.
    Break("pixel/pixel_queue.v", "if (rst) present_reg <=", "if (1'b0) present_reg <=", "faults"),
)


@dataclass(frozen=True)
class _Core:
    """The whole core; each break names the bench that must notice."""

    name: str = "core"

    @property
    def breaks(self) -> Sequence[Break]:
        return BREAKS

    def run(
        self,
        change: Break,
        replacements: Mapping[Path, str],
        run_name: str,
        simulator: Simulator,
        shrink: bool,
    ) -> Outcome:
        case = RUNS[change.set]
        return cases.simulate(
            replace(case, design=replace(case.design, simulator=simulator)),
            seed=_SEED,
            examples=_EXAMPLES,
            replacements=replacements,
            run_name=run_name,
            shrink=shrink,
        )


SUBJECT = _Core()
