"""The queue of pixels: the core's size, and one that is full all the time."""

from verif.env.unit import Unit

UNIT = Unit(
    name="pixel_queue",
    parameters={"SLOTS": 256, "SIZE_W": 12},
    sets={"small": {"SLOTS": 4}, "smallest": {"SLOTS": 2}},
)
