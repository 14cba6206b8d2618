"""Records: frozen dataclasses without the cost of defining them.

``@dataclass`` writes and compiles five methods for every class, about a millisecond each, and imports `inspect`: for
the classes of a robot that takes as long as expanding a whole xacro file. A record shares its methods with all records
instead. Where start-up time matters (description, lint), plain data classes are records; elsewhere use dataclasses.

`dataclasses.fields`, `replace` and `asdict` work on records, and type checkers see dataclasses.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from typing_extensions import dataclass_transform
else:

    def dataclass_transform(**_):
        """Substitute for the decorator, which only type checkers use."""
        return lambda function: function


class _Field:
    """Arguments of `field` for one attribute."""

    __slots__ = ("default", "factory", "repr")

    def __init__(self, default: Any, factory: Any, repr: bool) -> None:
        self.default, self.factory, self.repr = default, factory, repr


_MISSING = object()


def field(*, default: Any = _MISSING, default_factory: Any = None, repr: bool = True) -> Any:
    """Describe an attribute: its default or default factory, and whether `repr` shows it."""
    return _Field(default, default_factory, repr)


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
def record(cls: Any = None, /, *, eq: bool = True, order: bool = False) -> Any:
    """Make a class with annotated attributes a frozen record.

    Args:
        cls: the class.
        eq: records with equal attributes are equal and hash alike; otherwise they compare by identity.
        order: records sort by their attributes, in order. Only together with `eq`.
    """
    if cls is None:
        return lambda cls: _prepare(cls, eq, order)
    return _prepare(cls, eq, order)


def _prepare(cls: Any, eq: bool, order: bool) -> Any:
    inherited = getattr(cls, "_record_names", ())
    own = [name for name, kind in cls.__annotations__.items() if "ClassVar" not in str(kind)]
    defaults: dict[str, Any] = dict(getattr(cls, "_record_defaults", {}))
    factories: dict[str, Any] = dict(getattr(cls, "_record_factories", {}))
    hidden = set(getattr(cls, "_record_hidden", ()))
    for name in own:
        if name not in cls.__dict__:
            continue
        value = cls.__dict__[name]
        if isinstance(value, _Field):
            if not value.repr:
                hidden.add(name)
            if value.default is _MISSING:
                delattr(cls, name)
                if value.factory is not None:
                    factories[name] = value.factory
                continue
            value = value.default
            setattr(cls, name, value)
        defaults[name] = value
    cls._record_names = (*inherited, *own)
    cls._record_defaults = defaults
    cls._record_factories = factories
    cls._record_hidden = frozenset(hidden)
    cls._record_post = getattr(cls, "__post_init__", None)
    cls.__match_args__ = cls._record_names  # type: ignore[misc]
    cls.__dataclass_fields__ = _Fields()
    if "__init__" not in cls.__dict__:
        cls.__init__ = _init
    if "__repr__" not in cls.__dict__:
        cls.__repr__ = _repr
    cls.__setattr__ = _frozen
    cls.__delattr__ = _frozen
    if eq:
        cls.__eq__ = _eq
        cls.__hash__ = _hash
    if order:
        cls.__lt__ = _lt
        cls.__le__ = _le
        cls.__gt__ = _gt
        cls.__ge__ = _ge
    return cls


class _Fields:
    """The dataclass fields of a record, built on first access."""

    def __get__(self, instance: object, owner: Any) -> Any:
        import dataclasses

        body: dict[str, Any] = {}
        for name in owner._record_names:
            options: dict[str, Any] = {"repr": name not in owner._record_hidden}
            if name in owner._record_defaults:
                options["default"] = owner._record_defaults[name]
            elif name in owner._record_factories:
                options["default_factory"] = owner._record_factories[name]
            body[name] = dataclasses.field(**options)
        body["__annotations__"] = dict.fromkeys(owner._record_names, "object")
        twin: Any = dataclasses.dataclass(type(owner.__name__, (), body))
        owner.__dataclass_fields__ = twin.__dataclass_fields__
        return owner.__dataclass_fields__


def _init(self: Any, *args: Any, **kwargs: Any) -> None:
    cls = type(self)
    names = cls._record_names
    values = self.__dict__
    if not kwargs and len(args) == len(names):  # by far the most frequent: thousands of places for each file
        values.update(zip(names, args))  # noqa: B905 - the count is checked above
        if cls._record_post is not None:
            cls._record_post(self)
        return
    if cls._record_defaults:
        values.update(cls._record_defaults)
    values.update(zip(names, args))  # noqa: B905 - the count is checked below
    values.update(kwargs)
    for name, make in cls._record_factories.items():
        if name not in values:
            values[name] = make()
    doubled = args and kwargs and not kwargs.keys().isdisjoint(names[: len(args)])
    if doubled or len(args) > len(names) or len(values) != len(names):
        _refuse(cls, args, kwargs)
    if cls._record_post is not None:
        cls._record_post(self)


def _refuse(cls: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    names = cls._record_names
    if len(args) > len(names):
        raise TypeError(f"{cls.__name__}() takes {len(names)} arguments but {len(args)} were given")
    for name in kwargs:
        if name not in names:
            raise TypeError(f"{cls.__name__}() got an unexpected keyword argument {name!r}")
        if name in names[: len(args)]:
            raise TypeError(f"{cls.__name__}() got multiple values for argument {name!r}")
    supplied = {*names[: len(args)], *kwargs, *cls._record_defaults, *cls._record_factories}
    missing = ", ".join(repr(name) for name in names if name not in supplied)
    raise TypeError(f"{cls.__name__}() missing arguments: {missing}")


def _values(self: Any) -> tuple[Any, ...]:
    values = self.__dict__
    return tuple([values[name] for name in type(self)._record_names])


def _repr(self: Any) -> str:
    cls = type(self)
    shown = (f"{name}={self.__dict__[name]!r}" for name in cls._record_names if name not in cls._record_hidden)
    return f"{cls.__qualname__}({', '.join(shown)})"


def _eq(self: Any, other: object) -> Any:
    return _values(self) == _values(other) if type(other) is type(self) else NotImplemented


def _hash(self: Any) -> int:
    return hash(_values(self))


def _lt(self: Any, other: object) -> Any:
    return _values(self) < _values(other) if type(other) is type(self) else NotImplemented


def _le(self: Any, other: object) -> Any:
    return _values(self) <= _values(other) if type(other) is type(self) else NotImplemented


def _gt(self: Any, other: object) -> Any:
    return _values(self) > _values(other) if type(other) is type(self) else NotImplemented


def _ge(self: Any, other: object) -> Any:
    return _values(self) >= _values(other) if type(other) is type(self) else NotImplemented


def _frozen(self: object, name: str, *_: object) -> None:
    from dataclasses import FrozenInstanceError

    raise FrozenInstanceError(f"cannot assign to field {name!r}")
