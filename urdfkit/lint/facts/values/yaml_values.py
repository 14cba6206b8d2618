"""Values in YAML files that a description loads."""

from __future__ import annotations

import ast
from pathlib import Path

from urdfkit.description.xml.reader import read_source, shown_path
from urdfkit.errors import DescriptionError, ResourceError
from urdfkit.lint.facts.values.expression_paths import Keys

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.control.settings import Settings
    from urdfkit.description.xml.source import Position, Source
    from urdfkit.lint.model.model import Model

_YAML = (".yaml", ".yml", ".json")


class UnresolvedError(Exception):
    """The source of a value cannot be found.

    Attributes:
        lacking: the group or list of a YAML file that lacks the key, and the key.
    """

    lacking: tuple[Settings, str | int] | None = None


class YamlValues:
    """The values in the YAML files of one model.

    Args:
        model: the linted model.
    """

    def __init__(self, model: Model) -> None:
        self._model = model
        self._yaml: dict[Path, Settings | None] = {}

    def value(self, file: ast.expr, keys: Keys) -> tuple[Position, str]:
        """Return the value of some keys in the YAML file that an expression names, and its place.

        Raises:
            UnresolvedError: there is no such value, or several files have one.
        """
        named = [str(node.value) for node in ast.walk(file) if isinstance(node, ast.Constant)]
        paths = [path for path in self._model.expanded.files if path.suffix in _YAML]
        if len(paths) > 1:
            ends = [part.rpartition(")")[2].strip("/") for part in named]
            paths = [path for path in paths if all(end in str(path) for end in ends)]
        found = [setting for path in paths if (setting := self._setting(path, keys)) is not None]
        if len(found) != 1 or found[0].value is None:
            error = UnresolvedError()
            if len(paths) == 1:
                error.lacking = next(
                    (
                        (group, keys[at])
                        for at in range(len(keys))
                        if self._setting(paths[0], keys[: at + 1]) is None
                        and (group := self._setting(paths[0], keys[:at])) is not None
                    ),
                    None,
                )
            raise error
        return found[0].position, found[0].value

    def _setting(self, path: Path, keys: Keys) -> Settings | None:
        if path not in self._yaml:
            from urdfkit.description.control.parameter_yaml import parse_settings

            try:
                self._yaml[path] = parse_settings(self._source(path), separator="\0")
            except (DescriptionError, ResourceError):
                self._yaml[path] = None
        found = self._yaml[path]
        for key in keys:
            if found is not None and found.items is not None:
                found = (
                    found.items[key] if isinstance(key, int) and -len(found.items) <= key < len(found.items) else None
                )
            elif found is not None:
                found = found.children.get(str(key))
        return found

    def _source(self, path: Path) -> Source:
        return read_source(path, shown_as=shown_path(path), texts=self._model.texts)
