"""Who was not let in, in the log: a line each, but never a flood of them."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable

AGAIN = 600.0
"""Seconds after which the same refusal is said again."""
MOST = 10
"""Lines a minute."""
MINUTE = 60.0
KNOWN = 1000
"""Refusals that are remembered."""

log = logging.getLogger("urdfkit.view")


class Refusals:
    """Says what is refused, in the server's thread.

    Args:
        clock: seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._said: dict[str, float] = {}
        self._begun = clock()
        self._lines = 0

    def tell(self, who: str, what: str, why: str) -> None:
        """Say that something was refused.

        Args:
            who: address of who asked.
            what: was asked for; signs that a terminal would act on are spelled out.
            why: in words.
        """
        now, line = self._clock(), f"refused {ascii(what)[1:-1][:200]} from {who}: {why}"
        if now - self._begun >= MINUTE:
            self._begun, self._lines = now, 0
        if now - self._said.get(line, -AGAIN) < AGAIN or self._lines > MOST:
            return
        self._lines += 1
        if self._lines > MOST:
            log.warning("more than %d refusals in a minute: those to come in it are not told", MOST)
            return
        if len(self._said) >= KNOWN:
            self._said.clear()
        self._said[line] = now
        log.warning("%s", line)
