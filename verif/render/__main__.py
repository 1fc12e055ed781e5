"""`make render`: draws a scene through the RTL and shows that every pixel is right.

Exit codes: 0 every pixel is the model's; 1 a pixel is not, or the simulation failed; 2 the request or
the scene is wrong, or a tool is missing, and nothing was written.
"""

import argparse
import json
import shutil
import sys
import tempfile
from collections import Counter
from pathlib import Path

from models import images
from models.core import trace_pixel
from models.limits import Fault
from models.scene.errors import SceneError
from verif.core import probe
from verif.core.builds import core_build
from verif.core.job import Job, RequestError, request
from verif.env.build import BuildError, ensure
from verif.env.simulators import MissingTool
from verif.render.compare import Expected, Summary, expect, summarise, wrong_pixels
from verif.render.simulate import Drawn, SimulationError, simulate

_GAIN = 32
_DEFAULT_SCENE = "models/scenes/three_spheres.toml"


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="make render", description=__doc__)
    parser.add_argument("--scene", default=_DEFAULT_SCENE, help="scene file: .toml, .nff or .hex")
    parser.add_argument("--size", help="WxH; without it the scene's own, or 512x512")
    parser.add_argument("--out", help="folder of the pictures; without it build/render/<scene>")
    parser.add_argument("--sim", default="verilator", help="verilator or icarus")
    parser.add_argument("--build", help="build of the core; without it the first that holds the scene")
    parser.add_argument("--depth", help="depth of the deepest ray; without it 5, all that the core traces")
    parser.add_argument("--pixel", help="x,y: explains this pixel, event by event, and draws no picture")
    return parser.parse_args()


def _say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def _simulate(job: Job, expected: Expected, pixel: tuple[int, int] | None) -> Drawn:
    size = f"{job.view.width}x{job.view.height}"
    name = f"render-{job.name}-{size}-{job.build}-{job.depth}-{job.simulator}"
    with tempfile.TemporaryDirectory() as scratch:
        build = core_build(job.build, job.simulator)
        drawn = simulate(
            build, job.frame, job.registers, name, Path(scratch), pixel, expected.clocks_per_pixel
        )
    if drawn.fault:
        raise SimulationError(f"the core refused the frame: {Fault(drawn.fault).name}")
    return drawn


def _explain(job: Job, expected: Expected, pixel: tuple[int, int]) -> bool:
    """Prints the events of one pixel; True where RTL and model agree in all of them."""
    drawn = _simulate(job, expected, pixel)
    rtl = probe.read(drawn.directory / probe.LOG, job.formats)
    model = trace_pixel(job.file.scene, job.registers, job.formats, *pixel)
    print(f"pixel {pixel[0]},{pixel[1]} of {job.file.path}, build {job.build}:")
    print("\n".join(probe.table(job.formats, rtl, model)))
    return Counter(rtl) == Counter(model)


def _write(job: Job, drawn: Drawn, expected: Expected, summary: Summary) -> None:
    """All files or none: they are made beside the folder and moved into it."""
    job.out.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=job.out.parent) as scratch:
        made = Path(scratch)
        pictures = {
            "rtl.png": drawn.rgb,
            "model.png": expected.model.rgb,
            "reference.png": expected.reference.rgb,
            "difference.png": images.difference(drawn.rgb, expected.reference.rgb, _GAIN),
        }
        for name, picture in pictures.items():
            images.save_png(made / name, picture)
        (made / "frame.hex").write_text(job.frame.to_hex(f"{job.name}, for $readmemh"))
        (made / "summary.json").write_text(json.dumps(summary.as_dict(), indent=2) + "\n")
        job.out.mkdir(exist_ok=True)
        for path in made.iterdir():
            shutil.move(path, job.out / path.name)


def _table(summary: Summary, out: Path) -> str:
    psnr = "equal" if summary.psnr_db is None else f"{summary.psnr_db:.2f} dB"
    rows = {
        "picture": f"{summary.width} x {summary.height}, {out / 'rtl.png'}",
        "RTL against bit-exact model": f"{summary.mismatched_pixels} of {summary.pixels} pixels differ",
        "RTL against reference": f"{psnr}, {summary.hit_mismatch_percent:.4f} % other hits",
        "worst pixel": str(summary.worst_pixels[0]) if summary.worst_pixels else "none",
        "cycles": f"{summary.cycles}, {summary.cycles_per_pixel:.3f} a pixel",
        "rays": f"{summary.primary_rays} primary, {summary.secondary_rays} secondary, "
        f"{summary.shadow_rays} shadow",
        "tests": f"{summary.tests}, {100 * summary.utilisation:.1f} % of {summary.units} units' clocks",
        "simulation": f"{summary.simulation_seconds:.2f} s, {summary.pixels_per_second:.0f} pixels/s, "
        f"{summary.simulator}",
        "bit-exact model": f"{summary.model_seconds:.2f} s",
    }
    return "\n".join(f"{name:<28} {value}" for name, value in rows.items())


def _draw(job: Job) -> bool:
    """The whole picture; True where every pixel is the model's."""
    for note in job.file.notes:
        _say(f"note: {note}")
    _say(f"{job.file.path}: {job.view.width} x {job.view.height}, build {job.build}")
    build = core_build(job.build, job.simulator)
    if not build.ready:
        _say(f"  building the core for {job.simulator}, once ...")
    ensure(build)
    expected = expect(job)
    drawn = _simulate(job, expected, None)
    summary = summarise(job, drawn, expected)
    _write(job, drawn, expected, summary)
    print(_table(summary, job.out))
    wrong = wrong_pixels(drawn, expected)
    if wrong:
        x, y = wrong[0]
        print(f"\nfirst wrong pixel {x},{y}: RTL {drawn.rgb[y, x]}, model {expected.model.rgb[y, x]}")
        _explain(job, expected, wrong[0])
        print(f"again: {job.command(wrong[0])}")
    return not wrong


def main() -> int:
    """Command line; see the module's docstring."""
    words = _arguments()
    try:
        job = request(words.scene, words.size, words.out, words.sim, words.build, words.pixel, words.depth)
    except (SceneError, RequestError, MissingTool) as error:
        _say(str(error))
        return 2
    try:
        right = _draw(job) if job.pixel is None else _explain(job, expect(job), job.pixel)
    except (SimulationError, BuildError) as error:
        _say(str(error))
        return 1
    except KeyboardInterrupt:
        _say("interrupted; nothing was written")
        return 130
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
