"""What must have been seen: clocks, pictures, resets."""

from verif.env.coverage.points import Coverage
from verif.video.seen import POINTS

COVERAGE = Coverage(POINTS)
