"""Settings: a parameter or a group of parameters, with the source position of each and strict access to its value."""

from __future__ import annotations

from collections.abc import Iterator
from math import isfinite

from urdfkit.description.xml.source import Position
from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.record import field, record

_TRUTHS = {"true": True, "yes": True, "on": True, "1": True, "false": False, "no": False, "off": False, "0": False}


@record(eq=False)
class Settings:
    """A parameter, or a group of them.

    Attributes:
        name: last part of the parameter's name.
        position: source position of the value.
        value: text of the value; None for a list or a group.
        items: entries of a list; None for other parameters.
        children: name → parameter in a group.
        key: source position of the name.
    """

    name: str
    position: Position
    value: str | None = None
    items: tuple[Settings, ...] | None = None
    children: dict[str, Settings] = field(default_factory=dict)
    key: Position | None = None

    @property
    def place(self) -> Position:
        """Source position of the name, or of the value if the parameter has no name."""
        return self.key or self.position

    def find(self, path: str) -> Settings | None:
        """Return a parameter by path such as ``pid/p``; None if it is missing."""
        found: Settings | None = self
        for part in path.split("/"):
            if part and found is not None:
                found = found.children.get(part)
        return found

    def group(self, path: str) -> Settings:
        """Return a group by path; an empty group at this position if it is missing."""
        return self.find(path) or Settings(path.rpartition("/")[2], self.position, key=self.key)

    def text(self, path: str, default: str | None = None) -> str:
        """Return a parameter's text.

        Raises:
            DescriptionError: the parameter is a list or group, or is missing without a default.
        """
        found = self._scalar(path)
        if found is None or found.value is None:
            if default is None:
                raise self._missing(path)
            return default
        return found.value

    def number(self, path: str, default: float | None = None, *, unset: bool = False) -> float:
        """Return a parameter as a number.

        Args:
            path: path of the parameter, such as ``pid/p``.
            default: value of a missing parameter; None for a required parameter.
            unset: treat ``nan`` as missing (ROS 2).

        Raises:
            DescriptionError: the parameter is not a finite number, or is missing without a default.
        """
        found = self._scalar(path)
        if found is None or (unset and default is not None and (found.value or "").lower().strip(".") == "nan"):
            if default is None:
                raise self._missing(path)
            return default
        return _number(found, path)

    def numbers(self, path: str, default: tuple[float, ...]) -> tuple[float, ...]:
        """Return a list of numbers.

        Raises:
            DescriptionError: the parameter is not a list of numbers.
        """
        found = self.find(path)
        if found is None:
            return default
        if found.items is None:
            raise DescriptionError(f"`{path}` must be a list of numbers", position=found.position)
        return tuple([_number(item, path) for item in found.items])

    def flag(self, path: str, default: bool) -> bool:
        """Return a parameter as true or false.

        Raises:
            DescriptionError: the parameter is neither.
        """
        found = self._scalar(path)
        if found is None or found.value is None:
            return default
        if found.value.lower() not in _TRUTHS:
            raise DescriptionError(f"`{path}` is `{found.value}`; it must be true or false", position=found.position)
        return _TRUTHS[found.value.lower()]

    def entry(self, path: str) -> Settings:
        """Return a required parameter with a single value.

        Raises:
            DescriptionError: the parameter is a list or a group, or is missing.
        """
        self.text(path)
        return self.group(path)

    def texts(self, path: str, *, required: bool = False) -> tuple[Settings, ...]:
        """Return the entries of a list of strings; a single string is a list of one, a missing parameter an empty list.

        Raises:
            DescriptionError: the parameter or an entry of it is a group, or a required list is missing or empty.
        """
        found = self.find(path)
        if found is None or (found.value is None and found.items is None and not found.children):
            entries: tuple[Settings, ...] = ()
        else:
            entries = (found,) if found.items is None else found.items
        if required and not entries:
            raise self._missing(path)
        for entry in entries:
            if entry.value is None:
                raise DescriptionError(f"`{path}` must be a name or a list of names", position=entry.position)
        return entries

    def merged(self, other: Settings) -> Settings:
        """Return these parameters overridden by `other`, as ``rosparam load`` does."""
        if not self.children or not other.children:
            return other
        children = dict(self.children)
        for name, child in other.children.items():
            children[name] = children[name].merged(child) if name in children else child
        return Settings(self.name, self.position, None, None, children, self.key)

    def below(self, namespace: str) -> Settings:
        """Return a tree with these parameters under a namespace."""
        found = self
        for part in reversed([part for part in namespace.split("/") if part]):
            found = Settings("", self.position, None, None, {part: found}, self.key)
        return found

    def walk(self) -> Iterator[tuple[str, Settings]]:
        """Yield every group below this one with its path, outermost first."""
        for name, child in self.children.items():
            if child.children:
                yield name, child
                for path, inner in child.walk():
                    yield f"{name}/{path}", inner

    def _scalar(self, path: str) -> Settings | None:
        found = self.find(path)
        if found is not None and (found.items is not None or found.children):
            raise DescriptionError(f"`{path}` must be a single value", position=found.position)
        return found

    def _missing(self, path: str) -> DescriptionError:
        old = self.children.get(path.removesuffix("_names")) if path.endswith("_names") else None
        if old is not None:
            hint = f", but `{old.name}`, its name in ROS 1"
            return DescriptionError(f"`{self.name}` has no `{path}`" + hint, position=old.place)
        hint = did_you_mean(path, self.children) or ", which is required"
        return DescriptionError(f"`{self.name}` has no `{path}`" + hint, position=self.place)


def _number(found: Settings, path: str) -> float:
    try:
        value = float(found.value or "")
    except ValueError:
        value = float("nan")
    if not isfinite(value):
        raise DescriptionError(
            f"`{path}` is `{found.value or ''}`; it must be a finite number", position=found.position
        )
    return value
