"""Compile the physics kernels if they are not cached, and announce it."""

from typing import TextIO


def prepare_rays(out: TextIO) -> bool:
    """Compile and load the kernels of ray-casting sensors; return whether a compilation was necessary.

    Args:
        out: stream for the announcement of a compilation.
    """
    from urdfkit.scene.rays import announcement, warmup

    return warmup(lambda functions: None if functions else print(announcement(), file=out, flush=True))


def prepare_kernel(out: TextIO, *, world: bool = False) -> bool:
    """Compile and load the physics kernel, so that no later step waits for it.

    Args:
        out: stream for the announcement of a compilation; a terminal also gets its progress.
        world: compile the kernel for worlds with bodies.

    Returns:
        Whether a compilation was necessary.

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
