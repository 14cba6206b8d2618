"""The answers to a template's questions as a TOML file, which makes the same again."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold.question import Question, applies
from urdfkit.scaffold.template import Template

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib  # type: ignore[import-not-found, unused-ignore]


def recipe_text(template: Template, answers: Mapping[str, str]) -> str:
    """Return the file that holds these answers, without those to questions that are for other answers.

    Args:
        template: what asked.
        answers: answers by question.
    """
    kind = template.folder.name
    lines = [
        f"# The same again: urdfkit new {kind} --from FILE, options changing what is here.",
        f'template = "{kind}"',
    ]
    lines += [
        f"{question.name} = {_value(question, answers[question.name])}"
        for question in template.questions
        if applies(question.when, answers)
    ]
    return "\n".join(lines) + "\n"


def read_recipe(template: Template, path: Path, instead: Mapping[str, str]) -> dict[str, str]:
    """Return the answers in a file, with those given `instead` in their place.

    An answer of the file to a question that is for other answers, after that, is left out.

    Args:
        template: what asks.
        path: the file.
        instead: answers by question.

    Raises:
        ResourceError: it cannot be read.
        UsageError: an answer of it is wrong, or it is another template's.
    """
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ResourceError(f"--from {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise ResourceError(f"--from {path} is not UTF-8: {error.reason}") from error
    except tomllib.TOMLDecodeError as error:
        raise ResourceError(f"--from {path}: {error}") from error
    kind = table.pop("template", template.folder.name)
    if kind != template.folder.name:
        raise UsageError(f"--from {path} is for `urdfkit new {kind}`, not for `urdfkit new {template.folder.name}`")
    try:
        found = {
            name: question.accept(_text(question, value))
            for name, value in table.items()
            if (question := template.question(name))
        }
    except UsageError as error:
        raise UsageError(f"{path}: {error}") from error
    found |= instead
    known = {question.name: question.default or "" for question in template.questions} | found
    for question in template.questions:
        if question.name not in instead and not applies(question.when, known):
            found.pop(question.name, None)
    return found


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
