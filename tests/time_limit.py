"""A pytest plugin: a test that waits for ever fails instead, and a run that is told to end tears its fixtures down."""

from __future__ import annotations

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

import pytest

LIMIT = 900.0
"""Seconds for each of a test's setup, call and teardown: many times what the slowest takes on a busy machine."""
PATIENCE = 180.0
"""Seconds to wait for what comes soon on an idle machine, or after compiling the kernels at most."""


def pytest_configure(config: pytest.Config) -> None:
    """Let SIGTERM, and SIGHUP where it is not ignored, end the run as Ctrl-C does: fixtures end what they started."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        if signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _end)


def _end(number: int, _frame: FrameType | None) -> None:
    pytest.exit(f"ended by {signal.Signals(number).name}", returncode=128 + number)


@pytest.fixture(scope="session")
def until() -> Callable[[Callable[[], object]], object]:
    """Waits until a condition holds and returns its value; fails the test when it takes too long."""

    def wait(condition: Callable[[], object]) -> object:
        end = time.monotonic() + PATIENCE
        while not (found := condition()):
            assert time.monotonic() < end, f"waited {PATIENCE:g} s in vain"
            time.sleep(0.01)
        return found

    return wait


@contextmanager
def limit(seconds: float, what: str) -> Iterator[None]:
    """Fail if the block takes longer."""

    def fail(_number: int, _frame: FrameType | None) -> None:
        pytest.fail(f"{what}: not done after {seconds:g} s")

    before = signal.signal(signal.SIGALRM, fail)
    outer, _ = signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, outer)
        signal.signal(signal.SIGALRM, before)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_setup(item: pytest.Item) -> Iterator[None]:
    """Limit the fixtures."""
    with limit(LIMIT, f"setup of {item.nodeid}"):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_call(item: pytest.Item) -> Iterator[None]:
    """Limit the test."""
    with limit(LIMIT, item.nodeid):
        return (yield)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_teardown(item: pytest.Item) -> Iterator[None]:
    """Limit what the fixtures take away."""
    with limit(LIMIT, f"teardown of {item.nodeid}"):
        return (yield)
