"""Reader of ``template.toml``; errors are reported at their line."""

import re
import sys
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, NoReturn, get_args, get_type_hints

from urdfkit.errors import ResourceError, did_you_mean
from urdfkit.file_replacement import read_bytes
from urdfkit.scaffold.templates.expressions import names_in
from urdfkit.scaffold.templates.template_schema import Check, Fact, Layer, Next, Word
from urdfkit.scaffold.templates.questions import Question, When
from urdfkit.scaffold.templates.template import FRESH, Template

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib  # type: ignore[import-not-found, unused-ignore]

NAME = "template.toml"

_TEXT, _TEXTS, _TABLE, _FLAG, _NUMBERS, _TABLES = (
    "a string",
    "a list of strings",
    "a table",
    "true or false",
    "two numbers",
    "a list of tables",
)
_KEYS: dict[str, dict[str, str]] = {
    "": {"summary": _TEXT, "recipe": _TEXT, "teleop": _TEXT, "examples": _TEXTS},
    "question": {
        **dict.fromkeys(("name", "prompt", "kind", "default", "unit", "pattern", "help"), _TEXT),
        **dict.fromkeys(("choices", "suffixes"), _TEXTS),
        **dict.fromkeys(("when", "default_for", "called"), _TABLE),
        "range": _NUMBERS,
        "interactive": _FLAG,
    },
    "word": {"name": _TEXT, "by": _TEXT, "values": _TABLE},
    "fact": {"name": _TEXT, "any": _TABLES},
    "check": {"holds": _TEXT, "otherwise": _TEXT, "when": _TABLE},
    "layer": {"folder": _TEXT, "into": _TEXTS, "when": _TABLE, "append": _FLAG, "spare": _FLAG},
    "next": {"title": _TEXT, "commands": _TEXTS, "when": _TABLE},
}
"""Keys of each kind of table, with the type of the value; "" is the top level of the file."""

_REQUIRED = {
    "": ("summary", "layer"),
    "question": ("name", "prompt", "kind"),
    "word": ("name", "by", "values"),
    "fact": ("name", "any"),
    "check": ("otherwise",),
    "layer": ("folder",),
    "next": ("commands",),
}

_NAMED = r"\{([a-z][a-z0-9_]*)\}"
"""Question in the message of a check, which names its option."""


def load_template(
    folder: Path, *, source: str = "", name: str = "", options: Mapping[str, str] | None = None
) -> Template:
    """Read the ``template.toml`` of a template.

    Args:
        folder: folder of the template.
        source: the folder as the user gave it, for a template that is not bundled.
        name: name of the template, if it differs from the folder's name.
        options: question → its option, where it is not the name of the question.

    Raises:
        ResourceError: the file is missing or invalid; the message has the line and the nearest valid name.
    """
    path = folder / NAME
    try:
        text = read_bytes(path).decode("utf-8")
    except UnicodeDecodeError as error:
        raise ResourceError(f"{path} is not UTF-8: {error.reason}") from error
    return _template(path, text, source, name or folder.name, tuple(sorted((options or {}).items())))


@lru_cache(maxsize=16)
def _template(path: Path, text: str, source: str, name: str, options: tuple[tuple[str, str], ...]) -> Template:
    """Return the template of a text; see `load_template`."""
    try:
        table = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise ResourceError(_placed(path, str(error), text.count("\n") + 1)) from error
    return _TemplateReader(path, text, table, dict(options)).template(source, name)


def _placed(path: Path, message: str, last: int) -> str:
    """Return the message of the TOML parser with ``FILE:LINE:COLUMN`` in front."""
    if place := re.search(r" \(at line (\d+), column (\d+)\)", message):
        return f"{path}:{place[1]}:{place[2]}: {message.replace(place[0], '')}"
    return f"{path}:{last}: {message.replace(' (at end of document)', ', found the end of the file')}"


class _TemplateReader:
    """Converts the checked tables of one file into a template."""

    def __init__(self, path: Path, text: str, table: dict[str, Any], options: Mapping[str, str]) -> None:
        self._path, self._lines, self._table, self._options = path, text.splitlines(), table, options
        self._values: dict[str, tuple[str, ...]] = {FRESH: ("yes", "no")}
        self._starts: dict[str, list[int]] = {}
        for number, line in enumerate(self._lines):
            if found := re.match(r"\s*\[\[\s*(\w+)\s*\]\]", line):
                self._starts.setdefault(found[1], []).append(number)

    def template(self, source: str, name: str) -> Template:
        """Return the template."""
        kinds = [kind for kind in _KEYS if kind]
        self._check("", 0, {key: value for key, value in self._table.items() if key not in kinds})
        questions = [self._question(index, entry) for index, entry in enumerate(self._entries("question"))]
        facts = [
            Fact(entry["name"], tuple(self._when("fact", index, {"when": when}) for when in entry["any"]))
            for index, entry in enumerate(self._entries("fact"))
        ]
        self._values |= {fact.name: ("yes", "no") for fact in facts}
        return Template(
            folder=self._path.parent,
            summary=self._table["summary"],
            questions=tuple(questions),
            words=tuple(self._word(index, entry) for index, entry in enumerate(self._entries("word"))),
            layers=tuple(self._layer(index, entry) for index, entry in enumerate(self._entries("layer"))),
            checks=tuple(self._checked(index, entry, questions) for index, entry in enumerate(self._entries("check"))),
            next=tuple(
                Next(entry.get("title", ""), tuple(entry["commands"]), self._when("next", index, entry))
                for index, entry in enumerate(self._entries("next"))
            ),
            recipe=self._table.get("recipe", ""),
            examples=tuple(self._table.get("examples", ())),
            facts=tuple(facts),
            source=source,
            name=name,
            teleop=self._table.get("teleop", ""),
        )

    def _question(self, index: int, entry: dict[str, Any]) -> Question:
        kinds = get_args(get_type_hints(Question)["kind"])
        if entry["kind"] not in kinds:
            near = did_you_mean(entry["kind"], kinds) or f"; choose from: {', '.join(kinds)}"
            self._error("question", index, "kind", f"unknown kind of question `{entry['kind']}`{near}")
        when = self._when("question", index, entry)
        values: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in entry.items()}
        question = Question(**values | {"when": when, "own_option": self._options.get(entry["name"], "")})
        if not re.fullmatch(r"[a-z][a-z0-9_]*", question.name):
            self._error("question", index, "name", f"`{question.name}` is not a valid placeholder: use a-z, 0-9 and _")
        if question.name in self._values:
            self._error("question", index, "name", f"question `{question.name}` is defined twice")
        for meant in question.called.values():
            if meant not in question.choices:
                near = did_you_mean(str(meant), question.choices)
                self._error("question", index, "called", f"`{meant}` is not an answer to `{question.name}`{near}")
        for key, defaults in (("default", {"": question.default or ""}), *question.default_for.items()):
            for default in defaults.values() if isinstance(defaults, dict) else ():
                self._computable("question", index, "default_for" if key != "default" else key, default)
        self._values[question.name] = ("yes", "no") if question.kind == "flag" else question.choices
        return question

    def _word(self, index: int, entry: dict[str, Any]) -> Word:
        if entry["by"] not in self._values:
            self._error(
                "word", index, "by", f"unknown question `{entry['by']}`{did_you_mean(entry['by'], self._values)}"
            )
        for value in entry["values"].values():
            self._computable("word", index, "values", value, named=False)
        return Word(entry["name"], entry["by"], entry["values"])

    def _checked(self, index: int, entry: dict[str, Any], questions: list[Question]) -> Check:
        if entry.get("holds"):
            self._computable("check", index, "holds", entry["holds"], comparison=True)
        options = {question.name: question.option for question in questions}
        named = re.findall(_NAMED, entry["otherwise"])
        for name in named:
            if name not in options:
                near = did_you_mean(name, options)
                self._error("check", index, "otherwise", f"unknown question `{name}`{near}")
        message = re.sub(_NAMED, lambda found: options[found[1]], entry["otherwise"])
        return Check(entry.get("holds", ""), message, self._when("check", index, entry), tuple(named))

    def _computable(
        self, kind: str, index: int, key: str, value: object, *, named: bool = True, comparison: bool = False
    ) -> None:
        """Check a comparison, or a text that is an expression because it begins with ``=``.

        With `named`, every name in it must be an earlier question. Words may use computed placeholders, too.
        """
        if not isinstance(value, str) or not (comparison or value.startswith("=")):
            return
        try:
            names = names_in(value.removeprefix("=").strip(), comparison=comparison)
        except ResourceError as error:
            self._error(kind, index, key, error.message)
        for name in sorted(names - set(self._values) if named else ()):
            self._error(kind, index, key, f"no earlier question `{name}`{did_you_mean(name, self._values)}")

    def _layer(self, index: int, entry: dict[str, Any]) -> Layer:
        return Layer(
            entry["folder"],
            tuple(entry.get("into", (".",))),
            self._when("layer", index, entry),
            entry.get("append", False),
            entry.get("spare", False),
            self._line("layer", index, "into"),
        )

    def _when(self, kind: str, index: int, entry: Mapping[str, Any]) -> When:
        """Return the enabling answers of an entry; its questions must be defined earlier, and its answers be valid."""
        for name, values in entry.get("when", {}).items():
            if name not in self._values:
                self._error(kind, index, "when", f"no earlier question `{name}`{did_you_mean(name, self._values)}")
            if not _is(_TEXTS, values):
                self._error(kind, index, "when", f"`{name}` must be {_TEXTS}")
            for value in values:
                if self._values[name] and value not in self._values[name]:
                    near = did_you_mean(value, self._values[name])
                    self._error(kind, index, "when", f"`{value}` is not an answer to `{name}`{near}")
        return {name: tuple(values) for name, values in entry.get("when", {}).items()}

    def _entries(self, kind: str) -> list[dict[str, Any]]:
        """Return the tables of one kind, with their keys checked."""
        entries = self._table.get(kind, [])
        if not _is(_TABLES, entries):
            self._error("", 0, kind, f"`{kind}` must be {_TABLES}: [[{kind}]]")
        for index, entry in enumerate(entries):
            self._check(kind, index, entry)
        return list(entries)

    def _check(self, kind: str, index: int, entry: Mapping[str, Any]) -> None:
        types = _KEYS[kind]
        for key, value in entry.items():
            if key not in types:
                near = did_you_mean(key, [*types, *(_KEYS if not kind else ())])
                self._error(kind, index, key, f"unknown key `{key}` in {f'a [[{kind}]]' if kind else 'a template'}{near}")
            if not _is(types[key], value):
                number = isinstance(value, int | float) and not isinstance(value, bool) and types[key] == _TEXT
                example = f': {key} = "{value}"' if number else ""
                self._error(kind, index, key, f"`{key}` must be {types[key]}{example}")
        for key in _REQUIRED[kind]:
            if key not in entry and not (not kind and key in self._table):
                owner = f"this [[{kind}]]" if kind else "the template"
                self._error(kind, index, "", f"{owner} has no `{key}`")

    def _error(self, kind: str, index: int, key: str, message: str) -> NoReturn:
        """Report an error in one table, at the line of the key.

        Raises:
            ResourceError: always.
        """
        raise ResourceError(f"{self._path}:{self._line(kind, index, key)}: {message}")

    def _line(self, kind: str, index: int, key: str) -> int:
        """Return the line of a key in one table, or of the table if the key is missing."""
        start = 0
        if kind:
            starts = self._starts.get(kind, ())
            start = starts[index] if index < len(starts) else 0
        for number in range(start + bool(kind), len(self._lines) if key else 0):
            line = self._lines[number]
            if re.match(rf"""\s*\[*(\w+\.)?["']?{re.escape(key)}["']?\s*[\].=]""", line):
                return number + 1
            if kind and re.match(r"\s*\[\[", line):
                break
        return start + 1


def _is(type_name: str, value: object) -> bool:
    if type_name == _TEXT:
        return isinstance(value, str)
    if type_name == _FLAG:
        return isinstance(value, bool)
    if type_name == _TABLE:
        return isinstance(value, dict)
    if not isinstance(value, list):
        return False
    if type_name == _NUMBERS:
        return len(value) == 2 and all(isinstance(number, int | float) for number in value)
    return all(isinstance(each, str if type_name == _TEXTS else dict) for each in value)
