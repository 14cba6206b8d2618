"""Values of expressions: plain Python data, and the few kinds of our own that an expression can hold.

A value is a number, a text, a list, tuple, set or dictionary of values, a range or slice, or one of the classes below.
Nothing reads an attribute of a value by a name from a file: `attributes` lists what each kind of value offers.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


class YamlList(list[object]):
    """A list of a YAML file, whose items are wrapped when they are read."""

    def __getitem__(self, index: Any) -> Any:
        """Return an item, or a slice, wrapped."""
        return wrapped(super().__getitem__(index))

    def __iter__(self) -> Any:
        """Yield the items, wrapped."""
        return map(wrapped, super().__iter__())


class YamlDict(dict[object, object]):
    """A mapping of a YAML file, whose keys can be read as attributes."""

    def __getitem__(self, key: Any) -> Any:
        """Return a value, wrapped.

        Raises:
            AttributeError: unknown key.
        """
        try:
            return wrapped(super().__getitem__(key))
        except KeyError:
            raise AttributeError(f"The yaml dictionary has no key '{key}'") from None


def wrapped(value: Any) -> Any:
    """Return a value of a YAML file with its containers wrapped."""
    if isinstance(value, dict):
        return YamlDict(value)
    return YamlList(value) if isinstance(value, list) else value


class Function:
    """A function that expressions can call.

    Args:
        name: as it is shown.
        call: computes the result; its arguments are values.
        owner: the kind of value whose method it is, for the text that is shown.
    """

    __slots__ = ("_shown", "call", "name")

    def __init__(self, name: str, call: Callable[..., Any], shown: str | None = None) -> None:
        self.name, self.call, self._shown = name, call, shown or f"<built-in function {name}>"

    def __repr__(self) -> str:
        """Return what Python shows."""
        return self._shown

    def bound(self, value: Any) -> Function:
        """Return the method of one value."""
        return Function(self.name, partial(self.call, value))


class Type(Function):
    """A type that expressions can call, compare and pass to ``isinstance``.

    Args:
        kind: Python's type.
        call: makes a value of it.
    """

    __slots__ = ("kind",)

    def __init__(self, kind: type, call: Callable[..., Any]) -> None:
        super().__init__(kind.__name__, call, f"<class '{kind.__name__}'>")
        self.kind = kind

    def __eq__(self, other: object) -> bool:
        """Whether both are the same type."""
        return isinstance(other, Type) and other.kind is self.kind

    def __hash__(self) -> int:
        """Return the hash of the type."""
        return hash(self.kind)
