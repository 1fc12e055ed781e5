"""The store of pending rays: the core's size, the smallest room at most and least depths, wide rays."""

from verif.env.unit import Break, Unit

_FILE = "trace/ray_store.v"

UNIT = Unit(
    name="ray_store",
    parameters={"RAY_W": 64, "MAX_DEPTH": 5, "LEVEL_ROOM": 256, "DEPTH_W": 3},
    sets={
        "small": {"MAX_DEPTH": 7, "LEVEL_ROOM": 4},
        "shallow": {"MAX_DEPTH": 2, "LEVEL_ROOM": 4},
        "flat": {"MAX_DEPTH": 1, "LEVEL_ROOM": 4},
        "wide": {"RAY_W": 300, "MAX_DEPTH": 3, "LEVEL_ROOM": 16},
    },
    breaks=(
        # The test of room: none for stored rays, one place too few, none for primary rays.
        Break(_FILE, "holds[k] && enough[k+1];", "holds[k];", "small"),
        Break(_FILE, "free_reg >= {{FREE_W - 2{1'b0}}, branches};", "free_reg != {FREE_W{1'b0}};", "small"),
        Break(_FILE, "holds[k] && enough[k+1];", "holds[k] && enough[k];", "small"),
        Break(_FILE, "assign primary_ready = enough[2] &&", "assign primary_ready =", "small"),
        # Places: not given back by a settle, not by a ray that goes, reserved by the deepest rays too.
        Break(_FILE, "settles ? settle_count : 2'd0", "settles ? 2'd1 : 2'd0", "small"),
        Break(
            _FILE,
            "free_reg + {{FREE_W - 1{1'b0}}, goes[k]}",
            "free_reg + {{FREE_W - 1{1'b0}}, comes}",
            "small",
        ),
        Break(_FILE, "goes[k-1] && max_depth >= DEPTH;", "goes[k-1];", "small"),
        # The deepest first; the oldest of a full level; the output.
        Break(_FILE, "assign goes[k]   = may[k] && !deeper[k] &&", "assign goes[k]   = may[k] &&", "small"),
        Break(_FILE, "deeper[k] = deeper[k+1] || may[k+1];", "deeper[k] = may[k+1];", "small"),
        Break(
            _FILE,
            "holds[k]  = head_reg != tail_reg;",
            "holds[k]  = head_reg[0+:PTR_W] != tail_reg[0+:PTR_W];",
            "small",
        ),
        Break(
            _FILE, "wire output_room = !skid_valid_reg;", "wire output_room = !skid_valid_reg || ray_ready;"
        ),
        Break(_FILE, "wire output_room = !skid_valid_reg;", "wire output_room = !read_valid_reg;"),
        Break(_FILE, "choose && read_valid_reg && !ray_ready;", "1'b0;"),
        Break(_FILE, "if (rst) skid_valid_reg <= 1'b0;", "if (1'b0) skid_valid_reg <= 1'b0;"),
        Break(_FILE, "if (rst) free_reg <=", "if (1'b0) free_reg <="),
    ),
)
