"""Progress of long operations before a simulation starts, in the terminal and on the page."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from urdfkit.app.page import note

if TYPE_CHECKING:
    from urdfkit.view.content.display_interface import StatusDisplay

PATIENCE = 1.0
"""Seconds that an operation may take before it is reported."""


def compile_kernel(server: StatusDisplay) -> None:
    """Compile the physics kernel if it is not cached."""
    from urdfkit.sim.engine.kernel_cache import announcement, warmup

    _compile(warmup, announcement(), server)


def compile_rays(server: StatusDisplay) -> None:
    """Compile the ray-casting kernels of sensors if they are not cached; see `compile_kernel`."""
    from urdfkit.scene.rays import announcement, warmup

    _compile(warmup, announcement(), server)


def _compile(warmup: Callable[[Callable[[int], None]], bool], label: str, server: StatusDisplay) -> None:
    def report(functions: int) -> None:
        if functions == 0:
            note(label)
        server.publish_latched("progress", label=f"{label} {functions} functions" if functions else label)

    warmup(report)
    server.publish_latched("progress", label=None)


@contextmanager
def progress(server: StatusDisplay, label: str) -> Iterator[None]:
    """Report an operation in the terminal and on the page if it takes longer than `PATIENCE`.

    Args:
        server: the page.
        label: name of the operation.
    """
    over, reported = threading.Lock(), False

    def report() -> None:
        nonlocal reported
        with over:
            if not timer.finished.is_set():
                reported = True
                note(label)
                server.publish_latched("progress", label=label)

    timer = threading.Timer(PATIENCE, report)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        with over:
            if reported:
                server.publish_latched("progress", label=None)
