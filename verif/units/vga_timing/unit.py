"""The timing of the screen, in small modes; the default one is seen in `verif/video/test_video.py`."""

from verif.env.unit import Break, Unit
from verif.video.modes import MIXED, SMALL, TIGHT, mode_parameters

UNIT = Unit(
    name="vga_timing",
    parameters=mode_parameters(SMALL),
    sets={"mixed": mode_parameters(MIXED), "tight": mode_parameters(TIGHT)},
    breaks=(
        Break(
            "video/vga_timing.v",
            "localparam [X_W-1:0] H_LAST = H_TOTAL[X_W-1:0] - 1'b1;",
            "localparam [X_W-1:0] H_LAST = H_TOTAL[X_W-1:0];",
        ),
        Break("video/vga_timing.v", "x_next >= H_PULSE &&", "x_next > H_PULSE &&"),
        Break("video/vga_timing.v", "y_next < V_PULSE_END) == V_HIGH", "y_next <= V_PULSE_END) == V_HIGH"),
        Break("video/vga_timing.v", "wire line_start = x_next == H_PULSE;", "wire line_start = x_next == 0;"),
        Break(
            "video/vga_timing.v",
            "blank_start_reg <= line_start && y_next == V_END;",
            "blank_start_reg <= line_start && y_next == V_PULSE;",
        ),
        Break("video/vga_timing.v", "x_next < H_END && y_next < V_END", "x_next <= H_END && y_next < V_END"),
        Break(
            "video/vga_timing.v",
            "localparam H_HIGH = H_POSITIVE != 0;",
            "localparam H_HIGH = V_POSITIVE != 0;",
            set="tight",
        ),
    ),
)
