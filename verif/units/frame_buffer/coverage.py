"""What must have been seen of the frame buffer: clocks, pictures, resets, and swaps."""

from verif.env.coverage.classes import told
from verif.env.coverage.points import Coverage
from verif.video.seen import PICTURES, POINTS

SWAPS = told(
    "swap",
    "what a swap finds",
    dict.fromkeys(("no_picture_yet", "the_next_picture", "the_same_picture"), PICTURES),
)
COVERAGE = Coverage((*POINTS, SWAPS))
