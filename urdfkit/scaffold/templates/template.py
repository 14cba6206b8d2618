"""Templates: folders whose files are copied with each ``@name@`` replaced by an answer.

The syntax conflicts neither with xacro's ``${…}`` and ``$(…)`` nor with XML, Python, YAML or CMake, so editors and
linters treat a template file as the file that it becomes. Files contain no conditions: a template consists of layers,
each enabled by certain answers. A line with the placeholder of a question that accepts several answers is repeated
for each of them.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError, did_you_mean
from urdfkit.scaffold.templates.expressions import holds, value_of
from urdfkit.scaffold.templates.placeholders import fill, path_inside, repeat_lines
from urdfkit.scaffold.templates.template_schema import Check, Fact, Layer, Next, Word
from urdfkit.scaffold.templates.questions import Question, When, applies, numbers
from urdfkit.scaffold.templates.answer_suggestions import Accepts, suggest_change

FRESH = "fresh"
"""Name that defaults may depend on like on an answer: ``yes`` if the output folder is new, empty or a fresh clone."""


@dataclass(frozen=True, slots=True)
class Template:
    """Template of ``urdfkit new NAME``: its questions, and the files that it writes.

    Attributes:
        folder: folder of the template.
        summary: summary in one line.
        questions: the questions, in order.
        words: placeholders that depend on an answer.
        facts: conditions on the answers that have a name.
        layers: the files to write.
        checks: conditions that the answers must satisfy.
        next: the commands to print after writing.
        recipe: path of the file that records the answers; empty for none.
        examples: arguments for the examples in the help of ``urdfkit new TEMPLATE``.
        source: folder of a template that is not bundled, as the user gave it; empty for bundled templates.
        name: name of the template, as in ``urdfkit new NAME``.
        teleop: folder of the output that ``urdfkit sim teleop`` can load; empty for none.
    """

    folder: Path
    summary: str
    questions: tuple[Question, ...]
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
        """Return the question with that name.

        Args:
            name: name of the question.

        Raises:
            UsageError: the template has no such question.
        """
        for question in self.questions:
            if question.name == name:
                return question
        raise UsageError(f"no question `{name}`{did_you_mean(name, [q.name for q in self.questions])}")

    def answers(self, user_answers: Mapping[str, str], *, fresh: bool = False) -> dict[str, str]:
        """Return an answer to every question, the user's checked and the others by default, and the facts.

        Args:
            user_answers: answers of the user by question.
            fresh: whether the output folder is new, empty or a fresh clone.

        Raises:
            UsageError: an answer is invalid, missing, or contradicts another.
        """
        for name in user_answers:
            self.question(name)
        answers, out_of_range = self._filled(user_answers, fresh)
        if failure := self._failure(answers) or out_of_range:
            # Suggest a number that satisfies all checks, or at least the failing one.
            others = [check for check in self.checks if check is not failure]
            for ignored in ([], others):
                accepts = self._accepts(ignored, fresh)
                if suggestion := suggest_change(self.questions, user_answers, answers, failure.named, accepts):
                    raise UsageError(f"{failure.otherwise} ({suggestion})")
            raise UsageError(failure.otherwise)
        return answers

    def contradiction(self, so_far: Mapping[str, str], last: str) -> tuple[str, str]:
        """Return the first failing check of incomplete answers and a suggestion; empty texts if none fails.

        Checks that depend on an open question are skipped.

        Args:
            so_far: answers by question, with the defaults of questions that are not interactive.
            last: the question that was answered last.
        """
        enabled = {q.name: so_far[q.name] for q in self.questions if q.name in so_far and applies(q.when, so_far)}
        try:
            answers, _ = self._filled(enabled, False)
        except UsageError:
            return "", ""
        open_yet = {q.name for q in self.questions if q.interactive and q.name not in enabled and applies(q.when, answers)}
        undecided = [each for each in self.checks if open_yet & {*re.findall(r"[a-z_]+", each.holds), *each.when}]
        if (check := self._failure(answers, undecided)) is None:
            return "", ""
        accepts = self._accepts([other for other in self.checks if other is not check], False)
        return check.otherwise, suggest_change([self.question(last)], enabled, answers, check.named, accepts)

    def _filled(self, user_answers: Mapping[str, str], fresh: bool) -> tuple[dict[str, str], Check | None]:
        """Return an answer to every question, and a failing check for a computed answer that is out of range.

        Raises:
            UsageError: an answer of the user is invalid, or an answer is missing.
        """
        answers: dict[str, str] = {}
        out_of_range = None
        for question in self.questions:
            if question.name in user_answers and not applies(question.when, answers) and not question.declines(user_answers):
                raise UsageError(f"{question.option} requires {required_options(question.when)}")
            answer = user_answers.get(question.name, question.default_after(answers | {FRESH: "yes" if fresh else "no"}))
            if answer is None:
                raise UsageError(f"{question.prompt[0].lower()}{question.prompt[1:]} is missing; pass {question.name.upper()}")
            try:
                answers[question.name] = question.accept(answer)
            except UsageError:
                if question.name in user_answers or not question.is_computed:
                    raise
                answers[question.name] = answer
                if applies(question.when, answers):
                    message = f"with these sizes {question.out_of_range(answer)}"
                    out_of_range = out_of_range or Check("", message, {}, (question.name,))
        for fact in self.facts:
            answers[fact.name] = "yes" if any(applies(when, answers) for when in fact.any) else "no"
        return answers, out_of_range

    def _failure(self, answers: Mapping[str, str], ignored: Sequence[Check] = ()) -> Check | None:
        """Return the first failing check; None if all checks hold."""
        for check in self.checks:
            if check in ignored or not applies(check.when, answers):
                continue
            if not (check.holds and holds(check.holds, numbers(answers))):
                return check
        return None

    def _accepts(self, ignored: Sequence[Check], fresh: bool) -> Accepts:
        def accepts(user_answers: Mapping[str, str]) -> bool:
            try:
                answers, out_of_range = self._filled(user_answers, fresh)
            except UsageError:
                return False
            return not (self._failure(answers, ignored) or out_of_range)

        return accepts

    def files(self, answers: Mapping[str, str]) -> Iterator[tuple[Path, Path]]:
        """Yield the source and the output path of every file to write.

        A file to append has the same output path as the file that it is appended to, and follows it.

        Args:
            answers: answers by question, including the built-in placeholders.

        Raises:
            ResourceError: two layers write the same file, or a placeholder is unknown.
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
        """Yield the files of a layer, each with its output path."""
        place = f"{self.folder}/template.toml:{layer.line}"
        for home, source in self._sources(layer, answers):
            for folder in layer.into:
                name = fill(source.relative_to(home).as_posix(), answers, where=str(source))
                yield source, path_inside(Path(fill(folder, answers, where=place), name), where=place)

    def spare(self, answers: Mapping[str, str]) -> set[str]:
        """Return the names of files and folders, at the top of the output, that are skipped if they exist.

        Args:
            answers: answers by question, including the built-in placeholders.

        Raises:
            ResourceError: the template is invalid.
        """
        return {
            target.parts[0]
            for layer in self.layers
            if layer.spare and applies(layer.when, answers)
            for _, target in self._targets(layer, answers)
        }

    def _sources(self, layer: Layer, answers: Mapping[str, str]) -> Iterator[tuple[Path, Path]]:
        """Yield the files of a layer, each after the folder of the layer that contains it."""
        several, _ = self._values(answers)
        for name in repeat_lines(f"{layer.folder}\n", several).splitlines():
            home = self.folder / fill(name, answers, where=f"{self.folder}/template.toml")
            if not home.is_dir():
                raise ResourceError(f"template: no folder {home}")
            # pip compiles the launch files of bundled templates.
            for path in sorted(home.rglob("*")):
                if path.is_file() and "__pycache__" not in path.parts:
                    yield home, path

    def render(self, answers: Mapping[str, str], folder: Path) -> list[Path]:
        """Write the files into `folder`.

        Args:
            answers: answers by question, including the built-in placeholders.
            folder: an existing folder.

        Returns:
            The paths written, relative to `folder`.

        Raises:
            ResourceError: the template is invalid, or the folder cannot be written.
        """
        several, answers = self._values(answers)
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

    def _values(self, answers: Mapping[str, str]) -> tuple[dict[str, tuple[str, ...]], dict[str, str]]:
        """Return the placeholders with several values, and the answers extended by words with one value."""
        several = {q.name: tuple(answers[q.name].split()) for q in self.questions if q.several}
        single = dict(answers)
        for word in self.words:
            where = f"{self.folder}/template.toml"
            if word.by in several:
                several[word.name] = tuple(str(word.values[one]) for one in several[word.by] if one in word.values)
                continue
            value = word.values.get(answers[word.by])
            if value is None:
                raise ResourceError(f"{where}: word `{word.name}` has no value for {word.by} `{answers[word.by]}`")
            if isinstance(value, str) and value.startswith("="):
                single[word.name] = f"{value_of(value[1:], numbers(single)):.4g}"
            elif isinstance(value, str):
                single[word.name] = fill(value, single, where=where)
            else:
                several[word.name] = tuple(fill(text, single, where=where) for text in value)
        return several, single

    def next_steps(self, answers: Mapping[str, str]) -> list[tuple[str, list[str]]]:
        """Return the commands to run next, in groups: a title (empty for the first) and the lines.

        Args:
            answers: answers by question, including the built-in placeholders.

        Raises:
            ResourceError: the template is invalid.
        """
        where = f"{self.folder}/template.toml"
        _, answers = self._values(answers)
        return [
            (fill(step.title, answers, where=where), [fill(line, answers, where=where) for line in step.commands])
            for step in self.next
            if applies(step.when, answers)
        ]


def required_options(when: When) -> str:
    """Return the options that an item of the template requires.

    Args:
        when: the enabling answers.
    """
    return " and ".join(f"--{name.replace('_', '-')} {' or '.join(values)}" for name, values in when.items())
