"""The ray generator: one build."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="ray_generator",
    parameters={"SIZE_W": 12, "SLOT_W": 8},
    breaks=(
        Break(
            "trace/ray_generator.v",
            "wire line_end = x_reg == width - 1'b1;",
            "wire line_end = x_reg == width;",
        ),
        Break("trace/ray_generator.v", "if (rst) busy_reg <= 1'b0;", "if (1'b0) busy_reg <= 1'b0;"),
        Break(
            "trace/ray_generator.v", "+ signed_span(row_negative[lane], row);", "+ signed_span(1'b0, row);"
        ),
    ),
)
