"""A template: a folder whose files come out as they stand, with ``@name@`` replaced by the answers.

The syntax clashes neither with xacro's ``${…}`` and ``$(…)`` nor with XML, Python, YAML or CMake, so a template file
is read, checked and highlighted as what it will be. There are no conditions inside files: layers are laid over each
other, each by the answers it is for. A line with the placeholder of a question that takes several answers comes once
for each of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.scaffold.templates.expressions import holds, value_of
from urdfkit.scaffold.templates.placeholders import fill, inside, repeat_lines
from urdfkit.scaffold.templates.template_schema import Check, Fact, Layer, Next, Word
from urdfkit.scaffold.templates.questions import Question, When, applies, numbers
from urdfkit.scaffold.templates.answer_suggestions import Goes, remedy

FRESH = "fresh"
"""What a default may depend on beside answers: ``yes`` where the folder written to is new, empty or a fresh clone."""


@dataclass(frozen=True, slots=True)
class Template:
    """What ``urdfkit new NAME`` asks and writes.

    Attributes:
        folder: where it lies.
        summary: what it makes, in a line.
        questions: what it asks, in order.
        asks_later: options that are planned; named in the error when they are used.
        words: placeholders that follow from the answers.
        facts: what follows from the answers, for all of these.
        layers: what it writes.
        checks: what has to hold between the answers.
        next: what to do with the result.
        recipe: the file of the result that keeps the answers; empty for none.
        examples: what may follow ``urdfkit new TEMPLATE``, for its help.
        source: its folder as it was given, of a template that is not ours; empty for ours.
        name: what it is called: the THING of ``urdfkit new``.
        teleop: the folder of the result that can be driven right away; empty for none.
    """

    folder: Path
    summary: str
    questions: tuple[Question, ...]
    asks_later: tuple[str, ...]
    words: tuple[Word, ...]
    layers: tuple[Layer, ...]
    checks: tuple[Check, ...]
    next: tuple[Next, ...]
    recipe: str = ""
    examples: tuple[str, ...] = ()
    facts: tuple[Fact, ...] = ()
    source: str = ""
    name: str = ""
    teleop: str = ""

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

    def answers(self, given: Mapping[str, str], *, fresh: bool = False) -> dict[str, str]:
        """Return an answer to every question: the given ones checked, the others by default; and the facts.

        Args:
            given: answers by question.
            fresh: whether the folder that is written to is new, empty or a fresh clone.

        Raises:
            UsageError: an answer is wrong, missing, or at odds with another.
        """
        for name in given:
            self.question(name)
        found, late = self._filled(given, fresh)
        if wrong := self._wrong(found) or late:
            # One number that makes all of it go, or at least what is wrong.
            others = [check for check in self.checks if check.otherwise != wrong]
            for spared in ([], others):
                if told := remedy(self.questions, given, found, wrong, self._goes(spared, fresh)):
                    raise UsageError(f"{wrong} ({told})")
            raise UsageError(wrong)
        return found

    def contradiction(self, so_far: Mapping[str, str], last: str) -> tuple[str, str]:
        """Return what is wrong between answers when not all are there, and what would do; empty for nothing.

        Only what no later answer can change counts.

        Args:
            so_far: answers by question, with the defaults of those that are not asked.
            last: the question that was answered last.
        """
        known = {q.name: so_far[q.name] for q in self.questions if q.name in so_far and applies(q.when, so_far)}
        try:
            found, _ = self._filled(known, False)
        except UsageError:
            return "", ""
        open_yet = {q.name for q in self.questions if q.ask and q.name not in known and applies(q.when, found)}
        for check in self.checks:
            about = {*re.findall(r"[a-z_]+", check.holds), *check.when}
            if about & open_yet or not applies(check.when, found):
                continue
            if not (check.holds and holds(check.holds, numbers(found))):
                spared = [other for other in self.checks if other is not check]
                question = [self.question(last)]
                return check.otherwise, remedy(question, known, found, check.otherwise, self._goes(spared, False))
        return "", ""

    def _filled(self, given: Mapping[str, str], fresh: bool) -> tuple[dict[str, str], str]:
        """Return an answer to every question, and what is wrong with one that follows from others; empty for nothing.

        Raises:
            UsageError: an answer that was given is wrong, or one is missing.
        """
        found: dict[str, str] = {}
        late = ""
        for question in self.questions:
            if question.name in given and not applies(question.when, found) and not question.declines(given):
                raise UsageError(f"{question.option} is for {wanted(question.when)}")
            answer = given.get(question.name, question.default_given(found | {FRESH: "yes" if fresh else "no"}))
            if answer is None:
                raise UsageError(f"{question.prompt[0].lower()}{question.prompt[1:]} is missing")
            try:
                found[question.name] = question.accept(answer)
            except UsageError:
                if question.name in given or not question.is_computed:
                    raise
                found[question.name] = answer
                if applies(question.when, found):
                    late = late or f"with these sizes {question.out_of_range(answer)}"
        for fact in self.facts:
            found[fact.name] = "yes" if any(applies(when, found) for when in fact.any) else "no"
        return found, late

    def _wrong(self, found: Mapping[str, str], spared: Sequence[Check] = ()) -> str:
        """Return the first thing that is wrong between answers; empty for nothing."""
        for check in self.checks:
            if check in spared or not applies(check.when, found):
                continue
            if not (check.holds and holds(check.holds, numbers(found))):
                return check.otherwise
        return ""

    def _goes(self, spared: Sequence[Check], fresh: bool) -> Goes:
        def goes(given: Mapping[str, str]) -> bool:
            try:
                found, late = self._filled(given, fresh)
            except UsageError:
                return False
            return not (self._wrong(found, spared) or late)

        return goes

    def files(self, answers: Mapping[str, str]) -> Iterator[tuple[Path, Path]]:
        """Yield every file that is written: where it comes from, and its path in the result.

        What is appended comes after what it is appended to, with the same path.

        Args:
            answers: answers by question, with the built-in ones.

        Raises:
            ResourceError: the template is wrong: two layers write the same file, or a placeholder is unknown.
        """
        written: dict[Path, Path] = {}
        for layer in self.layers:
            if not applies(layer.when, answers):
                continue
            for source, target in self._targets(layer, answers):
                if target in written and not layer.append:
                    raise ResourceError(f"template: {source} and {written[target]} both become {target}")
                written[target] = source
                yield source, target

    def _targets(self, layer: Layer, answers: Mapping[str, str]) -> Iterator[tuple[Path, Path]]:
        """Yield the files of a layer, each with its path in the result, which is in the result."""
        place = f"{self.folder}/template.toml:{layer.line}"
        for home, source in self._sources(layer, answers):
            for folder in layer.into:
                name = fill(source.relative_to(home).as_posix(), answers, where=str(source))
                yield source, inside(Path(fill(folder, answers, where=place), name), where=place)

    def spare(self, answers: Mapping[str, str]) -> set[str]:
        """Return what is left out where it is there already: the topmost names of files and folders.

        Args:
            answers: answers by question, with the built-in ones.

        Raises:
            ResourceError: the template is wrong.
        """
        return {
            target.parts[0]
            for layer in self.layers
            if layer.spare and applies(layer.when, answers)
            for _, target in self._targets(layer, answers)
        }

    def _sources(self, layer: Layer, answers: Mapping[str, str]) -> Iterator[tuple[Path, Path]]:
        """Yield the files of a layer, each with the folder of the layer it lies in."""
        several, _ = self._said(answers)
        for name in repeat_lines(f"{layer.folder}\n", several).splitlines():
            home = self.folder / fill(name, answers, where=f"{self.folder}/template.toml")
            if not home.is_dir():
                raise ResourceError(f"template: no folder {home}")
            # pip compiles the launch files among our data, too.
            for path in sorted(home.rglob("*")):
                if path.is_file() and "__pycache__" not in path.parts:
                    yield home, path

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
        several, answers = self._said(answers)
        targets: dict[Path, None] = {}
        for source, target in self.files(answers):
            try:
                text = repeat_lines(source.read_text(encoding="utf-8"), several)
                (folder / target).parent.mkdir(parents=True, exist_ok=True)
                with (folder / target).open("a" if target in targets else "w", encoding="utf-8", newline="\n") as file:
                    file.write(fill(text, answers, where=str(source)))
            except OSError as error:
                raise ResourceError(f"cannot write {folder / target}: {error.strerror}") from error
            except UnicodeDecodeError as error:
                raise ResourceError(f"template: {source} is not UTF-8: {error.reason}") from error
            targets[target] = None
        return list(targets)

    def _said(self, answers: Mapping[str, str]) -> tuple[dict[str, tuple[str, ...]], dict[str, str]]:
        """Return what has several values, and the answers with the words that follow from them."""
        several = {q.name: tuple(answers[q.name].split()) for q in self.questions if q.several}
        single = dict(answers)
        for word in self.words:
            where = f"{self.folder}/template.toml"
            if word.by in several:
                several[word.name] = tuple(str(word.says[one]) for one in several[word.by] if one in word.says)
                continue
            said = word.says.get(answers[word.by])
            if said is None:
                raise ResourceError(f"{where}: word `{word.name}` says nothing for {word.by} `{answers[word.by]}`")
            if isinstance(said, str) and said.startswith("="):
                single[word.name] = f"{value_of(said[1:], numbers(single)):.4g}"
            elif isinstance(said, str):
                single[word.name] = fill(said, single, where=where)
            else:
                several[word.name] = tuple(fill(text, single, where=where) for text in said)
        return several, single

    def next_steps(self, answers: Mapping[str, str]) -> list[tuple[str, list[str]]]:
        """Return commands to go on with, in groups: a title (empty for the first) and the lines.

        Args:
            answers: answers by question, with the built-in ones.

        Raises:
            ResourceError: the template is wrong.
        """
        where = f"{self.folder}/template.toml"
        _, answers = self._said(answers)
        return [
            (fill(step.title, answers, where=where), [fill(line, answers, where=where) for line in step.commands])
            for step in self.next
            if applies(step.when, answers)
        ]


def wanted(when: When) -> str:
    """Return the options that something is for.

    Args:
        when: the answers.
    """
    return " and ".join(f"--{name.replace('_', '-')} {' or '.join(values)}" for name, values in when.items())
