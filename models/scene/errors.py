"""What is wrong with a scene file, in one line that says where and what to do."""

from pathlib import Path


class SceneError(Exception):
    """A scene file that cannot be drawn.

    `line` counts from 1 (None: the file as a whole), `field` is the name within the file (empty: none).
    """

    def __init__(self, path: Path, line: int | None, field: str, problem: str) -> None:
        """All four are kept as attributes."""
        super().__init__(path, line, field, problem)
        self.path = path
        self.line = line
        self.field = field
        self.problem = problem

    def __str__(self) -> str:
        place = f"{self.path}" if self.line is None else f"{self.path}:{self.line}"
        return ": ".join(part for part in (place, self.field, self.problem) if part)
