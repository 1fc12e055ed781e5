"""What must have been seen of the iterative square root: what must have been of the pipelined one."""

from verif.env.coverage.points import Coverage
from verif.units.sqrt.coverage import POINTS

COVERAGE = Coverage(POINTS)
