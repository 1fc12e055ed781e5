"""The trace unit: the core's size, and few objects with little room in the book's formats; its ports."""

from models.formats import BUILDS, Formats
from models.header import defines, selected
from verif.env.fields import Field, bit
from verif.env.unit import Break, Parameters, Unit

_FILE = "trace/trace_unit.v"


def _line(fmts: Formats) -> tuple[Field, ...]:
    return (Field.of("origin", fmts.point, lanes=3), Field.of("direction", fmts.unit, lanes=3))


def _own(p: Parameters) -> tuple[Field, ...]:
    return (bit("owned"), Field("own", p["OBJECT_W"], signed=False))


def _side(p: Parameters) -> Field:
    """A field holds 63 bits a lane at most."""
    return Field("side", p["SIDE_W"] // 3, lanes=3, signed=False)


def _slot(p: Parameters) -> Field:
    return Field("slot", p["SLOT_W"], signed=False)


def geometry(p: Parameters) -> tuple[Field, ...]:
    """A row of the table, see object_setup."""
    fmts = selected(p)
    return (
        bit("triangle"),
        bit("dead"),
        bit("glass"),
        Field.of("shape", fmts.unit, lanes=3),
        Field.of("vertices", fmts.coord, lanes=9),
        Field.of("transparency", fmts.coeff, lanes=3),
    )


def ray(p: Parameters) -> tuple[Field, ...]:
    """A ray; owned and own are its triangle."""
    return (_side(p), *_own(p), *_line(selected(p)))


def shadow(p: Parameters) -> tuple[Field, ...]:
    """A shadow ray."""
    fmts = selected(p)
    colours = (Field.of("base", fmts.shade, lanes=3), Field.of("colour", fmts.shade, lanes=3))
    return (_slot(p), *_own(p), *colours, *_line(fmts), Field.of("limit", fmts.point))


def found(p: Parameters) -> tuple[Field, ...]:
    """What a hit has found; it means nothing where the ray missed."""
    fmts = selected(p)
    return (
        Field("number", p["OBJECT_W"], signed=False),
        bit("glass"),
        bit("leaving"),
        Field.of("distance", fmts.point),
        Field.of("offset", fmts.offset, lanes=3),
        Field.of("half_chord", fmts.half_chord),
    )


def hit(p: Parameters) -> tuple[Field, ...]:
    """The result of a ray."""
    return (_side(p), *_line(selected(p)), bit("hit"), *found(p))


def term(p: Parameters) -> tuple[Field, ...]:
    """The result of a shadow ray."""
    return (_slot(p), Field.of("sum", selected(p).shade, lanes=3))


UNIT = Unit(
    name="trace_unit",
    parameters={"OBJECTS": 18, "OBJECT_W": 5, "SLOT_W": 9, "SIDE_W": 75, "ROOM": 64},
    sets={
        "small": {
            "OBJECTS": 4,
            "OBJECT_W": 2,
            "SLOT_W": 4,
            "SIDE_W": 24,
            "ROOM": 4,
            **defines(BUILDS["book"]),
        }
    },
    breaks=(
        # The triangle that a ray starts on: not left out as the first object, as another one.
        Break(_FILE, "{{OBJECT_W - 1{1'b0}}, skip_first}", "{OBJECT_W{1'b0}}"),
        Break(_FILE, "skip_next ? following + 1'b1 : following", "following"),
        Break(_FILE, "shadow_valid ? shadow_own : ray_own", "ray_own"),
        # What ends a ray, and what is no test.
        Break(_FILE, "wire loadable = !busy_reg || last;", "wire loadable = !busy_reg;"),
        Break(_FILE, "test_void_reg   <= {1'b0, index_reg} >= objects;", "test_void_reg   <= 1'b0;"),
        Break(_FILE, "wire blank = test_void_reg || row_dead;", "wire blank = test_void_reg;"),
        Break(_FILE, "if (rst) busy_reg <= 1'b0;", "if (1'b0) busy_reg <= 1'b0;"),
        # The nearest hit: the last of equal ones, one of the ray before.
        Break(_FILE, "found_distance < nearest_distance", "found_distance <= nearest_distance"),
        Break(_FILE, "any_hit_reg && !found_first", "any_hit_reg"),
        # The light: of the ray before, not dimmed, not saturated.
        Break(_FILE, "found_first ? found_colour : light_reg", "light_reg"),
        Break(_FILE, "meets ? dimmed : light;", "found_hit ? dimmed : light;"),
        Break(_FILE, "wide[SHADE_W-1:0] | {SHADE_W{wide[SHADE_W]}}", "wide[SHADE_W-1:0]"),
        Break(_FILE, "shadow_valid ? shadow_limit : INFINITY", "INFINITY"),
        # Room behind the tests.
        Break(_FILE, "assign ray_free    = loadable && hit_side_ready;", "assign ray_free    = loadable;"),
        Break(_FILE, "loadable && term_side_ready", "loadable && hit_side_ready", "small"),
    ),
)
