"""What is compiled before a ride begins, told in the terminal and on the page."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from urdfkit.cli.page import note
from urdfkit.cli.sim.kernel import SECONDS_RAYS

if TYPE_CHECKING:
    from urdfkit.view.server import Server

RAYS = f"compiling the ray kernels, some {SECONDS_RAYS} s, once per machine …"


def compile_kernel(server: Server, first: Callable[[], None]) -> None:
    """Compile the physics kernel if it has not been.

    Args:
        server: the page.
        first: called before a compilation begins, not when there is none.
    """
    from urdfkit.sim.engine.warmup import announcement, warmup

    _compile(warmup, announcement(), server, first)


def compile_rays(server: Server, first: Callable[[], None]) -> None:
    """Compile what sensors see by if it has not been; see `compile_kernel`."""
    from urdfkit.scene.rays import warmup

    _compile(warmup, RAYS, server, first)


def _compile(
    warmup: Callable[[Callable[[int], None]], bool], label: str, server: Server, first: Callable[[], None]
) -> None:
    def say(functions: int) -> None:
        if functions == 0:
            first()
            note(label)
        server.declare("progress", label=f"{label} {functions} functions" if functions else label)

    warmup(say)
    server.declare("progress", label=None)
