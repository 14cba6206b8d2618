"""Parameters of a plugin by meaning; errors contain the position of the invalid parameter."""

from math import isfinite

from urdfkit.description.plugins import PluginSpec, read_all, values
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.source import Position
from urdfkit.errors import SimulationError

_TRUTHS = {"true": True, "1": True, "false": False, "0": False}


class Parameters:
    """Parameters of one plugin, as text, numbers, vectors and flags.

    Args:
        plugin: the plugin as written.
        spec: its table of parameters.
        names: values of the placeholders in defaults, e.g. ``{"model": "simpleton"}``.
    """

    def __init__(self, plugin: Plugin, spec: PluginSpec, names: dict[str, str]) -> None:
        self._plugin = plugin
        self._spec = spec
        self._names = names
        self._texts = read_all(plugin, spec)

    @property
    def generation(self) -> str:
        """Generation of the plugin: ``ros1``, ``ros2`` or ``gz``."""
        return self._spec.generation

    def place(self, meaning: str) -> Position:
        """Return the position of a parameter; the position of the plugin if the parameter is missing."""
        parameter = self._spec.by_meaning(meaning)
        if parameter is not None:
            for text, element in values(self._plugin, parameter):
                if text:
                    return element.origin.position
        return self._plugin.element.origin.position

    def tag(self, meaning: str) -> str:
        """Return the tag of a parameter in this generation."""
        parameter = self._spec.by_meaning(meaning)
        return meaning if parameter is None else parameter.tag

    def has(self, meaning: str) -> bool:
        """Whether a parameter has a value, written or default."""
        return bool(self._texts.get(meaning))

    def texts(self, meaning: str) -> tuple[str, ...]:
        """Return all values of a parameter."""
        found = []
        for text in self._texts.get(meaning, ()):
            for name, value in self._names.items():
                text = text.replace("{" + name + "}", value)
            found.append(text)
        return tuple(found)

    def text(self, meaning: str, default: str = "") -> str:
        """Return the first value of a parameter."""
        found = self.texts(meaning)
        return found[0] if found else default

    def number(self, meaning: str, default: float = 0.0, *, positive: bool = False, unsigned: bool = False) -> float:
        """Return the first value as a number.

        Raises:
            SimulationError: it is not a finite number, or negative or not positive where it must not be.
        """
        found = self.numbers(meaning, positive=positive, unsigned=unsigned)
        return found[0] if found else default

    def numbers(self, meaning: str, *, positive: bool = False, unsigned: bool = False) -> tuple[float, ...]:
        """Return every value as a number.

        Raises:
            SimulationError: a value is not a finite number, or negative or not positive where it must not be.
        """
        found = []
        for text in self.texts(meaning):
            try:
                value = float(text)
            except ValueError:
                value = float("nan")
            if not isfinite(value) or (positive and value <= 0) or (unsigned and value < 0):
                wanted = "a number, zero or greater" if unsigned else "a finite number"
                wanted = "a number greater than zero" if positive else wanted
                raise SimulationError(
                    f"<{self.tag(meaning)}> is `{text}`; it must be {wanted}", position=self.place(meaning)
                )
            found.append(value)
        return tuple(found)

    def vector(self, meaning: str, length: int) -> tuple[float, ...]:
        """Return the first value as `length` numbers separated by blanks; zeros if the parameter is missing.

        Raises:
            SimulationError: it is not `length` finite numbers.
        """
        text = self.text(meaning)
        try:
            found = tuple(float(word) for word in text.split()) or (0.0,) * length
        except ValueError:
            found = ()
        if len(found) != length or not all(isfinite(part) for part in found):
            raise SimulationError(
                f"<{self.tag(meaning)}> is `{text}`; it must be {length} finite numbers", position=self.place(meaning)
            )
        return found

    def flag(self, meaning: str) -> bool:
        """Return the first value as true or false.

        Raises:
            SimulationError: it is neither true nor false.
        """
        text = self.text(meaning, "false")
        if text.lower() not in _TRUTHS:
            raise SimulationError(
                f"<{self.tag(meaning)}> is `{text}`; it must be true or false", position=self.place(meaning)
            )
        return _TRUTHS[text.lower()]
