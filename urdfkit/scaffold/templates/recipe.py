"""The answers to a template's questions as a TOML file, which makes the same again."""

from __future__ import annotations

import hashlib
import json
import shlex
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold.templates.placeholders import inside
from urdfkit.scaffold.templates.questions import Question, applies
from urdfkit.scaffold.templates.template import Template, wanted

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib  # type: ignore[import-not-found, unused-ignore]


MADE = "made"
"""The table of a recipe that says what was made, and when: no answers."""


@dataclass(frozen=True, slots=True)
class Made:
    """What a recipe says was made from it.

    Attributes:
        kind: the template's name.
        year: of the copyright.
        source: the folder of a template that is not ours, as it was given; empty for ours.
        digests: of each file that was written, by its path from the folder it was written to.
    """

    kind: str
    year: str
    source: str
    digests: Mapping[str, str]


def digest(content: bytes) -> str:
    """Return what tells a file that was edited from one that was not.

    Args:
        content: of the file.
    """
    return hashlib.sha256(content).hexdigest()[:16]


def recipe_text(template: Template, answers: Mapping[str, str], digests: Mapping[str, str]) -> str:
    """Return the file that holds these answers, without those to questions that are for other answers.

    Args:
        template: what asked.
        answers: answers by question, with the built-in ones.
        digests: of what was written, by path.
    """
    kind = template.name
    again = _command(kind, template.source)
    lines = [
        f"# Again: {again} --from FILE, or in place urdfkit new --update; options change what is here.",
        f'template = "{kind}"',
    ]
    lines += [
        f"{question.name} = {_value(question, answers[question.name])}"
        for question in template.questions
        if applies(question.when, answers)
    ]
    lines += ["", "# What was written, so that --update leaves alone what you edit. Not for you to edit.", f"[{MADE}]"]
    lines += [f'year = "{answers["year"]}"'] if "year" in answers else []
    lines += [f"source = {json.dumps(template.source, ensure_ascii=False)}"] if template.source else []
    lines += ["", f"[{MADE}.files]", *(f"{json.dumps(path)} = {json.dumps(said)}" for path, said in digests.items())]
    return "\n".join(lines) + "\n"


def read_made(path: Path) -> Made:
    """Return what a recipe says was made from it.

    Args:
        path: the file.

    Raises:
        ResourceError: it cannot be read, or names a file outside of where it was written to.
    """
    table = _read(path)
    made = table.get(MADE)
    made = made if isinstance(made, dict) else {}
    files = made.get("files")
    return Made(
        str(table.get("template", "")),
        str(made.get("year", "")),
        str(made.get("source", "")),
        {inside(name, where=str(path)).as_posix(): str(said) for name, said in files.items()}
        if isinstance(files, dict)
        else {},
    )


def _read(path: Path, before: str = "") -> dict[str, Any]:
    try:
        table: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
        return table
    except OSError as error:
        raise ResourceError(f"{before}{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ResourceError(f"{before}{path} is not UTF-8: {error.reason}") from error
    except tomllib.TOMLDecodeError as error:
        raise ResourceError(f"{before}{path}: {error}") from error


def read_recipe(template: Template, path: Path, instead: Mapping[str, str]) -> dict[str, str]:
    """Return the answers in a file, with those given `instead` in their place.

    An answer of the file to a question that is for other answers after those given `instead` is left out.

    Args:
        template: what asks.
        path: the file.
        instead: answers by question.

    Raises:
        ResourceError: it cannot be read.
        UsageError: an answer of it is wrong, or for other answers than it holds, or it is another template's.
    """
    table = _read(path, "--from ")
    made = table.pop(MADE, None)
    kind = table.pop("template", template.name)
    if kind != template.name:
        source = str(made.get("source", "")) if isinstance(made, dict) else ""
        mine = _command(template.name, template.source)
        raise UsageError(f"{path} is for `{_command(str(kind), source)}`, not for `{mine}`")
    try:
        found = {
            name: question.accept(_text(question, value))
            for name, value in table.items()
            if (question := template.question(name))
        }
    except UsageError as error:
        raise UsageError(f"{path}: {error}") from error
    for question in [q for q in template.questions if q.name in found]:
        # What followed from other answers does so again.
        follows = question.default_for or (question.default or "").startswith("=")
        if follows and instead and found[question.name] == _default(question, found):
            del found[question.name]
    for question in _astray(template, found):
        if found[question.name] not in ("no", ""):
            raise UsageError(f"{path}: {question.name} is for {wanted(question.when)}")
    found |= instead
    for question in _astray(template, found):
        if question.name not in instead:
            del found[question.name]
    return found


def _astray(template: Template, found: Mapping[str, str]) -> list[Question]:
    """Return the questions that are answered, and for other answers than those."""
    known: dict[str, str] = {}
    astray = []
    for question in template.questions:
        default = _default(question, known) or ""
        if question.name in found and not applies(question.when, known):
            astray.append(question)
            known[question.name] = default
        else:
            known[question.name] = found.get(question.name, default)
    return astray


def _command(kind: str, source: str) -> str:
    """Return the command that makes something from a template: ours by its name, any other by its folder."""
    return f"urdfkit new robot --template {shlex.quote(source)}" if source else f"urdfkit new {kind}"


def _default(question: Question, answers: Mapping[str, str]) -> str | None:
    """Return the default after these answers; None where there are not enough of them."""
    try:
        return question.default_given(answers)
    except ResourceError:
        return None


def _value(question: Question, answer: str) -> str:
    if question.kind == "number":
        return answer
    if question.kind == "flag":
        return "true" if answer == "yes" else "false"
    # What JSON makes of a text is a string of TOML, too, but for one character.
    text = json.dumps(answer.split() if question.several else answer, ensure_ascii=False)
    return text.replace("\x7f", "\\u007f")


def _text(question: Question, value: object) -> str:
    """Return a value of TOML as it would be typed."""
    if isinstance(value, list) and all(isinstance(entry, str) for entry in value):
        return " ".join(value)
    if isinstance(value, (str, int, float)) and not isinstance(value, bool):
        return str(value)
    if isinstance(value, bool) and question.kind == "flag":
        return "yes" if value else "no"
    raise UsageError(f"`{question.name}` is neither a text nor a number nor a list of texts")
