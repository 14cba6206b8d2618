"""Compile the physics kernel where it has not been, and say so."""

from __future__ import annotations

from typing import TextIO

SECONDS = 20
"""About how long compilation takes."""


def prepare_kernel(out: TextIO) -> bool:
    """Make sure that the kernel is compiled and loaded, so that no later step waits for it.

    Args:
        out: where to announce a compilation; a terminal also sees how it gets on.

    Returns:
        Whether it had to be compiled.

    Raises:
        MissingDependencyError: numba is not installed.
    """
    from importlib.util import find_spec

    from urdfkit.errors import MissingDependencyError

    if find_spec("numba") is None:
        raise MissingDependencyError("sim needs numba: pip install 'urdfkit[sim]'")
    from urdfkit.sim.engine import warmup

    terminal = out.isatty()

    def progress(functions: int) -> None:
        if functions == 0:
            print(f"compiling the physics kernel, once, about {SECONDS} s …", file=out, flush=True)
        elif terminal:
            print(f"\r{functions} functions", end="", file=out, flush=True)

    compiled = warmup(progress)
    if compiled and terminal:
        print("\r\x1b[K", end="", file=out, flush=True)
    return compiled
