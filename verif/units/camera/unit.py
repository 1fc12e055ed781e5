"""The camera: one build, within a harness that has a normaliser."""

from verif.env.unit import Unit

UNIT = Unit(name="camera", parameters={"SIZE_W": 12, "WIDE_W": 40}, top="camera_harness")
