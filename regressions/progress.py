"""The live line: how far a regression is. On a terminal one line that changes, elsewhere one now and then."""

import sys
import time
from dataclasses import dataclass, field
from typing import TextIO

from regressions.record import Result, Status

_QUIET_SECONDS = 20.0
"""Between two lines where the output is no terminal."""


def clock(seconds: float) -> str:
    """Minutes and seconds."""
    return f"{int(seconds) // 60}:{int(seconds) % 60:02}"


@dataclass
class Progress:
    """Counts what ended. total: runs there are."""

    total: int
    out: TextIO = field(default_factory=lambda: sys.stderr)
    _done: int = 0
    _running: int = 0
    _bad: int = 0
    _start: float = field(default_factory=time.monotonic)
    _last: float = 0.0

    def building(self, done: int, total: int) -> None:
        """A build ended."""
        self._say(f"building {done}/{total}", done == total)

    def recording(self, done: int, total: int) -> None:
        """A failure was repeated with waves."""
        self._say(f"waves of {done}/{total} failures", done == total)

    def started(self) -> None:
        """A run began. The time left is counted from the first one."""
        if not self._done and not self._running:
            self._start = time.monotonic()
        self._running += 1
        self._say(self.text(), False)

    def ended(self, result: Result) -> None:
        """A run ended; one that did not pass has a line that stays."""
        self._running -= 1
        self.skipped(result)

    def skipped(self, result: Result) -> None:
        """A run has its result without having been started."""
        self._done += 1
        if result.status is not Status.PASSED:
            self._bad += 1
            first = result.message.splitlines()[:1]
            self._keep(f"{result.status.replace('_', ' ')}: {result.test}  {''.join(first)[:120]}")
        self._say(self.text(), self._done == self.total)

    def text(self) -> str:
        """The line."""
        return f"{self._done}/{self.total} done, {self._running} running, {self._bad} failed, {self._left()}"

    def _left(self) -> str:
        elapsed = time.monotonic() - self._start
        if not self._done:
            return clock(elapsed)
        return f"{clock(elapsed)}, {clock(elapsed / self._done * (self.total - self._done))} left"

    def _keep(self, text: str) -> None:
        print(f"\r{text:<79}" if self.out.isatty() else text, file=self.out, flush=True)

    def _say(self, text: str, last: bool) -> None:
        now = time.monotonic()
        if self.out.isatty():
            print(f"\r{text:<79}", end="\n" if last else "", file=self.out, flush=True)
        elif last or now - self._last >= _QUIET_SECONDS:
            self._last = now
            print(text, file=self.out, flush=True)
