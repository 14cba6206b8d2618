"""Recipes: the answers to a template's questions as a TOML file, which reproduces the same packages."""

import hashlib
import json
import shlex
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from urdfkit.errors import ResourceError, UsageError
from urdfkit.missing_files import missing_path
from urdfkit.scaffold.templates.placeholders import path_inside
from urdfkit.scaffold.templates.questions import Question, applies
from urdfkit.scaffold.templates.template import Template, required_options

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib  # type: ignore[import-not-found, unused-ignore]


MADE = "made"
"""Name of the table of a recipe that records the written files; it holds no answers."""


@dataclass(frozen=True, slots=True)
class Made:
    """Record of the files that were written with a recipe.

    Attributes:
        kind: name of the template.
        year: year of the copyright.
        source: folder of a template that is not bundled, as the user gave it; empty for bundled templates.
        digests: digest of each file that was written, by its path relative to the output folder.
    """

    kind: str
    year: str
    source: str
    digests: Mapping[str, str]


def digest(content: bytes) -> str:
    """Return the digest of a file, by which ``--update`` detects edited files.

    Args:
        content: the bytes of the file.
    """
    return hashlib.sha256(content).hexdigest()[:16]


def recipe_text(template: Template, answers: Mapping[str, str], digests: Mapping[str, str]) -> str:
    """Return a recipe with these answers, without answers to questions that are not enabled.

    Args:
        template: the template.
        answers: answers by question, including the built-in placeholders.
        digests: digests of the written files, by path.
    """
    kind = template.name
    command = _command(kind, template.source)
    lines = [
        f"# To write the same files again: {command} --from FILE. To update them in place: urdfkit new --update. "
        "Options replace answers.",
        f'template = "{kind}"',
    ]
    lines += [
        f"{question.name} = {_value(question, answers[question.name])}"
        for question in template.questions
        if applies(question.when, answers)
    ]
    lines += ["", "# Digests of the files as written; --update uses them to keep your edits. Do not edit.", f"[{MADE}]"]
    lines += [f'year = "{answers["year"]}"'] if "year" in answers else []
    lines += [f"source = {json.dumps(template.source, ensure_ascii=False)}"] if template.source else []
    lines += [
        "",
        f"[{MADE}.files]",
        *(f"{json.dumps(path)} = {json.dumps(checksum)}" for path, checksum in digests.items()),
    ]
    return "\n".join(lines) + "\n"


def read_made(path: Path) -> Made:
    """Return the record of written files in a recipe.

    Args:
        path: the recipe.

    Raises:
        ResourceError: the recipe cannot be read, or names a file outside the output folder.
    """
    table = _read(path)
    made = table.get(MADE)
    made = made if isinstance(made, dict) else {}
    files = made.get("files")
    return Made(
        str(table.get("template", "")),
        str(made.get("year", "")),
        str(made.get("source", "")),
        {path_inside(name, where=str(path)).as_posix(): str(checksum) for name, checksum in files.items()}
        if isinstance(files, dict)
        else {},
    )


def _read(path: Path, prefix: str = "") -> dict[str, Any]:
    try:
        table: dict[str, Any] = tomllib.loads(path.read_text(encoding="utf-8"))
        return table
    except FileNotFoundError as error:
        raise ResourceError(f"{prefix and '--from: '}{missing_path(path)}") from error
    except OSError as error:
        raise ResourceError(f"{prefix}{path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ResourceError(f"{prefix}{path} is not UTF-8: {error.reason}") from error
    except tomllib.TOMLDecodeError as error:
        raise ResourceError(f"{prefix}{path}: {error}") from error


def read_recipe(template: Template, path: Path, overrides: Mapping[str, str]) -> dict[str, str]:
    """Return the answers of a recipe, replaced by `overrides` where both answer a question.

    Answers of the recipe to questions that `overrides` disables are dropped.

    Args:
        template: the template.
        path: the recipe.
        overrides: answers by question.

    Raises:
        ResourceError: the recipe cannot be read.
        UsageError: an answer is invalid, its question is not enabled, or the recipe belongs to another template.
    """
    table = _read(path, "--from ")
    made = table.pop(MADE, None)
    kind = table.pop("template", template.name)
    if kind != template.name:
        source = str(made.get("source", "")) if isinstance(made, dict) else ""
        mine = _command(template.name, template.source)
        raise UsageError(f"{path} is a recipe for `{_command(str(kind), source)}`, not for `{mine}`")
    try:
        answers = {
            name: question.accept(_text(question, value))
            for name, value in table.items()
            if (question := template.question(name))
        }
    except UsageError as error:
        raise UsageError(f"{path}: {error}") from error
    for question in [q for q in template.questions if q.name in answers]:
        # Defaults that depend on other answers are computed again.
        depends = question.default_for or (question.default or "").startswith("=")
        if depends and overrides and answers[question.name] == _default(question, answers):
            del answers[question.name]
    for question in _not_enabled(template, answers):
        if answers[question.name] not in ("no", ""):
            raise UsageError(f"{path}: `{question.name}` requires {required_options(question.when)}")
    answers |= overrides
    for question in _not_enabled(template, answers):
        if question.name not in overrides:
            del answers[question.name]
    return answers


def _not_enabled(template: Template, answers: Mapping[str, str]) -> list[Question]:
    """Return the questions that are answered although other answers do not enable them."""
    effective: dict[str, str] = {}
    not_enabled = []
    for question in template.questions:
        default = _default(question, effective) or ""
        if question.name in answers and not applies(question.when, effective):
            not_enabled.append(question)
            effective[question.name] = default
        else:
            effective[question.name] = answers.get(question.name, default)
    return not_enabled


def _command(kind: str, source: str) -> str:
    """Return the command for a template: by name if it is bundled, otherwise by folder."""
    return f"urdfkit new robot --template {shlex.quote(source)}" if source else f"urdfkit new {kind}"


def _default(question: Question, answers: Mapping[str, str]) -> str | None:
    """Return the default after these answers; None if an answer that it depends on is missing."""
    try:
        return question.default_after(answers)
    except ResourceError:
        return None


def _value(question: Question, answer: str) -> str:
    if question.kind == "number":
        return answer
    if question.kind == "flag":
        return "true" if answer == "yes" else "false"
    # A JSON string is a valid TOML string except for the character DEL.
    text = json.dumps(answer.split() if question.several else answer, ensure_ascii=False)
    return text.replace("\x7f", "\\u007f")


def _text(question: Question, value: object) -> str:
    """Return a TOML value as it would be typed on the command line."""
    if isinstance(value, list) and all(isinstance(entry, str) for entry in value):
        return " ".join(value)
    if isinstance(value, (str, int, float)) and not isinstance(value, bool):
        return str(value)
    if isinstance(value, bool) and question.kind == "flag":
        return "yes" if value else "no"
    raise UsageError(f"`{question.name}` must be a string, a number or a list of strings")
