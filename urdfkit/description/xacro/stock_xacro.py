"""Run stock xacro with functions and variables of ours in place of some of its own.

This module is the only owner of xacro's module globals: it sets them for one expansion and puts them back, under a
lock, so that expansions can follow each other in any order, from any thread, after any error.
"""

from __future__ import annotations

import sys
from _thread import RLock  # threading itself takes half a millisecond to import
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from types import ModuleType

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.expansion import Run
    from urdfkit.description.xacro.recovery import RecoveringRun

_LATER = ("ast", "glob", "xacro.cli")
"""What xacro imports and needs for odd names, for includes with ``*``, and for its own command line."""

_LOCK = RLock()
_RECURSION_LIMIT = 10_000


def recovered(run: RecoveringRun) -> RecoveringRun:
    """Expand by a run, and by others that know what the one before found defined too late; return the last."""
    for _ in range(3):
        with xacro_for(run):
            run.expand()
        if (again := run.with_hindsight()) is None:
            break
        run = again
    return run


class _Later(ModuleType):
    """A module that is imported when somebody takes something from it."""

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        if sys.modules.get(self.__name__) is self:
            del sys.modules[self.__name__]
        return getattr(import_module(self.__name__), name)


def _process_args(*arguments: Any, **options: Any) -> Any:
    from xacro.cli import process_args

    return process_args(*arguments, **options)


def _stock() -> Any:
    """Import xacro without what most files do not need of it: that takes as long as expanding a small one."""
    if "xacro" not in sys.modules:
        later: dict[str, Any] = {name: _Later(name) for name in _LATER if name not in sys.modules}
        if "xacro.cli" in later:
            later["xacro.cli"].process_args = _process_args
        sys.modules.update(later)
        try:
            import xacro
        finally:
            for name, module in later.items():
                if sys.modules.get(name) is module:
                    del sys.modules[name]
    import xacro

    return xacro


@contextmanager
def xacro_for(run: Run) -> Iterator[None]:
    """Lend xacro's module globals to one run."""
    xacro = _stock()
    with _LOCK:
        lent = run.take(xacro)
        saved = {name: getattr(xacro, name) for name in lent}
        recursion_limit = sys.getrecursionlimit()
        vars(xacro).update(lent)
        # The hooks add frames to every level of macro calls; what stock xacro can nest must still fit.
        sys.setrecursionlimit(max(recursion_limit, _RECURSION_LIMIT))
        try:
            yield
        finally:
            sys.setrecursionlimit(recursion_limit)
            vars(xacro).update(saved)
