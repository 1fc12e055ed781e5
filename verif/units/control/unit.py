"""The control: one build."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="control",
    breaks=(
        Break(
            "control.v",
            "if (rst) state_reg <= S_IDLE;",
            "if (rst && state_reg != S_START_OBJECT) state_reg <= S_IDLE;",
        ),
        Break("control.v", "if (rst || swap) waiting_reg <= 1'b0;", "if (rst) waiting_reg <= 1'b0;"),
        Break(
            "control.v",
            "assign load_ready   = !waiting_reg && (state_reg == S_IDLE || state_reg == S_DRAW);",
            "assign load_ready   = !waiting_reg;",
        ),
        Break("control.v", "S_IDLE: if (waiting_reg && go)", "S_IDLE: if (waiting_reg)"),
        Break("control.v", "S_READY: if (draw_ready)", "S_READY: if (1'b1)"),
        Break(
            "control.v",
            "S_OBJECT: if (object_done) state_next = S_READY;",
            "S_OBJECT: if (draw_ready) state_next = S_READY;",
        ),
        Break(
            "control.v",
            "else if (camera_done) state_next = S_START_OBJECT;",
            "else state_next = S_START_OBJECT;",
        ),
        Break("control.v", "if (rst) locked_reg <= 1'b0;", "if (1'b0) locked_reg <= 1'b0;"),
    ),
)
