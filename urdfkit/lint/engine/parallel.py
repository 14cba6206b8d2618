"""Many entry files at once, each in one of several processes."""

from __future__ import annotations

import multiprocessing
import sys
import threading
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool

from urdfkit.errors import ResourceError
from urdfkit.lint.engine.checker import Checker

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

    from urdfkit.lint.finding import Found
    from urdfkit.lint.project.entry_files import Entry
    from urdfkit.lint.project.options import Options

_checkers: list[Checker] = []
"""The checker of this process, once it has one: what it learns of packages serves all its files."""


def check_all(entries: Sequence[Entry], options: Options, *, cached: bool, jobs: int, keep_going: bool) -> list[Found]:
    """Lint entry files in several processes.

    Args:
        entries: what to lint.
        options: how.
        cached: keep what is found.
        jobs: how many processes at most.
        keep_going: see `urdfkit.lint.engine.run.run`.

    Raises:
        UrdfkitError: what one of them could not do.
        ResourceError: a process was ended from outside, for instance for its use of memory.
    """
    # To fork is quickest, and safe where there is one thread only.
    quick = sys.platform == "linux" and threading.active_count() == 1
    context = multiprocessing.get_context("fork" if quick else "spawn")
    count = min(jobs, len(entries))
    try:
        with ProcessPoolExecutor(count, context, _begin, (options, cached, keep_going)) as pool:
            return list(
                pool.map(_try if keep_going else _check, entries, chunksize=max(1, len(entries) // (8 * count)))
            )
    except BrokenProcessPool as error:
        raise ResourceError("a process that linted was ended from outside; try --jobs 1") from error


def _begin(options: Options, cached: bool, keep_going: bool) -> None:
    _checkers[:] = [Checker(options, cached=cached, keep_going=keep_going)]


def _check(entry: Entry) -> Found:
    checker = _checkers[0]
    checker.sources.clear()
    return checker.check(entry)


def _try(entry: Entry) -> Found:
    checker = _checkers[0]
    checker.sources.clear()
    return checker.tried(entry)
