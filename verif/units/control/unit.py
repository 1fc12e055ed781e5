"""The control: one build."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="control",
    breaks=(
        Break("control.v", "if (rst || swap) waiting_reg <= 1'b0;", "if (rst) waiting_reg <= 1'b0;"),
        Break(
            "control.v",
            "assign load_ready   = !waiting_reg && (state_reg == S_IDLE || state_reg == S_DRAW);",
            "assign load_ready   = !waiting_reg;",
        ),
        Break(
            "control.v", "if (object_start) object_ready_reg <= 1'b0;", "if (rst) object_ready_reg <= 1'b0;"
        ),
        Break("control.v", "if (rst) locked_reg <= 1'b0;", "if (1'b0) locked_reg <= 1'b0;"),
    ),
)
