"""Compiling the kernel: once per machine and version, then from numba's cache."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any

from urdfkit.description.xml.cost_limit import excluded

KERNEL_MODULES = (
    "simulation_memory",
    "compilation",
    "constraints/constraint_rows",
    "constraints/contact_rows",
    "constraints/limit_crossings",
    "constraints/joint_servos",
    "constraints/position_goals",
    "contacts/midstep_contact_points",
    "contacts/anisotropic_friction",
    "contacts/ground_contacts",
    "dynamics/integration",
    "dynamics/mass_matrix",
    "dynamics/odometry",
    "kernel_world",
    "math/elementary_functions",
    "math/linear_systems",
    "math/simd",
    "math/spatial_algebra",
    "solver/active_set_newton",
    "solver/delassus",
    "solver/row_states",
    "solver/sliding_contacts",
    "stepping/ballistic",
    "stepping/robot_step",
)
"""Modules of this package with compiled functions, for one robot on its plane."""
WORLD_FOLDERS = ("collision", "contacts", "dynamics", "island_solver", "sleep", "stepping")
"""Sub-packages with the compiled functions that worlds of several bodies need in addition."""

Kernel = Callable[..., int]
Progress = Callable[[int], None]
"""Called with the number of functions compiled so far, beginning with 0, if any function must be compiled."""


@lru_cache(maxsize=1)
def kernel() -> Kernel:
    """Return the compiled `advance`, from the cache where there is one."""
    from urdfkit.sim.engine.stepping.robot_step import advance

    return load_compiled(advance, ("floats", "integers", "count", "flag"))


@lru_cache(maxsize=1)
def world_kernel() -> Kernel:
    """Return the compiled `world_step.advance`, from the cache where there is one."""
    from urdfkit.sim.engine.stepping.world_step import advance

    return load_compiled(advance, ("floats", "integers", "count", "flag"), digest=world_digest())


def announcement(*, world: bool = False) -> str:
    """Return the message before a compilation, with the kernel and its approximate duration [CPU s, measured]."""
    what, seconds = (" for worlds that hold bodies", 50) if world else ("", 22)
    return f"compiling the physics kernel{what}, once, about {seconds} s …"


def warmup(progress: Progress | None = None, *, world: bool = False) -> bool:
    """Make the kernel ready to run; return whether it had to be compiled (see `announcement`) rather than loaded.

    Args:
        progress: called with 0 before a compilation starts and with a growing count while it runs.
        world: whether it is the kernel for a world of several bodies, rather than for one robot on its plane.
    """
    from numba.core import event

    compiled: list[str] = []

    class CompilationListener(event.Listener):  # type: ignore[misc]
        def on_start(self, event: Any) -> None:
            if progress is not None:
                progress(len(compiled))
            compiled.append(str(event.data["dispatcher"]))

        def on_end(self, event: Any) -> None:
            pass

    with excluded(), event.install_listener("numba:compile", CompilationListener()):
        (world_kernel if world else kernel)()
    return bool(compiled)


def sources_digest() -> str:
    """Return a digest of the kernel's sources."""
    from urdfkit.compilation import own_sources

    digest = hashlib.sha256(own_sources())
    for name in KERNEL_MODULES:
        digest.update((Path(__file__).parent / f"{name}.py").read_bytes())
    return digest.hexdigest()


def world_digest() -> str:
    """Return a digest of the sources of the kernel for worlds."""
    digest = hashlib.sha256(sources_digest().encode())
    for folder in WORLD_FOLDERS:
        for path in sorted((Path(__file__).parent / folder).glob("*.py")):
            digest.update(path.read_bytes())
    return digest.hexdigest()


@lru_cache
def load_compiled(function: Callable[..., int], arguments: tuple[str, ...], *, digest: str | None = None) -> Kernel:
    """Compile a function for these types of arguments, or load it from the cache.

    Returns the compiled function instead of numba's dispatcher, which checks the types of all arguments in each call
    and takes longer than the call. Therefore, arrays of other types are not detected.
    """
    import numba

    from urdfkit.compilation import compile_or_load
    from urdfkit.sim.engine.compilation import OPTIONS

    types = {"floats": numba.float64[::1], "integers": numba.int64[::1], "count": numba.int64, "flag": numba.boolean}
    signature = tuple(types[name] for name in arguments)
    dispatcher = compile_or_load(function, signature, digest=digest or sources_digest(), options=OPTIONS)
    return dispatcher.overloads[signature].entry_point  # type: ignore[no-any-return]
