"""The object's set-up: one build."""

from verif.env.unit import Unit

UNIT = Unit(name="object_setup")
