"""The merge of streams: two, one, and more of them with items wider than a word."""

from verif.env.unit import Break, Unit

_FILE = "flow/merge.v"

UNIT = Unit(
    name="merge",
    parameters={"PORTS": 2, "WIDTH": 32},
    sets={"one": {"PORTS": 1, "WIDTH": 8}, "four": {"PORTS": 4, "WIDTH": 100}},
    breaks=(
        # Fairness: by number alone, in rounds whose order may turn around.
        Break(_FILE, "fresh != {PORTS{1'b0}} ? fresh : in_valid;", "in_valid;"),
        Break(_FILE, "served_reg <= grant | (grant - 1'b1);", "served_reg <= grant;", "four"),
        Break(
            _FILE,
            "served_reg <= grant | (grant - 1'b1);",
            "served_reg <= fresh != {PORTS{1'b0}} ? served_reg | grant : grant;",
            "four",
        ),
        # The output: overwritten, only free every other clock, an item where there is none.
        Break(_FILE, "wire free = !valid_reg || out_ready;", "wire free = 1'b1;"),
        Break(_FILE, "wire free = !valid_reg || out_ready;", "wire free = !valid_reg;"),
        Break(_FILE, "else if (free) valid_reg <= any;", "else if (free) valid_reg <= any || valid_reg;"),
        Break(_FILE, "if (rst) valid_reg <= 1'b0;", "if (1'b0) valid_reg <= 1'b0;"),
        # An item that is taken twice, one of another stream.
        Break(
            _FILE, "assign in_ready  = grant & {PORTS{free}};", "assign in_ready  = in_valid & {PORTS{free}};"
        ),
        Break(
            _FILE,
            "in_data[k*WIDTH+:WIDTH] & {WIDTH{grant[k]}}",
            "in_data[k*WIDTH+:WIDTH] & {WIDTH{in_valid[k]}}",
        ),
    ),
)
