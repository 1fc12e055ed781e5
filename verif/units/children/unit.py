"""The secondary rays of a hit: the core's size, and few objects with many lights in the book's formats."""

from models.formats import BUILDS, Knobs, formats
from models.header import defines
from models.limits import MIN_WEIGHT
from verif.env.unit import Break, Unit

_FILE = "shade/children.v"
_SMALL = {"OBJECTS": 3, "OBJECT_W": 2, "SLOT_W": 4, "LIGHT_W": 4, "COUNT_W": 6, "MIN_WEIGHT": 512}

UNIT = Unit(
    name="children",
    top="children_harness",
    parameters={
        "OBJECTS": 18,
        "OBJECT_W": 5,
        "SLOT_W": 9,
        "DEPTH_W": 3,
        "LIGHT_W": 2,
        "COUNT_W": 8,
        "MIN_WEIGHT": int(MIN_WEIGHT * formats(Knobs()).shade.one),
    },
    sets={"small": {**_SMALL, **defines(BUILDS["book"])}},
    breaks=(
        # Which children come to be: their depth, their weight, of a miss.
        Break(_FILE, "turned_depth < max_depth", "turned_depth <= max_depth"),
        Break(_FILE, "turned_weight[0+:SHADE_W] >= LEAST", "turned_weight[0+:SHADE_W] > LEAST"),
        Break(_FILE, "|| turned_weight[2*SHADE_W+:SHADE_W] >= LEAST;", ";"),
        Break(_FILE, "wire cast = turned_hit && deeper", "wire cast = deeper"),
        Break(_FILE, "turned_step == TRANSMITTED && turned_branching;", "turned_step == TRANSMITTED;"),
        # Where they go, and of what weight.
        Break(_FILE, "transmitted_step ? transmitted : turned_mirrored;", "turned_mirrored;"),
        Break(_FILE, "share_transmits ? shares_reg", "!share_transmits ? shares_reg"),
        Break(_FILE, "shares_reg <= shares[in_own[OBJECT_W-1:0]];", "shares_reg <= shares[table_index];"),
        # Places that stay empty, and work.
        Break(_FILE, "{1'b0, transmits && !turned_branching}", "{1'b0, transmits}"),
        Break(_FILE, "deeper ? due - {1'b0, cast} : 2'd0;", "due - {1'b0, cast};"),
        Break(_FILE, "deeper ? due - {1'b0, cast} : 2'd0;", "deeper ? due : 2'd0;"),
        Break(
            _FILE,
            "(reflected_step ? {{COUNT_W - LIGHT_W{1'b0}}, turned_more}",
            "(1'b1 ? {{COUNT_W - LIGHT_W{1'b0}}, turned_more}",
        ),
        Break(_FILE, "{{COUNT_W - 1{1'b0}}, cast}", "{COUNT_W{1'b0}}"),
    ),
)
