"""A pytest plugin: the run fails if a program that a test has started outlives the tests (Linux)."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import sys
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

PR_SET_CHILD_SUBREAPER = 36
PATIENCE = 60.0
"""Seconds in which what has been told to end may end."""
WITH_US = ("multiprocessing.resource_tracker", "multiprocessing.forkserver")
"""Helpers of this process that end with it."""

left_over = pytest.StashKey[list[str]]()


def pytest_configure(config: pytest.Config) -> None:
    """Be the process that adopts what programs have started and left behind."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session) -> None:
    """Kill what is left over, and fail."""
    end = time.monotonic() + PATIENCE
    while (found := dict(descendants())) and time.monotonic() < end:
        time.sleep(0.05)
    session.config.stash[left_over] = list(found.values())
    for process in found:
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    if found and session.exitstatus in (pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED):
        session.exitstatus = pytest.ExitCode.TESTS_FAILED


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter, config: pytest.Config) -> None:
    """Name what was left over and the tests that started it."""
    if lines := config.stash.get(left_over, []):
        terminalreporter.section("processes left running", red=True, bold=True)
        for line in lines:
            terminalreporter.line(f"ERROR {line}", red=True)


def descendants() -> Iterator[tuple[int, str]]:
    """Yield the processes that descend from this one and run, each with what it is and the test that started it."""
    parents: dict[int, int] = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            state, parent = (folder / "stat").read_text().rpartition(")")[2].split()[:2]
            if state not in "ZX":
                parents[int(folder.name)] = int(parent)
    for process in parents:
        ancestor: int | None = process
        while ancestor is not None and ancestor != os.getpid():
            ancestor = parents.get(ancestor)
        if ancestor is None or process == ancestor:
            continue
        words = _fields(process, "cmdline")
        if not any(name in word for name in WITH_US for word in words):
            test = [word.partition("=")[2] for word in _fields(process, "environ") if word.startswith("PYTEST_CURRENT")]
            yield process, f"{test[0] if test else 'unknown test'}: process {process}: {' '.join(words)}"


def _fields(process: int, file: str) -> list[str]:
    try:
        return Path(f"/proc/{process}/{file}").read_bytes().decode(errors="replace").strip("\0").split("\0")
    except OSError:  # it has just ended
        return []
