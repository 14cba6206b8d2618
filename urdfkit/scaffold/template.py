"""A template: a folder whose files come out as they stand, with ``@name@`` replaced by the answers.

The syntax clashes neither with xacro's ``${…}`` and ``$(…)`` nor with XML, Python, YAML or CMake, so a template file
is read, checked and highlighted as what it will be. There are no conditions inside files: layers are laid over each
other, each by the answers it is for.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.resources import templates_dir
from urdfkit.scaffold.expression import holds
from urdfkit.scaffold.question import Question, numbers

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib  # type: ignore[import-not-found, unused-ignore]

_PLACEHOLDER = re.compile(r"@([a-z][a-z0-9_]*)@")
BUILT_IN = ("year", "into")
"""Placeholders that nobody is asked for: the year of a copyright, the folder that is written to."""

When = Mapping[str, tuple[str, ...]]


@dataclass(frozen=True, slots=True)
class Layer:
    """A folder of files that goes `into` some folders of the result, if the answers are among `when`."""

    folder: Path
    into: tuple[str, ...]
    when: When


@dataclass(frozen=True, slots=True)
class Check:
    """A comparison that has to hold between the answers, and what is wrong otherwise."""

    holds: str
    otherwise: str


@dataclass(frozen=True, slots=True)
class Next:
    """Commands to go on with, if the answers are among `when`."""

    title: str
    commands: tuple[str, ...]
    when: When


@dataclass(frozen=True, slots=True)
class Template:
    """What ``urdfkit new NAME`` asks and writes.

    Attributes:
        folder: where it lies.
        summary: what it makes, in a line.
        questions: what it asks, in order.
        asks_later: options that are planned; named in the error when they are used.
        layers: what it writes.
        checks: what has to hold between the answers.
        next: what to do with the result.
    """

    folder: Path
    summary: str
    questions: tuple[Question, ...]
    asks_later: tuple[str, ...]
    layers: tuple[Layer, ...]
    checks: tuple[Check, ...]
    next: tuple[Next, ...]

    def question(self, name: str) -> Question:
        """Return the question of that name.

        Args:
            name: which.

        Raises:
            UsageError: there is none.
        """
        for question in self.questions:
            if question.name == name:
                return question
        raise UsageError(f"no question `{name}`{did_you_mean(name, [q.name for q in self.questions])}")

    def answers(self, given: Mapping[str, str]) -> dict[str, str]:
        """Return an answer to every question: the given ones checked, the others by default.

        Args:
            given: answers by question.

        Raises:
            UsageError: an answer is wrong, missing, or at odds with another.
        """
        for name in given:
            self.question(name)
        found: dict[str, str] = {}
        for question in self.questions:
            answer = given.get(question.name, question.default_given(found))
            if answer is None:
                raise UsageError(f"{question.prompt[0].lower()}{question.prompt[1:]} is missing")
            found[question.name] = question.accept(answer)
        for check in self.checks:
            if not holds(check.holds, numbers(found)):
                raise UsageError(check.otherwise)
        return found

    def files(self, answers: Mapping[str, str]) -> Iterator[tuple[Path, Path]]:
        """Yield every file that is written: where it comes from, and its path in the result.

        Args:
            answers: answers by question, with the built-in ones.

        Raises:
            ResourceError: the template is wrong: two layers write the same file, or a placeholder is unknown.
        """
        written: dict[Path, Path] = {}
        for layer in self.layers:
            if not _applies(layer.when, answers):
                continue
            for source in _sources(layer.folder):
                for folder in layer.into:
                    name = fill(f"{folder}/{source.relative_to(layer.folder).as_posix()}", answers, where=str(source))
                    target = Path(name)
                    if target in written:
                        raise ResourceError(f"template: {source} and {written[target]} both become {target}")
                    written[target] = source
                    yield source, target

    def render(self, answers: Mapping[str, str], folder: Path) -> list[Path]:
        """Write the files into `folder`.

        Args:
            answers: answers by question, with the built-in ones.
            folder: has to exist.

        Returns:
            The paths written, relative to `folder`.

        Raises:
            ResourceError: the template is wrong, or the folder cannot be written.
        """
        targets = []
        for source, target in self.files(answers):
            try:
                text = source.read_text(encoding="utf-8")
                (folder / target).parent.mkdir(parents=True, exist_ok=True)
                with (folder / target).open("w", encoding="utf-8", newline="\n") as file:
                    file.write(fill(text, answers, where=str(source)))
            except OSError as error:
                raise ResourceError(f"cannot write {folder / target}: {error.strerror}") from error
            except UnicodeDecodeError as error:
                raise ResourceError(f"template: {source} is not UTF-8: {error.reason}") from error
            targets.append(target)
        return targets

    def next_steps(self, answers: Mapping[str, str]) -> list[tuple[str, list[str]]]:
        """Return commands to go on with, in groups: a title (empty for the first) and the lines.

        Args:
            answers: answers by question, with the built-in ones.

        Raises:
            ResourceError: the template is wrong.
        """
        where = f"{self.folder}/template.toml"
        return [
            (fill(step.title, answers, where=where), [fill(line, answers, where=where) for line in step.commands])
            for step in self.next
            if _applies(step.when, answers)
        ]


def _sources(folder: Path) -> list[Path]:
    # pip compiles the launch files among our data, too.
    return sorted(path for path in folder.rglob("*") if path.is_file() and "__pycache__" not in path.parts)


def fill(text: str, answers: Mapping[str, str], *, where: str) -> str:
    """Return `text` with every ``@name@`` replaced.

    Args:
        text: of a file, or its path.
        answers: what the names stand for.
        where: named in the error.

    Raises:
        ResourceError: a placeholder is unknown.
    """

    def answer(match: re.Match[str]) -> str:
        if match[1] not in answers:
            line = text.count("\n", 0, match.start()) + 1
            column = match.start() - text.rfind("\n", 0, match.start())
            raise ResourceError(f"{where}:{line}:{column}: no question `{match[1]}`{did_you_mean(match[1], answers)}")
        return answers[match[1]]

    return _PLACEHOLDER.sub(answer, text)


def template_names() -> list[str]:
    """Return the names of the templates we ship, sorted.

    Raises:
        ResourceError: the installation is incomplete.
    """
    return sorted(path.parent.name for path in templates_dir().glob("*/template.toml"))


def load_template(folder: Path) -> Template:
    """Read the ``template.toml`` of a template.

    Args:
        folder: the template.

    Raises:
        ResourceError: there is none, or it is wrong.
    """
    path = folder / "template.toml"
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error
    except tomllib.TOMLDecodeError as error:
        raise ResourceError(f"{path}: {error}") from error
    try:
        return _template(folder, table)
    except (KeyError, TypeError) as error:
        raise ResourceError(f"{path}: missing or unknown key: {error}") from error


def _template(folder: Path, table: dict[str, Any]) -> Template:
    return Template(
        folder=folder,
        summary=table["summary"],
        questions=tuple(Question(**_tuples(entry)) for entry in table.get("question", ())),
        asks_later=tuple(table.get("asks_later", ())),
        layers=tuple(
            Layer(folder / entry["folder"], tuple(entry.get("into", (".",))), _when(entry)) for entry in table["layer"]
        ),
        checks=tuple(Check(**entry) for entry in table.get("check", ())),
        next=tuple(
            Next(entry.get("title", ""), tuple(entry["commands"]), _when(entry)) for entry in table.get("next", ())
        ),
    )


def _tuples(entry: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in entry.items()}


def _when(entry: dict[str, Any]) -> When:
    return {name: tuple(values) for name, values in entry.get("when", {}).items()}


def _applies(when: When, answers: Mapping[str, str]) -> bool:
    return all(answers[name] in values for name, values in when.items())
