"""What takes its time before a ride begins, told in the terminal and on the page."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from urdfkit.app.page import note

if TYPE_CHECKING:
    from urdfkit.view.content.display import Board

PATIENCE = 1.0
"""Seconds that something may take without a word."""


def compile_kernel(server: Board) -> None:
    """Compile the physics kernel if it has not been."""
    from urdfkit.sim.engine.kernel_cache import announcement, warmup

    _compile(warmup, announcement(), server)


def compile_rays(server: Board) -> None:
    """Compile what sensors see by if it has not been; see `compile_kernel`."""
    from urdfkit.scene.rays import announcement, warmup

    _compile(warmup, announcement(), server)


def _compile(warmup: Callable[[Callable[[int], None]], bool], label: str, server: Board) -> None:
    def say(functions: int) -> None:
        if functions == 0:
            note(label)
        server.declare("progress", label=f"{label} {functions} functions" if functions else label)

    warmup(say)
    server.declare("progress", label=None)


@contextmanager
def progress(server: Board, label: str) -> Iterator[None]:
    """Say what is being done in the terminal and on the page, if it takes longer than `PATIENCE`.

    Args:
        server: the page.
        label: what is being done.
    """
    over, said = threading.Lock(), False

    def say() -> None:
        nonlocal said
        with over:
            if not timer.finished.is_set():
                said = True
                note(label)
                server.declare("progress", label=label)

    timer = threading.Timer(PATIENCE, say)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        with over:
            if said:
                server.declare("progress", label=None)
