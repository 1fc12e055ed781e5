"""The control: one build."""

from verif.env.unit import Unit

UNIT = Unit(name="control")
