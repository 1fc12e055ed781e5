"""The registers behind AXI4-Lite: the default build, the smallest and the widest."""

from models.registers import Build
from verif.env.unit import Break, Unit

_FILE = "bus/axil_registers.v"

UNIT = Unit(
    name="axil_registers",
    parameters={name.upper(): value for name, value in vars(Build()).items()},
    sets={
        "small": {"UNITS": 1, "SIZE_W": 10, "MAX_DEPTH": 1, "LIGHTS": 1, "SPHERES": 1, "TRIANGLES": 0},
        "wide": {"UNITS": 4, "SIZE_W": 16, "MAX_DEPTH": 7, "LIGHTS": 15, "SPHERES": 63, "TRIANGLES": 255},
    },
    breaks=(
        # An event in the clock of its clearing is lost.
        Break(
            _FILE,
            "else if (frame_done) done_reg <= 1'b1;",
            "else if (frame_done && !write) done_reg <= 1'b1;",
        ),
        # A clear without regard to the strobes.
        Break(
            _FILE,
            "else if (write_interrupt && ones[ERROR])",
            "else if (write_interrupt && write_data_reg[ERROR])",
        ),
        # Data that comes before its address is forgotten.
        Break(
            _FILE,
            "else if (s_axil_wvalid && s_axil_wready) w_held_reg <= 1'b1;",
            "else w_held_reg <= s_axil_wvalid || w_held_reg && aw_held_reg;",
        ),
        # Ready comes from valid.
        Break(
            _FILE,
            "assign s_axil_arready = !ar_held_reg;",
            "assign s_axil_arready = s_axil_arvalid && !ar_held_reg;",
        ),
        # A read of instructions is refused.
        Break(
            _FILE,
            "read_error_reg <= !READABLE[read_word_reg];",
            "read_error_reg <= !READABLE[read_word_reg] || s_axil_arprot[2];",
        ),
        # A response that is not waited for.
        Break(_FILE, "wire read_ends = r_valid_reg && s_axil_rready;", "wire read_ends = r_valid_reg;"),
        # Reset leaves a response behind.
        Break(_FILE, "if (rst || write_ends) b_valid_reg <= 1'b0;", "if (write_ends) b_valid_reg <= 1'b0;"),
        # A start survives its frame.
        Break(_FILE, "else if (frame_start) start_reg <= 1'b0;", "else if (frame_done) start_reg <= 1'b0;"),
        # Writes to registers that are read only are accepted.
        Break(
            _FILE,
            "if (write) write_error_reg <= !WRITABLE[write_word_reg];",
            "if (write) write_error_reg <= !READABLE[write_word_reg];",
        ),
        # A size that does not fit is cut.
        Break(_FILE, "height_fits ? height_next : 16'd0", "height_next & (16'hffff >> (16 - SIZE_W))"),
    ),
)
