"""The object's set-up: one build."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="object_setup",
    breaks=(
        Break("scene/object_setup.v", "<= radius * radius;", "<= radius * (radius - 1'b1);"),
        Break("scene/object_setup.v", ".SIGNED  (0)", ".SIGNED  (1)"),
        Break(
            "scene/object_setup.v",
            "else done_reg <= quotient_valid;",
            "else done_reg <= quotient_valid || done_reg;",
        ),
    ),
)
