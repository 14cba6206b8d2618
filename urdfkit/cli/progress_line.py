"""ProgressLine: one line on a terminal that shows how far a command is."""

from __future__ import annotations

import sys
import time

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing_extensions import Self


class ProgressLine:
    """Line on standard error, if that is a terminal; each text replaces the last one, the end of the block removes it.

    Args:
        quiet: show nothing.
        period: least time before each text [s]; texts in between are dropped.
    """

    def __init__(self, *, quiet: bool = False, period: float = 0.0) -> None:
        self._is_shown = not quiet and sys.stderr.isatty()
        self._period = period
        self._due = time.monotonic() + period

    def __call__(self, text: str) -> None:
        """Show a text."""
        if self._is_shown and (now := time.monotonic()) >= self._due:
            self._due = now + self._period
            # The cursor stays at the start of the line, so that a warning replaces the text.
            print(f"\r\x1b[K{text}\r", end="", file=sys.stderr, flush=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._is_shown:
            print("\r\x1b[K", end="", file=sys.stderr, flush=True)
