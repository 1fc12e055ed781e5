"""The delay line: every depth from 0 on, side by side in one wrapper."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="delay",
    top="delay_depths",
    parameters={"WIDTH": 8, "DEPTHS": 12},
    sets={"bit": {"WIDTH": 1, "DEPTHS": 36}},
    breaks=(
        Break("arith/delay.v", "localparam WORDS = DEPTH - 1;", "localparam WORDS = DEPTH - 2;"),
        Break("arith/delay.v", "if (rst || pointer_reg == LAST)", "if (pointer_reg == LAST)", set="bit"),
        Break("arith/delay.v", "chain_next[DEPTH*WIDTH+:WIDTH]", "chain_next[(DEPTH-1)*WIDTH+:WIDTH]"),
    ),
)
