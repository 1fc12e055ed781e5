"""Why some mutants may live: `explained.toml`, reviewed, and never longer than it is true."""

import datetime
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from verif.mutation.record import Judged, Result

FILE = Path(__file__).with_name("explained.toml")

_KEYS = ("unit", "line", "reason", "owner", "review")


class ExplanationError(ValueError):
    """The file cannot be used; the text says where and what to do."""


@dataclass(frozen=True)
class Explanation:
    """Of the survivors at one line of a unit. line: its text; place: beginning of the mutant's place, any
    where it is empty; reason; owner; review: day on which somebody looks again."""

    unit: str
    line: str
    reason: str
    owner: str
    review: datetime.date
    place: str = ""

    def fits(self, unit: str, one: Judged) -> bool:
        """It is about this survivor."""
        same = (unit, one.mutant.text) == (self.unit, self.line)
        return same and one.mutant.place.startswith(self.place)


@dataclass(frozen=True)
class Explanations:
    """All of them."""

    entries: tuple[Explanation, ...]

    @classmethod
    def read(cls, file: Path = FILE) -> "Explanations":
        """Reads the file. Raises ExplanationError."""
        entries = []
        for number, found in enumerate(tomllib.loads(file.read_text()).get("survivor", []), 1):
            missing = [key for key in _KEYS if not found.get(key)]
            if missing:
                raise ExplanationError(f"{file}: survivor {number} has no {', '.join(missing)}: write it")
            if not isinstance(found["review"], datetime.date):
                raise ExplanationError(f"{file}: survivor {number}: review is no date: write YYYY-MM-DD")
            entries.append(Explanation(**found))
        return cls(tuple(entries))

    def of(self, unit: str, one: Judged) -> str:
        """The reason of a survivor; empty where there is none."""
        return next((entry.reason for entry in self.entries if entry.fits(unit, one)), "")

    def stale(self, results: Iterable[Result], today: datetime.date | None = None) -> list[str]:
        """A sentence for each that is about no survivor of these results, or whose day of review has
        passed."""
        now = today or datetime.date.today()
        found = {result.unit: result for result in results}
        lines = []
        for entry in self.entries:
            if entry.review < now:
                lines.append(
                    f"{FILE.name}: {entry.unit}, `{entry.line}`: to be reviewed since {entry.review}"
                )
            elif entry.unit in found and not self._used(entry, found[entry.unit]):
                lines.append(
                    f"{FILE.name}: {entry.unit}, `{entry.line}`: no mutant survives there: delete it"
                )
        return lines

    @staticmethod
    def _used(entry: Explanation, result: Result) -> bool:
        return any(entry.fits(result.unit, one) for one in result.survivors)
