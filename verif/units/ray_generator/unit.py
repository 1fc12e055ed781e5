"""The ray generator: one build."""

from verif.env.unit import Unit

UNIT = Unit(name="ray_generator", parameters={"SIZE_W": 12, "SLOT_W": 8})
