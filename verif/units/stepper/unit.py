"""The stepper: parameter sets."""

from verif.env.unit import Unit

UNIT = Unit(
    name="stepper",
    parameters={"SPAN_W": 22, "COUNT_W": 12},
    sets={"narrow": {"SPAN_W": 6, "COUNT_W": 3}},
    exhaustive="narrow",
)
