"""Compile the physics kernel where it has not been, and say so."""

from __future__ import annotations

from typing import TextIO


def prepare_rays(out: TextIO) -> bool:
    """Make sure that the kernels that sensors see by are compiled and loaded; return whether they had to be compiled.

    Args:
        out: where to announce a compilation.
    """
    from urdfkit.scene.rays import announcement, warmup

    return warmup(lambda functions: None if functions else print(announcement(), file=out, flush=True))


def prepare_kernel(out: TextIO, *, world: bool = False) -> bool:
    """Make sure that the kernel is compiled and loaded, so that no later step waits for it.

    Args:
        out: where to announce a compilation; a terminal also sees how it gets on.
        world: whether it is the kernel for worlds that hold bodies.

    Returns:
        Whether it had to be compiled.

    Raises:
        MissingDependencyError: numba is not installed.
    """
    from importlib.util import find_spec

    from urdfkit.errors import MissingDependencyError

    if find_spec("numba") is None:
        raise MissingDependencyError("sim needs numba: pip install 'urdfkit[sim]'")
    from urdfkit.sim.engine.kernel_cache import announcement, warmup

    terminal = out.isatty()

    def progress(functions: int) -> None:
        if functions == 0:
            print(announcement(world=world), file=out, flush=True)
        elif terminal:
            print(f"\r{functions} functions", end="", file=out, flush=True)

    compiled = warmup(progress, world=world)
    if compiled and terminal:
        print("\r\x1b[K", end="", file=out, flush=True)
    return compiled
