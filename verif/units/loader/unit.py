"""The loader: the book's counters, and the capacity of this slice of the core."""

from verif.env.unit import Unit

UNIT = Unit(
    name="loader",
    parameters={
        "LIGHT_COUNT_W": 2,
        "SPHERE_COUNT_W": 2,
        "TRIANGLE_COUNT_W": 4,
        "MAX_LIGHTS": 3,
        "MAX_SPHERES": 3,
        "MAX_TRIANGLES": 15,
    },
    sets={"slice": {"MAX_LIGHTS": 1, "MAX_SPHERES": 1, "MAX_TRIANGLES": 0}},
)
