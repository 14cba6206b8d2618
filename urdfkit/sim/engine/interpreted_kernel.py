"""Kernels interpreted by Python, some hundred times slower, while another process compiles them.

The functions of a kernel run as they are written, on the memory of the engine, so that the compiled kernel continues
from the same state. Only the last bits of a step differ, where a product and a sum are one instruction when compiled.
"""

from __future__ import annotations

from collections.abc import Callable
from types import FunctionType
from typing import Any, Protocol

from numpy.typing import NDArray

from urdfkit.sim.engine.compilation import KernelFunction
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.scalar_views import numbers
from urdfkit.sim.engine.simulation_memory import FLOATS, INTEGERS, At

Kernel = Callable[..., int]


class Compiling(Protocol):
    """Process that compiles a kernel."""

    @property
    def ended(self) -> bool:
        """Whether it has ended, with or without success."""

    @property
    def fault(self) -> str | None:
        """Why it failed; None if it has not."""

    def wait(self) -> None:
        """Wait until it has ended."""

    def close(self) -> None:
        """End it."""


class InterpretedKernel:
    """Kernel that is interpreted until its compiled code can be loaded.

    If the process fails, the kernel remains interpreted.

    Args:
        advance: the kernel's function.
        process: compiles it into the cache.
        load: returns the compiled kernel; None if the cache does not contain it.
        compiled_here: compiles the kernel in this process.
        ready: called when the compiled kernel is in use, or the process has failed.
        warn: receives the reason if it is not used as soon as the process has ended.
    """

    def __init__(
        self,
        advance: Kernel,
        process: Compiling,
        *,
        load: Callable[[], Kernel | None],
        compiled_here: Callable[[], Kernel],
        ready: Callable[[], None],
        warn: Callable[[str], None],
    ) -> None:
        self._interpreted = interpreted(advance)
        self._process: Compiling | None = process
        self._load, self._compiled_here, self._ready, self._warn = load, compiled_here, ready, warn
        self._compiled: Kernel | None = None
        self._blocks: tuple[Any, Any] | None = None
        self._world: Any = None

    def close(self) -> None:
        """End the process that compiles."""
        if self._process is not None:
            self._process.close()
            self._process = None

    def __call__(self, floats: NDArray[Any], integers: NDArray[Any], count: int, action: int) -> int:
        """Call the compiled function if there is one, else the interpreted one."""
        if self._process is not None and self._process.ended:
            self._take_over(self._process)
        if self._compiled is not None:
            return self._compiled(floats, integers, count, action)
        before = floats.copy(), integers.copy()
        try:
            done: int = self._interpreted(*self._views(floats, integers), count, action)
        except (ArithmeticError, ValueError):  # infinite or NaN in compiled code, such as a division by zero
            floats[:], integers[:] = before
            if self._process is None:
                self._compiled = self._compiled_here()
            else:
                self._process.wait()
            return self(floats, integers, count, action)
        return done

    def _take_over(self, process: Compiling) -> None:
        """Use the compiled kernel, or keep interpreting if the process has failed."""
        fault = process.fault
        self.close()
        if fault is not None:
            self._warn(f"the physics kernel cannot be compiled, so the simulation remains slow: {fault}")
        else:
            self._compiled = self._load()
            if self._compiled is None:
                self._warn("the compiled physics kernel cannot be stored: the simulation waits for its compilation …")
                self._compiled = self._compiled_here()
        self._ready()

    def _views(self, floats: NDArray[Any], integers: NDArray[Any]) -> tuple[Any, None]:
        if self._blocks is None or self._blocks[0] is not floats:
            self._blocks, self._world = (floats, integers), views(floats, integers)
        return self._world, None


def views(floats: NDArray[Any], integers: NDArray[Any]) -> KernelWorld:
    """Return a `KernelWorld` for interpreted functions."""
    world: Any = KernelWorld()
    world.floats, world.sizes = numbers(floats), numbers(integers)
    for names, block in ((FLOATS, world.floats), (INTEGERS, world.sizes)):
        for name in names:
            setattr(world, name, block[int(integers[At[name]]) :])
    found: KernelWorld = world
    return found


class VectorOfNumbers(tuple[float, ...]):
    """Several numbers of a field, see `math.simd`."""

    __slots__ = ()

    def __add__(self, other: Any) -> VectorOfNumbers:
        """Return the sum, number by number."""
        return VectorOfNumbers([a + b for a, b in zip(self, other, strict=True)])

    def __sub__(self, other: Any) -> VectorOfNumbers:
        """Return the difference, number by number."""
        return VectorOfNumbers([a - b for a, b in zip(self, other, strict=True)])

    def __rmul__(self, factor: Any) -> VectorOfNumbers:
        """Return the multiple."""
        return VectorOfNumbers([factor * a for a in self])


def _load(count: int) -> Callable[[Any, int], VectorOfNumbers]:
    return lambda x, at: VectorOfNumbers(x[at : at + count])


def _store(x: Any, at: int, values: VectorOfNumbers) -> None:
    for k, number in enumerate(values, at):
        x[k] = number


REPLACEMENTS: dict[str, Any] = {
    "world": lambda world, _: world,
    "load4": _load(4),
    "load6": _load(6),
    "load8": _load(8),
    "load16": _load(16),
    "store": _store,
}
"""Functions of the compiler → functions of Python."""

_made: dict[Any, Any] = {}


def interpreted(function: Any) -> Any:
    """Return a copy of a function of a kernel that calls interpreted functions only."""
    if function not in _made:
        names: dict[str, Any] = {"__builtins__": function.__globals__["__builtins__"]}
        _made[function] = FunctionType(function.__code__, names, function.__name__, function.__defaults__)
        for name in function.__code__.co_names:
            if name in REPLACEMENTS:
                names[name] = REPLACEMENTS[name]
            elif name in function.__globals__:
                value = function.__globals__[name]
                names[name] = interpreted(value.python) if isinstance(value, KernelFunction) else value
    return _made[function]
