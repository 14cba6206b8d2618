"""RejectionLog: logs rejected requests, with a limit on repetitions and on lines per minute."""

import logging
import time
from collections.abc import Callable

AGAIN = 600.0
"""Seconds after which the same rejection is logged again."""
MOST = 10
"""Maximum number of lines per minute."""
MINUTE = 60.0
REMEMBERED = 1000
"""Maximum number of rejections that are remembered."""

log = logging.getLogger("urdfkit.network")


class RejectionLog:
    """Logs rejected requests; used in the thread of the server.

    Args:
        clock: seconds.
    """

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._logged: dict[str, float] = {}
        self._begun = clock()
        self._lines = 0

    def add(self, client: str, request: str, reason: str) -> None:
        """Log a rejected request.

        Args:
            client: address of the client.
            request: method and path; control characters are escaped.
            reason: the reason, as a sentence.
        """
        now, line = self._clock(), f"rejected {ascii(request)[1:-1][:200]} from {client}: {reason}"
        if now - self._begun >= MINUTE:
            self._begun, self._lines = now, 0
        if now - self._logged.get(line, -AGAIN) < AGAIN or self._lines > MOST:
            return
        self._lines += 1
        if self._lines > MOST:
            log.warning("more than %d rejections in a minute; further ones are not logged until it ends", MOST)
            return
        if len(self._logged) >= REMEMBERED:
            self._logged.clear()
        self._logged[line] = now
        log.warning("%s", line)
