"""Parameters of a plugin by meaning; errors contain the position of the invalid parameter."""

from urdfkit.description.plugins import PluginSpec, read_all, values
from urdfkit.description.plugins.parameter_values import FLAGS, expected, expected_number, vector
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.source import Position
from urdfkit.errors import SimulationError


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

    def place(self, meaning: str, index: int = 0) -> Position:
        """Return the position of a value of a parameter; the position of the plugin if the parameter is missing."""
        parameter = self._spec.by_meaning(meaning)
        written = () if parameter is None else values(self._plugin, parameter)
        places = [element.origin.position for text, element in written if text]
        return places[index] if index < len(places) else self._plugin.element.origin.position

    def is_written(self, meaning: str) -> bool:
        """Return whether the plugin has a value for a parameter, not only a default."""
        parameter = self._spec.by_meaning(meaning)
        return parameter is not None and any(text for text, _ in values(self._plugin, parameter))

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

    def number(self, meaning: str, default: float = 0.0, *, unsigned: bool = False) -> float:
        """Return the first value as a number.

        Raises:
            SimulationError: a value is not a finite number, or out of range; see `numbers`.
        """
        found = self.numbers(meaning, unsigned=unsigned)
        return found[0] if found else default

    def numbers(self, meaning: str, *, unsigned: bool = False) -> tuple[float, ...]:
        """Return every value as a number.

        Args:
            meaning: meaning of the parameter, which decides whether zero and negative numbers are valid.
            unsigned: refuse negative numbers in any case.

        Raises:
            SimulationError: a value is not a finite number, or out of range.
        """
        texts = self.texts(meaning)
        for index, text in enumerate(texts):
            self._check(meaning, text, expected_number(meaning, text, unsigned=unsigned), index)
        return tuple(map(float, texts))

    def vector(self, meaning: str, length: int) -> tuple[float, ...]:
        """Return the first value as `length` numbers separated by blanks; zeros if the parameter is missing.

        Raises:
            SimulationError: it is not `length` finite numbers.
        """
        text = self.text(meaning)
        found = vector(text, length)
        self._check(meaning, text, "" if found is not None else f"{length} finite numbers")
        return found or ()

    def choice(self, meaning: str, default: str = "") -> str:
        """Return the first value, one of the choices of its parameter.

        Raises:
            SimulationError: the value is not a choice.
        """
        text, parameter = self.text(meaning, default), self._spec.by_meaning(meaning)
        self._check(meaning, text, "" if parameter is None else expected(parameter, text))
        return text.strip()

    def flag(self, meaning: str) -> bool:
        """Return the first value as true or false.

        Raises:
            SimulationError: it is neither true nor false.
        """
        text = self.text(meaning, "false")
        self._check(meaning, text, "" if text.lower() in FLAGS else "true or false")
        return FLAGS[text.lower()]

    def _check(self, meaning: str, text: str, expected: str, index: int = 0) -> None:
        """Raise an error if a value is not as expected."""
        if expected:
            message = f"<{self.tag(meaning)}> is `{text}`; it must be {expected}"
            raise SimulationError(message, position=self.place(meaning, index), code="Z832")
