"""A template's ``template.toml``: what is wrong with it is said with its line."""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NoReturn, get_args, get_type_hints

from urdfkit.errors import ResourceError, did_you_mean
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
    "a text",
    "a list of texts",
    "a table",
    "true or false",
    "two numbers",
    "a list of tables",
)
_KEYS: dict[str, dict[str, str]] = {
    "": {"summary": _TEXT, "asks_later": _TEXTS, "recipe": _TEXT, "teleop": _TEXT, "examples": _TEXTS},
    "question": {
        **dict.fromkeys(("name", "prompt", "kind", "default", "unit", "pattern", "help"), _TEXT),
        **dict.fromkeys(("choices", "suffixes"), _TEXTS),
        **dict.fromkeys(("when", "default_for", "called"), _TABLE),
        "range": _NUMBERS,
        "ask": _FLAG,
    },
    "word": {"name": _TEXT, "by": _TEXT, "says": _TABLE},
    "fact": {"name": _TEXT, "any": _TABLES},
    "check": {"holds": _TEXT, "otherwise": _TEXT, "when": _TABLE},
    "layer": {"folder": _TEXT, "into": _TEXTS, "when": _TABLE, "append": _FLAG, "spare": _FLAG},
    "next": {"title": _TEXT, "commands": _TEXTS, "when": _TABLE},
}
"""What each sort of table may hold, and what it has to be; "" is the file itself."""

_NEEDED = {
    "": ("summary", "layer"),
    "question": ("name", "prompt", "kind"),
    "word": ("name", "by", "says"),
    "fact": ("name", "any"),
    "check": ("otherwise",),
    "layer": ("folder",),
    "next": ("commands",),
}


def load_template(folder: Path, *, source: str = "", called: str = "") -> Template:
    """Read the ``template.toml`` of a template.

    Args:
        folder: the template.
        source: the folder as it was given, of a template that is not ours.
        called: its name, where that is not its folder's.

    Raises:
        ResourceError: there is none, or it is wrong: file, line, what, and the nearest right thing.
    """
    path = folder / NAME
    try:
        text = path.read_text(encoding="utf-8")
        table = tomllib.loads(text)
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ResourceError(f"{path} is not UTF-8: {error.reason}") from error
    except tomllib.TOMLDecodeError as error:
        raise ResourceError(_placed(path, str(error), text.count("\n") + 1)) from error
    return _Reader(path, text, table).template(source, called or folder.name)


def _placed(path: Path, said: str, last: int) -> str:
    """Return what the TOML parser said, its place in front as everywhere."""
    if found := re.search(r" \(at line (\d+), column (\d+)\)", said):
        return f"{path}:{found[1]}:{found[2]}: {said.replace(found[0], '')}"
    return f"{path}:{last}: {said.replace(' (at end of document)', ', and then it ends')}"


class _Reader:
    """Turns the tables of one file into a template, each checked."""

    def __init__(self, path: Path, text: str, table: dict[str, Any]) -> None:
        self._path, self._lines, self._table = path, text.splitlines(), table
        self._known: dict[str, tuple[str, ...]] = {FRESH: ("yes", "no")}

    def template(self, source: str, name: str) -> Template:
        """Return the whole."""
        sorts = [sort for sort in _KEYS if sort]
        self._check("", 0, {key: value for key, value in self._table.items() if key not in sorts})
        questions = [self._question(index, entry) for index, entry in enumerate(self._entries("question"))]
        facts = [
            Fact(entry["name"], tuple(self._when("fact", index, {"when": when}) for when in entry["any"]))
            for index, entry in enumerate(self._entries("fact"))
        ]
        self._known |= {fact.name: ("yes", "no") for fact in facts}
        return Template(
            folder=self._path.parent,
            summary=self._table["summary"],
            questions=tuple(questions),
            asks_later=tuple(self._table.get("asks_later", ())),
            words=tuple(self._word(index, entry) for index, entry in enumerate(self._entries("word"))),
            layers=tuple(self._layer(index, entry) for index, entry in enumerate(self._entries("layer"))),
            checks=tuple(self._checked(index, entry) for index, entry in enumerate(self._entries("check"))),
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
            near = did_you_mean(entry["kind"], kinds) or f"; there is: {', '.join(kinds)}"
            self._error("question", index, "kind", f"no kind of question `{entry['kind']}`{near}")
        when = self._when("question", index, entry)
        values: dict[str, Any] = {k: tuple(v) if isinstance(v, list) else v for k, v in entry.items()}
        question = Question(**values | {"when": when})
        if not re.fullmatch(r"[a-z][a-z0-9_]*", question.name):
            self._error("question", index, "name", f"`{question.name}` cannot be a placeholder: a-z, 0-9 and _")
        if question.name in self._known:
            self._error("question", index, "name", f"`{question.name}` is there twice")
        for meant in question.called.values():
            if meant not in question.choices:
                near = did_you_mean(str(meant), question.choices)
                self._error("question", index, "called", f"`{meant}` is no answer to `{question.name}`{near}")
        for key, defaults in (("default", {"": question.default or ""}), *question.default_for.items()):
            for default in defaults.values() if isinstance(defaults, dict) else ():
                self._computable("question", index, "default_for" if key != "default" else key, default)
        self._known[question.name] = ("yes", "no") if question.kind == "flag" else question.choices
        return question

    def _word(self, index: int, entry: dict[str, Any]) -> Word:
        if entry["by"] not in self._known:
            self._error("word", index, "by", f"no question `{entry['by']}`{did_you_mean(entry['by'], self._known)}")
        for said in entry["says"].values():
            self._computable("word", index, "says", said, named=False)
        return Word(**entry)

    def _checked(self, index: int, entry: dict[str, Any]) -> Check:
        if entry.get("holds"):
            self._computable("check", index, "holds", entry["holds"], comparison=True)
        return Check(entry.get("holds", ""), entry["otherwise"], self._when("check", index, entry))

    def _computable(
        self, sort: str, index: int, key: str, said: object, *, named: bool = True, comparison: bool = False
    ) -> None:
        """Look at an expression, or at a text, which is one when it begins with ``=``; its names have to be questions.

        What words may also name is not `named` in the file: what is worked out for our own templates.
        """
        if not isinstance(said, str) or not (comparison or said.startswith("=")):
            return
        try:
            names = names_in(said.removeprefix("=").strip(), comparison=comparison)
        except ResourceError as error:
            self._error(sort, index, key, str(error).removeprefix("template: "))
        for name in sorted(names - set(self._known) if named else ()):
            self._error(sort, index, key, f"no question `{name}` before{did_you_mean(name, self._known)}")

    def _layer(self, index: int, entry: dict[str, Any]) -> Layer:
        return Layer(
            entry["folder"],
            tuple(entry.get("into", (".",))),
            self._when("layer", index, entry),
            entry.get("append", False),
            entry.get("spare", False),
            self._line("layer", index, "into"),
        )

    def _when(self, sort: str, index: int, entry: Mapping[str, Any]) -> When:
        """Return the answers that something is for; every question and every answer has to be one."""
        for name, values in entry.get("when", {}).items():
            if name not in self._known:
                self._error(sort, index, "when", f"no question `{name}` before{did_you_mean(name, self._known)}")
            if not _is(_TEXTS, values):
                self._error(sort, index, "when", f"`{name}` has to be {_TEXTS}")
            for value in values:
                if self._known[name] and value not in self._known[name]:
                    near = did_you_mean(value, self._known[name])
                    self._error(sort, index, "when", f"`{value}` is no answer to `{name}`{near}")
        return {name: tuple(values) for name, values in entry.get("when", {}).items()}

    def _entries(self, sort: str) -> list[dict[str, Any]]:
        """Return the tables of a sort, each with the right keys."""
        entries = self._table.get(sort, [])
        if not _is(_TABLES, entries):
            self._error("", 0, sort, f"`{sort}` has to be {_TABLES}: [[{sort}]]")
        for index, entry in enumerate(entries):
            self._check(sort, index, entry)
        return list(entries)

    def _check(self, sort: str, index: int, entry: Mapping[str, Any]) -> None:
        known = _KEYS[sort]
        for key, value in entry.items():
            if key not in known:
                near = did_you_mean(key, [*known, *(_KEYS if not sort else ())])
                self._error(sort, index, key, f"no `{key}` in {f'a [[{sort}]]' if sort else 'a template'}{near}")
            if not _is(known[key], value):
                number = isinstance(value, int | float) and not isinstance(value, bool) and known[key] == _TEXT
                meant = f': {key} = "{value}"' if number else ""
                self._error(sort, index, key, f"`{key}` has to be {known[key]}{meant}")
        for key in _NEEDED[sort]:
            if key not in entry and not (not sort and key in self._table):
                self._error(sort, index, "", f"{f'this [[{sort}]]' if sort else 'the template'} lacks its `{key}`")

    def _error(self, sort: str, index: int, key: str, message: str) -> NoReturn:
        """Raise.

        Raises:
            ResourceError: always, with the line of that key in the table of that sort and number.
        """
        raise ResourceError(f"{self._path}:{self._line(sort, index, key)}: {message}")

    def _line(self, sort: str, index: int, key: str) -> int:
        """Return the line of a key in the table of that sort and number; where it is not there, that of the table."""
        start = 0
        if sort:
            heads = [i for i, line in enumerate(self._lines) if re.match(rf"\s*\[\[\s*{sort}\s*\]\]", line)]
            start = heads[index] if index < len(heads) else 0
        for number in range(start + bool(sort), len(self._lines) if key else 0):
            line = self._lines[number]
            if re.match(rf"""\s*\[*(\w+\.)?["']?{re.escape(key)}["']?\s*[\].=]""", line):
                return number + 1
            if sort and re.match(r"\s*\[\[", line):
                break
        return start + 1


def _is(what: str, value: object) -> bool:
    if what == _TEXT:
        return isinstance(value, str)
    if what == _FLAG:
        return isinstance(value, bool)
    if what == _TABLE:
        return isinstance(value, dict)
    if not isinstance(value, list):
        return False
    if what == _NUMBERS:
        return len(value) == 2 and all(isinstance(number, int | float) for number in value)
    return all(isinstance(each, str if what == _TEXTS else dict) for each in value)
