"""The scene memory: this slice's capacity, and the book's."""

from verif.env.unit import Unit

UNIT = Unit(
    name="scene_memory",
    parameters={"LIGHTS": 1, "SPHERES": 1},
    sets={"book": {"LIGHTS": 3, "SPHERES": 3}},
)
