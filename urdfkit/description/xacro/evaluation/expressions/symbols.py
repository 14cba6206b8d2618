"""Scopes: the tables of names of files, macros and namespaces, each with its parent."""

from __future__ import annotations

from collections.abc import Mapping

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any, Protocol

    class Host(Protocol):
        """The expansion that scopes belong to."""

        def resolve(self, scope: Scope, name: str) -> Any:
            """Evaluate the text of a name."""

        def redefined(self, name: str) -> None:
            """Warn that a global name is hidden."""

        def place(self) -> Any:
            """Return the place that is being evaluated."""


class Scope:
    """Names of one file, macro call or namespace; missing names are looked up in the parent.

    Attributes:
        values: name → value, or the text of an expression that is not evaluated yet.
        parent: the scope around it, or the global names.
        root: the global names.
        pending: the names whose text is not evaluated yet, with the place it is written at.
        open_names: the names that are being evaluated, outermost first.
        host: the expansion it belongs to; None for the names of macros.
    """

    __slots__ = ("host", "open_names", "parent", "pending", "root", "values")

    def __init__(self, parent: Scope | Mapping[str, Any], host: Host | None = None) -> None:
        self.values: dict[Any, Any] = {}
        self.parent = parent
        self.root: Mapping[str, Any] = parent.root if isinstance(parent, Scope) else parent
        self.pending: dict[str, Any] = {}
        self.open_names: list[str] = []
        self.host: Host | None = parent.host if host is None and isinstance(parent, Scope) else host

    def set(self, name: Any, value: Any, *, is_lazy: bool) -> None:
        """Define a name.

        Args:
            name: of a property, parameter, block (with ``*`` or ``**``) or namespace.
            value: its value; a text that is a number or boolean becomes one.
            is_lazy: evaluate the text when the name is used.
        """
        if self.host is not None and name in self.root:
            self.host.redefined(name)
        self.values[name] = value = literal(value)
        if is_lazy and isinstance(value, str) and self.host is not None:
            self.pending[name] = self.host.place()
        else:
            self.pending.pop(name, None)

    def assign(self, name: str, value: Any) -> None:
        """Replace the text of a name by its value."""
        self.values[name] = literal(value)
        self.pending.pop(name, None)

    def __getitem__(self, name: Any) -> Any:
        """Return the value of a name.

        Raises:
            KeyError: it is not defined.
        """
        scope: Any = self
        while isinstance(scope, Scope):
            if name in scope.values:
                if name in scope.pending and scope.host is not None:
                    return scope.host.resolve(scope, name)
                return scope.values[name]
            scope = scope.parent
        return scope[name]

    def __contains__(self, name: object) -> bool:
        """Whether a name is defined."""
        scope: Any = self
        while isinstance(scope, Scope):
            if name in scope.values:
                return True
            scope = scope.parent
        return name in scope

    def remove(self, name: str) -> None:
        """Remove a name from this scope and all around it."""
        scope: Any = self
        while isinstance(scope, Scope):
            scope.values.pop(name, None)
            scope = scope.parent

    @property
    def outer(self) -> Any:
        """The scope around it, or the global names."""
        return self.parent

    def top(self) -> Scope:
        """Return the outermost scope: that of the file that is expanded."""
        scope = self
        while isinstance(scope.parent, Scope):
            scope = scope.parent
        return scope

    def names(self) -> list[str]:
        """Return the names that are defined here and around, innermost first."""
        found: list[str] = []
        scope: Any = self
        while isinstance(scope, Scope):
            found += [name for name in scope.values if isinstance(name, str)]
            scope = scope.parent
        return found


class Namespace(Scope):
    """A scope whose names are read as attributes: of an include with ``ns``, ``math``, ``python`` or ``xacro``."""

    __slots__ = ()

    def __repr__(self) -> str:
        """Return the text that the namespace has in a formatted string."""
        return "<namespace>"

    @classmethod
    def of(cls, values: Mapping[str, Any]) -> Namespace:
        """Return a namespace with some values."""
        made = cls({})
        made.values.update(values)
        return made


def symbol_of(symbols: Any, name: str) -> Any:
    """Return the value of a name.

    Raises:
        NameError: it is not defined.
    """
    try:
        return symbols[name]
    except KeyError:
        raise NameError(f"name '{name}' is not defined", name=name) from None


def literal(value: Any) -> Any:
    """Return the value of a text: without its single quotes, or the number or boolean it is."""
    if type(value) is not str:
        return value
    if len(value) >= 2 and value[0] == "'" and value[-1] == "'":
        return value[1:-1]
    if "_" in value:
        return value
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            continue
    return _BOOLEANS.get(value, value)


_BOOLEANS = {"true": True, "True": True, "false": False, "False": False}
