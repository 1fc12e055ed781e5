"""The sums of pixels: the core's size, and few slots whose counts wrap often."""

from verif.env.unit import Break, Unit

_FILE = "pixel/accumulator.v"

UNIT = Unit(
    name="accumulator",
    parameters={"SLOTS": 256, "COUNT_W": 8},
    sets={
        "small": {"SLOTS": 4, "COUNT_W": 3},
        "smallest": {"SLOTS": 2, "COUNT_W": 1},
        "deep": {"SLOTS": 64, "COUNT_W": 9},
    },
    breaks=(
        # Counts: not cleared after reset, the last term counts too, work that is lost.
        Break(_FILE, "ended_slot = clearing ? clear_slot : term_slot;", "ended_slot = term_slot;"),
        Break(_FILE, "if (clearing || term_valid && !complete)", "if (clearing || term_valid)"),
        Break(_FILE, "announced[more_slot] + more_count;", "announced[more_slot] | more_count;"),
        # The term before: not seen, seen in any slot, seen where its pixel was complete.
        Break(_FILE, "again_reg <= add_reg && slot_reg == term_slot;", "again_reg <= 1'b0;"),
        Break(_FILE, "again_reg <= add_reg && slot_reg == term_slot;", "again_reg <= add_reg;"),
        Break(_FILE, "again_reg <= add_reg && slot_reg == term_slot;", "again_reg <= slot_reg == term_slot;"),
        Break(_FILE, "sum_reg & {COLOUR_W{!valid_reg}}", "sum_reg"),
        # Sums: not saturated, not cleared for the next pixel, not cleared after reset.
        Break(_FILE, "wide[W-1:0] | {W{wide[W]}};", "wide[W-1:0];"),
        Break(_FILE, "{COLOUR_W{!clearing && !last_reg}};", "{COLOUR_W{!clearing}};"),
        Break(_FILE, "{COLOUR_W{!clearing && !last_reg}};", "{COLOUR_W{!last_reg}};", "small"),
        Break(_FILE, "announced_slot = clearing ? clear_slot : more_slot;", "announced_slot = more_slot;"),
        Break(_FILE, "if (rst) clear_reg <=", "if (1'b0) clear_reg <="),
    ),
)
