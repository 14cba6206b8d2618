"""Limit of the CPU time and memory that reading a description may take; names the element and phase that exceed it."""

from __future__ import annotations

import sys
from contextlib import contextmanager

from urdfkit.description.xml.element import Element
from urdfkit.errors import DescriptionError, LimitedSuggestions
from urdfkit.position import Position

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FrameType, TracebackType
    from typing import Any

LOADING = 60.0
"""Seconds of CPU for loading a robot with its meshes, or a simulation without compiling the engine."""
MEMORY = 10**9
"""Bytes of memory that reading a description adds to the process."""
LOADING_MEMORY = 8 * 10**9
"""Bytes of memory that loading a robot or a simulation adds to the process, with the libraries and the meshes."""
_PERIOD = 0.1
"""Seconds of CPU between two checks."""
_PHASES = {
    "urdfkit.description.xacro": "expanding xacro",
    "urdfkit.description": "reading the description",
    "urdfkit.lint": "linting",
    "urdfkit.scene": "loading meshes",
    "urdfkit.kinematics": "building the kinematic model",
    "urdfkit.sim": "building the simulation",
}
"""Prefix of a module → the phase it belongs to; the first match counts."""


_excluded: float | None = 0.0
"""CPU time of the blocks of `excluded` so far [s]; None within such a block."""


@contextmanager
def excluded() -> Iterator[None]:
    """Exclude a block from the limits, such as compiling the engine, which a description does not cause."""
    import time

    global _excluded
    before, begin = _excluded, time.process_time()
    _excluded = None
    try:
        yield
    finally:
        _excluded = None if before is None else before + time.process_time() - begin


class CostError(DescriptionError):
    """A description takes more CPU time or memory than permitted."""


class _ExceededError(BaseException):
    """Ends the block; not an `Exception`, which handlers on the way would catch."""


class CostLimit:
    """Ends a block with a `CostError` when it takes more CPU time or memory than permitted; limits suggestions, too.

    The limit applies in the main thread of a process that has POSIX timers, and limits do not nest.

    Args:
        seconds: CPU time of the process for the block [s]; 0 for no limit.
        memory: growth of the largest memory of the process [byte].
        option: option of the command that sets the CPU time; empty if it has none.
    """

    def __init__(self, seconds: float, *, memory: int = MEMORY, option: str = "--time-limit") -> None:
        self.seconds, self.memory, self.option = seconds, memory, option
        self._what = self._phase = ""
        self._position: Position | None = None
        self._is_on = False
        self._suggestions = LimitedSuggestions()

    def __enter__(self) -> None:
        import signal
        import time

        self._suggestions.__enter__()
        if self.seconds <= 0 or sys.platform == "win32":
            return
        self._begin, self._peak = time.process_time() - (_excluded or 0.0), _peak()
        try:
            self._before = signal.signal(signal.SIGPROF, self._check)
        except ValueError:  # not the main thread
            return
        self._is_on = True
        signal.setitimer(signal.ITIMER_PROF, _PERIOD, _PERIOD)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._suggestions.__exit__()
        if not self._is_on:
            return
        import signal

        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, self._before)
        if isinstance(error, _ExceededError):
            hint = f"; {self.option} raises the limit" if self.option and "CPU" in self._what else ""
            raise CostError(f"{self._what} while {self._phase}{hint}", position=self._position) from None

    def _check(self, _number: int, frame: FrameType | None) -> None:
        import time

        if _excluded is None or _is_boundary(frame):
            return
        if time.process_time() - self._begin - _excluded > self.seconds:
            what = f"more than {self.seconds:g} s of CPU"
        elif _peak() - self._peak > self.memory:
            what = f"more than {self.memory / 1e9:g} GB of memory"
        else:
            return
        if not self._what:
            self._what, self._phase, self._position = what, _phase(frame), _position(frame)
        raise _ExceededError


def _is_boundary(frame: FrameType | None) -> bool:
    """Return whether the signal arrived while a limit begins or ends, where no handler would catch the exception."""
    boundary = (CostLimit.__enter__.__code__, CostLimit.__exit__.__code__)
    while frame is not None:
        if frame.f_code in boundary:
            return True
        frame = frame.f_back
    return False


def loading_limit() -> CostLimit:
    """Return the limit of loading a robot with its meshes, or a simulation."""
    return CostLimit(LOADING, memory=LOADING_MEMORY, option="")


def _peak() -> int:
    import resource

    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def _phase(frame: FrameType | None) -> str:
    """Return the rule being checked, or the phase of the innermost function of urdfkit."""
    modules = []
    while frame is not None:
        rule: Any = type(frame.f_locals.get("self"))
        if isinstance(getattr(rule, "code", None), str) and isinstance(getattr(rule, "name", None), str):
            return f"checking the rule {rule.name}"
        modules.append(str(frame.f_globals.get("__name__", "")))
        frame = frame.f_back
    found = (phase for module in modules for prefix, phase in _PHASES.items() if module.startswith(prefix))
    return next(found, "reading the description")


def _position(frame: FrameType | None) -> Position | None:
    """Return the position of the element that the innermost function with an element works on."""
    while frame is not None:
        for value in reversed(list(frame.f_locals.values())):
            is_own = type(value).__module__.startswith("urdfkit.")
            element = getattr(value, "element", None) if is_own and not isinstance(value, Element) else value
            if isinstance(element, Element):
                return element.origin.position
            if is_own:
                found = getattr(value, "position", None)
                if isinstance(found, Position):
                    return found
        frame = frame.f_back
    return None
