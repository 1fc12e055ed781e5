"""The stepper: parameter sets."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="stepper",
    parameters={"SPAN_W": 22, "COUNT_W": 12},
    sets={"narrow": {"SPAN_W": 6, "COUNT_W": 3}},
    exhaustive="narrow",
    breaks=(
        Break("trace/stepper.v", "wire carry = sum >= {1'b0, count};", "wire carry = sum > {1'b0, count};"),
        Break("trace/stepper.v", "rest_reg  <= remainder;", "rest_reg  <= {COUNT_W{1'b0}};"),
        Break("trace/stepper.v", "end else if (step) begin", "end else begin"),
    ),
)
