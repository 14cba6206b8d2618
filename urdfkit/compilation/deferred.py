"""Objects of numba that are made on first use, so that a module with compiled functions does not import numba."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


class Deferred:
    """Object of numba that is made on first use, such as by a kernel that is compiled.

    Args:
        make: returns the object.
    """

    def __init__(self, make: Callable[[], Any]) -> None:
        self._make = make
        self._made: Any = None

    def _object(self) -> Any:
        if self._made is None:
            self._made = self._make()
        return self._made

    @property
    def _numba_type_(self) -> Any:
        """The type of the object for numba, which compiles calls of it."""
        from numba.core.registry import cpu_target

        return cpu_target.typing_context.resolve_value_type(self._object())

    def __call__(self, *arguments: Any) -> Any:
        """Call the compiled function from Python."""
        return self._object()(*arguments)

    def __getattr__(self, name: str) -> Any:
        """Return an attribute of the object."""
        return getattr(self._object(), name)
