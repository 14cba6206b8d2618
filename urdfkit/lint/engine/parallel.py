"""Lint many entry files in several processes."""

import multiprocessing
import sys
import threading
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool

from urdfkit.errors import ResourceError
from urdfkit.lint.engine.cache import cache_for
from urdfkit.lint.engine.checker import Checker
from urdfkit.lint.finding import EntryResult
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

_checkers: list[Checker] = []
"""The checker of this process; its package lookups serve all files of the process."""


def check_all(
    entries: Sequence[Entry], options: Options, *, cached: bool, jobs: int, keep_going: bool
) -> Iterator[EntryResult]:
    """Lint entry files in several processes; yield their results in order.

    Args:
        entries: the entry files.
        options: lint options.
        cached: store the findings in the cache.
        jobs: maximum number of processes.
        keep_going: see `urdfkit.lint.engine.run.run`.

    Raises:
        UrdfkitError: an entry file cannot be linted.
        ResourceError: a worker process was terminated, for example because memory ran out.
    """
    # fork is fastest, and safe with a single thread.
    can_fork = sys.platform == "linux" and threading.active_count() == 1
    context = multiprocessing.get_context("fork" if can_fork else "spawn")
    count = min(jobs, len(entries))
    try:
        with ProcessPoolExecutor(count, context, _begin, (options, cached, keep_going)) as pool:
            check, size = _check_or_refuse if keep_going else _check, max(1, len(entries) // (8 * count))
            yield from pool.map(check, entries, chunksize=size)
    except BrokenProcessPool as error:
        raise ResourceError("a worker process was terminated; retry with --jobs 1") from error


def _begin(options: Options, cached: bool, keep_going: bool) -> None:
    if options.confinement is not None:
        options.confinement.start()
    _checkers[:] = [Checker(options, cache=cache_for(options) if cached else None, keep_going=keep_going)]


def _check(entry: Entry) -> EntryResult:
    checker = _checkers[0]
    checker.sources.clear()
    return checker.check(entry)


def _check_or_refuse(entry: Entry) -> EntryResult:
    checker = _checkers[0]
    checker.sources.clear()
    return checker.check_or_refuse(entry)
