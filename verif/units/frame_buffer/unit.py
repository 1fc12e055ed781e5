"""The double frame buffer, small: it is filled and read in no time."""

from models.video import Store
from verif.env.unit import Break, Unit
from verif.video.modes import store_parameters

UNIT = Unit(
    name="frame_buffer",
    parameters=store_parameters(Store(8, 6, 16)),
    sets={"deep": store_parameters(Store(5, 4, 24)), "shallow": store_parameters(Store(2, 8, 8))},
    breaks=(
        Break("video/frame_buffer.v", "wire waiting = full_reg != shown;", "wire waiting = 1'b0;"),
        Break(
            "video/frame_buffer.v",
            "&& !restart && !ended_reg && !waiting",
            "&& !restart && !waiting",
        ),
        Break("video/frame_buffer.v", "end else if (swap && full", "end else if (full"),
        Break(
            "video/frame_buffer.v",
            "if (rst || restart) receiving_reg <= 1'b0;",
            "if (restart) receiving_reg <= 1'b0;",
        ),
        Break(
            "video/frame_buffer.v", "receiving_reg <= whole && !frame_end;", "receiving_reg <= !frame_end;"
        ),
        Break(
            "video/frame_buffer.v",
            "ended_reg <= take && whole && frame_end;",
            "ended_reg <= take && frame_end;",
        ),
        Break(
            "video/frame_buffer.v",
            "write_reg         <= take && x < MOST_X && y < MOST_Y;",
            "write_reg         <= take && y < MOST_Y;",
            # Here the addresses end with the picture, and what is too far right returns at its top.
            set="shallow",
        ),
        Break(
            "video/frame_buffer.v",
            "wire [SIZE_W-1:0] w = first ? width : width_reg;",
            "wire [SIZE_W-1:0] w = width;",
        ),
        Break("video/frame_buffer.v", "wire [SIZE_W-1:0] x = first ?", "wire [SIZE_W-1:0] x = 1'b0 ?"),
        Break("video/frame_buffer.v", "write_reg && full_reg != SECOND", "write_reg && full_reg == SECOND"),
        Break("video/frame_buffer.v", "if (restart) full_reg <= 1'b0;", "if (1'b0) full_reg <= 1'b0;"),
        Break("video/frame_buffer.v", "width_reg < MOST_X ? width_reg[", "1'b1 ? width_reg["),
    ),
)
