"""The queue between two streams: an ordinary size, the smallest two, the largest, items wider than a word."""

from verif.env.unit import Break, Unit

UNIT = Unit(
    name="fifo",
    parameters={"WIDTH": 32, "DEPTH": 16},
    sets={
        "smallest": {"WIDTH": 1, "DEPTH": 2},
        "small": {"WIDTH": 8, "DEPTH": 4},
        "wide": {"WIDTH": 300},
        "deep": {"WIDTH": 8, "DEPTH": 256},
    },
    breaks=(
        Break(
            "flow/fifo.v",
            "else if (pop && !push) room_reg <=",
            "else if (pop) room_reg <=",
        ),
        Break("flow/fifo.v", "assign in_ready  = room_reg !=", "assign in_ready  = pop || room_reg !="),
        Break("flow/fifo.v", "!= {ADDR_W + 1{1'b0}} && (!valid_reg || out_ready);", "!= {ADDR_W + 1{1'b0}};"),
        Break(
            "flow/fifo.v",
            "!= {ADDR_W + 1{1'b0}} && (!valid_reg || out_ready);",
            "!= {ADDR_W + 1{1'b0}} && !valid_reg;",
        ),
        Break("flow/fifo.v", "if (rst) valid_reg <= 1'b0;", "if (1'b0) valid_reg <= 1'b0;"),
        Break(
            "flow/fifo.v",
            "if (rst) stored_reg <= {ADDR_W + 1{1'b0}};",
            "if (1'b0) stored_reg <= {ADDR_W + 1{1'b0}};",
        ),
    ),
)
