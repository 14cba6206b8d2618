"""Results of functions that read files and folders, kept during one check: each file is read once for all rules."""

from __future__ import annotations

from contextlib import contextmanager
from contextvars import ContextVar
from functools import wraps

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any, ParamSpec, TypeVar

    Parameters = ParamSpec("Parameters")
    Result = TypeVar("Result")

_MAX_LENGTH = 32 * 2**20
"""Largest total length of the texts that are kept."""


class _Results(dict["tuple[Any, ...]", "Any"]):
    """Results by function and arguments.

    Attributes:
        left: length of the texts that can still be kept.
    """

    left = _MAX_LENGTH


_results: ContextVar[_Results | None] = ContextVar("_results", default=None)


@contextmanager
def keeping_results() -> Iterator[None]:
    """Keep the results of functions with the decorator `kept` while the context is entered."""
    outer = _results.get()
    token = _results.set(_Results() if outer is None else outer)
    try:
        yield
    finally:
        _results.reset(token)


def kept(read: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Return a function of positional arguments that is called once for each of them in `keeping_results`."""

    @wraps(read)
    def current(*arguments: Parameters.args, **no_names: Parameters.kwargs) -> Result:
        results = _results.get()
        if results is None:
            return read(*arguments, **no_names)
        key = (read, *arguments)
        if key in results:
            found: Result = results[key]
            return found
        result = read(*arguments, **no_names)
        length = len(result) if isinstance(result, str) else 0
        if length <= results.left:
            results[key] = result
            results.left -= length
        return result

    return current
