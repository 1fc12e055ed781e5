"""The video block with small screens; the default one is seen in `verif/video/test_video.py`."""

from models.video import Mode, Store
from verif.env.unit import Break, Unit
from verif.video.modes import MIXED, ODD, SMALL, TALL, TIGHT, WIDE, mode_parameters, store_parameters


def _set(store: Store, mode: Mode) -> dict[str, int]:
    return {**store_parameters(store), **mode_parameters(mode)}


_SIZES = "the_longest_line_and_column_are_cut_and_the_smallest_pictures_are_not"

UNIT = Unit(
    name="video",
    top="video_tb",
    parameters=_set(Store(8, 6, 16), SMALL),
    sets={
        "mixed": _set(Store(6, 4, 24), MIXED),
        "tight": _set(Store(13, 5, 8), TIGHT),
        "odd_doubled": _set(Store(5, 6, 8), ODD),
        "wide": _set(Store(4093, 2, 8), WIDE),
        "tall": _set(Store(2, 4093, 8), TALL),
    },
    # A picture of 8,186 pixels is enough of them.
    tests={"wide": _SIZES, "tall": _SIZES},
    breaks=(
        Break("video/video.v", ".swap               (blank_start),", ".swap               (1'b1),"),
        Break("video/video.v", "picture_reg <= on_picture && active;", "picture_reg <= active;"),
        Break(
            "video/video.v", "hsync_reg  <= {hsync_reg[0], timing_hsync};", "hsync_reg  <= {2{timing_hsync}};"
        ),
        Break("video/video.v", "de_reg     <= active_reg;", "de_reg     <= active;"),
        Break(
            "video/video.v",
            "wire [CHANNEL_W*GREEN_W-1:0] green = {CHANNEL_W{colour[BLUE_W+:GREEN_W]}};",
            "wire [CHANNEL_W*GREEN_W-1:0] green = {CHANNEL_W{colour[RED_W-1+:GREEN_W]}};",
        ),
        Break("video/scan.v", "left_reg    <= beside >> 1;", "left_reg    <= beside;"),
        Break(
            "video/scan.v",
            "columns_reg <= columns[X_W-1:0];",
            "columns_reg <= {1'b0, columns[X_W-2:0]};",
            set="wide",
        ),
        Break("video/scan.v", "if (row_phase_end) row_reg <= row_reg + ROW;", "row_reg <= row_reg + ROW;"),
        Break("video/scan.v", "if (!in_columns) begin", "if (x == H_END) begin"),
        Break("video/frame_buffer.v", "wire waiting = full_reg != shown;", "wire waiting = 1'b0;"),
        Break("video/frame_buffer.v", "colour = shown_reg ?", "colour = !shown_reg ?"),
        Break(
            "video/frame_buffer.v",
            "receiving_reg <= whole && !frame_end;",
            "receiving_reg <= !frame_end;",
        ),
        Break("video/vga_timing.v", "x_next < H_PULSE_END) == H_HIGH", "x_next <= H_PULSE_END) == H_HIGH"),
    ),
)
