"""Compiling the kernel: once per machine and version, then from numba's cache."""

from __future__ import annotations

import hashlib
import os
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from functools import lru_cache
from pathlib import Path
from typing import Any

from urdfkit.compilation import own_sources
from urdfkit.compilation.native import NativeCode, NativeFunction, cache_folders, write_native
from urdfkit.description.xml.cost_limit import excluded
from urdfkit.sim.engine.compiling_process import CompilingProcess
from urdfkit.sim.engine.interpreted_kernel import InterpretedKernel

KERNEL_MODULES = (
    "simulation_memory",
    "compilation",
    "field_type",
    "constraints/constraint_rows",
    "constraints/contact_rows",
    "constraints/limit_crossings",
    "constraints/joint_servos",
    "constraints/position_goals",
    "contacts/midstep_contact_points",
    "contacts/anisotropic_friction",
    "contacts/ground_contacts",
    "dynamics/integration",
    "dynamics/link_poses",
    "dynamics/mass_matrix",
    "dynamics/odometry",
    "kernel_world",
    "kernel_world_type",
    "math/elementary_functions",
    "math/linear_systems",
    "math/simd",
    "math/simd_types",
    "math/spatial_algebra",
    "solver/active_set_newton",
    "solver/attempts",
    "solver/augmented_newton",
    "solver/delassus",
    "solver/penalty_rows",
    "solver/row_states",
    "solver/sliding_contacts",
    "solver/tree_guesses",
    "solver/tree_matrix",
    "sleep/robot_sleep",
    "sleep/sleep_criteria",
    "sleep/tree_rest",
    "stepping/ballistic",
    "stepping/robot_step",
)
"""Modules of this package with compiled functions, for one robot on its plane."""
WORLD_FOLDERS = ("collision", "contacts", "dynamics", "island_solver", "sleep", "stepping")
"""Sub-packages with the compiled functions that worlds of several bodies need in addition."""

Kernel = Callable[..., int]
Progress = Callable[[int], None]
"""Called with the number of functions compiled so far, beginning with 0, if any function must be compiled."""


def kernel() -> Kernel:
    """Return the compiled `advance`, from the cache where there is one; see `LiveKernels`."""
    return _native(world=False) or _interpreted(world=False) or _compile(world=False)


def world_kernel() -> Kernel:
    """Return the compiled `world_step.advance`, from the cache where there is one; see `LiveKernels`."""
    return _native(world=True) or _interpreted(world=True) or _compile(world=True)


class LiveKernels:
    """Kernels that Python interprets until another process has compiled them.

    Args:
        report: receives a message when a kernel is interpreted, and None when it is compiled.
        warn: receives a message if a kernel cannot be compiled in another process.
    """

    def __init__(self, report: Callable[[str | None], None], warn: Callable[[str], None]) -> None:
        self._report, self._warn = report, warn
        self._kernels: dict[bool, InterpretedKernel] = {}

    @contextmanager
    def used(self) -> Iterator[None]:
        """Inside the context, `kernel` and `world_kernel` return these kernels in this thread."""
        token = _live.set(self)
        try:
            yield
        finally:
            _live.reset(token)

    def close(self) -> None:
        """End the processes that compile."""
        for each in self._kernels.values():
            each.close()

    def kernel(self, *, world: bool) -> InterpretedKernel:
        """Return a kernel; the first call for it starts the process that compiles it."""
        if world not in self._kernels:
            self._report("compiling the physics kernel; until then the simulation is slow …")
            self._kernels[world] = InterpretedKernel(
                _advance(world=world),
                CompilingProcess("world" if world else "robot"),
                load=_code(world=world).load,
                compiled_here=lambda: _compile(world=world),
                ready=lambda: self._ready(world=world),
                warn=self._warn,
            )
        return self._kernels[world]

    def _ready(self, *, world: bool) -> None:
        _native.cache_clear()
        if world == next(reversed(self._kernels)):
            self._report(None)


_live: ContextVar[LiveKernels | None] = ContextVar("live kernels", default=None)


def _interpreted(*, world: bool) -> Kernel | None:
    """Return a kernel that is interpreted until it is compiled; None outside of `LiveKernels.used`."""
    live = _live.get()
    return live.kernel(world=world) if live is not None else None


def _advance(*, world: bool) -> Kernel:
    """Return the function of a kernel in Python."""
    if world:
        from urdfkit.sim.engine.stepping.world_step import advance
    else:
        from urdfkit.sim.engine.stepping.robot_step import advance
    return advance


def announcement(*, world: bool = False) -> str:
    """Return the message before a compilation, with the kernel and its approximate duration."""
    from urdfkit.compilation.duration import announced_duration

    # The durations are measured on an idle machine.
    what, seconds = (" for worlds that hold bodies", 50) if world else ("", 22)
    return f"compiling the physics kernel{what}, once, {announced_duration(seconds)} …"


def warmup(progress: Progress | None = None, *, world: bool = False) -> bool:
    """Make the kernel ready to run; return whether it had to be compiled (see `announcement`) rather than loaded.

    Inside `LiveKernels.used` this does nothing.

    Args:
        progress: called with 0 before a compilation starts and with a growing count while it runs.
        world: whether it is the kernel for a world of several bodies, rather than for one robot on its plane.
    """
    if _native(world=world) is not None or _live.get() is not None:
        return False
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
    return _digest(_robot_sources())


def world_digest() -> str:
    """Return a digest of the sources of the kernel for worlds."""
    return _digest(_world_sources())


def _robot_sources() -> tuple[Path, ...]:
    return *own_sources(), *((Path(__file__).parent / f"{name}.py") for name in KERNEL_MODULES)


def _world_sources() -> tuple[Path, ...]:
    folders = (sorted((Path(__file__).parent / folder).glob("*.py")) for folder in WORLD_FOLDERS)
    return *_robot_sources(), *(path for folder in folders for path in folder)


def _digest(sources: Sequence[Path]) -> str:
    digest = hashlib.sha256()
    for path in sources:
        digest.update(path.read_bytes())
    return digest.hexdigest()


def _code(*, world: bool) -> NativeCode:
    name, sources = ("world_step", _world_sources()) if world else ("robot_step", _robot_sources())
    return NativeCode(name, sources, cache_folders(Path(__file__).parent))


@lru_cache
def _native(*, world: bool) -> NativeFunction | None:
    """Return a kernel from its file of machine code, without numba; None without a file for these sources."""
    return _code(world=world).load()


@lru_cache
def _compile(*, world: bool) -> Kernel:
    """Compile a kernel with numba, and write its machine code for later processes."""
    import numba

    from urdfkit.compilation.load import TESTED_VERSIONS

    digest, code = world_digest() if world else sources_digest(), _code(world=world)
    # numba's cache is needed where machine code is not written, or exists and cannot be loaded.
    cache = code.exists or numba.__version__ not in TESTED_VERSIONS
    dispatcher = _compiled(_advance(world=world), ("floats", "integers", "count", "count"), digest, cache=cache)
    return write_native(code, dispatcher, arrays=2) or next(iter(dispatcher.overloads.values())).entry_point


@lru_cache
def load_compiled(function: Callable[..., int], arguments: tuple[str, ...], *, digest: str | None = None) -> Kernel:
    """Compile a function for these types of arguments, or load it from the cache.

    Returns the compiled function instead of numba's dispatcher, which checks the types of all arguments in each call
    and takes longer than the call. Therefore, arrays of other types are not detected.
    """
    return next(iter(_compiled(function, arguments, digest or sources_digest()).overloads.values())).entry_point  # type: ignore[no-any-return]


def _compiled(function: Callable[..., int], arguments: tuple[str, ...], digest: str, *, cache: bool = True) -> Any:
    """Return numba's dispatcher of a function that is compiled for these types of arguments."""
    import numba

    from urdfkit.compilation import compile_or_load
    from urdfkit.sim.engine.compilation import OPTIONS, register_types

    register_types()
    types = {"floats": numba.float64[::1], "integers": numba.int64[::1], "count": numba.int64}
    signature = tuple(types[name] for name in arguments)
    return compile_or_load(function, signature, digest=digest, options=OPTIONS, cache=cache)


def main(kernel: str) -> None:
    """Compile a kernel, ``robot``, ``world`` or ``rays``; end when the standard input ends."""

    def watch() -> None:
        sys.stdin.read()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()
    if kernel == "rays":
        from urdfkit.scene.rays import warmup as compile_rays

        compile_rays()
    else:
        warmup(world=kernel == "world")
