"""What a template asks, and what counts as an answer."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from urdfkit.errors import UsageError, did_you_mean
from urdfkit.scaffold.templates.expressions import value_of
from urdfkit.scaffold.templates.names import check_package_name, check_world_name

UNITS = {
    "m": {"m": 1.0, "cm": 0.01, "mm": 0.001},
    "kg": {"kg": 1.0, "g": 0.001, "t": 1000.0},
    "m/s": {"m/s": 1.0, "cm/s": 0.01, "km/h": 1 / 3.6},
    "N·m": {"N·m": 1.0, "Nm": 1.0},
}
"""What may stand behind a number, by the unit it is meant in, and how much of that it is."""

_MEASURE = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([^\W\d].*)", re.IGNORECASE)

When = Mapping[str, tuple[str, ...]]
"""Which answers something is for, by question."""


@dataclass(frozen=True, slots=True)
class Question:
    """One question of a template; its answer replaces ``@name@`` in the files.

    Attributes:
        name: the placeholder and, with dashes, the option.
        prompt: what a person is asked.
        kind: what sort of answer.
        default: the answer when none is given; computed from earlier ones when it begins with ``=``; None: a must.
        default_for: the default after certain answers to earlier questions instead: question → answer → default.
        unit: SI unit of a number.
        choices: the answers there are.
        called: what some call them: word → the answer nearest to it.
        range: least and greatest number.
        pattern: what a text has to match as a whole.
        suffixes: what the packages' names end in.
        help: one more line for ``--help``.
        ask: whether a person is asked, or the default goes without saying.
        when: the answers to earlier questions that it is asked for.
    """

    name: str
    prompt: str
    kind: Literal["package", "world", "choice", "choices", "flag", "number", "packages", "text"]
    default: str | None = None
    default_for: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    unit: str = ""
    choices: tuple[str, ...] = ()
    called: Mapping[str, str] = field(default_factory=dict)
    range: tuple[float, float] = (-math.inf, math.inf)
    pattern: str = ".*"
    suffixes: tuple[str, ...] = ()
    help: str = ""
    ask: bool = True
    when: When = field(default_factory=dict)

    @property
    def option(self) -> str:
        """The option of the command line."""
        return "--" + self.name.replace("_", "-")

    @property
    def several(self) -> bool:
        """Whether it takes several answers."""
        return self.kind in ("choices", "packages")

    @property
    def is_computed(self) -> bool:
        """Whether its default follows from answers before it."""
        defaults = [self.default or "", *(text for texts in self.default_for.values() for text in texts.values())]
        return any(text.startswith("=") for text in defaults)

    def declines(self, given: Mapping[str, str]) -> bool:
        """Return whether it is answered that something is not wanted, which goes wherever there is none.

        Args:
            given: answers by question.
        """
        return self.kind == "flag" and self._flag(given.get(self.name, "")) == "no"

    def default_given(self, answers: Mapping[str, str]) -> str | None:
        """Return the default, computed where it depends on earlier answers (to four digits).

        Args:
            answers: the answers to the questions before this one.

        Raises:
            ResourceError: the template is wrong.
        """
        default = self.default
        for question, defaults in self.default_for.items():
            if (answer := answers.get(question, "")) in defaults:
                default = defaults[answer]
                break
        if default is None or not default.startswith("="):
            return default
        return f"{value_of(default[1:], numbers(answers)):.4g}"

    def accept(self, answer: str) -> str:
        """Return the answer as it goes into the files.

        Args:
            answer: as typed.

        Raises:
            UsageError: it is none; says what would be.
        """
        answer = answer.strip()
        if self.kind == "package":
            return check_package_name(answer, suffixes=self.suffixes)
        if self.kind == "world":
            return check_world_name(answer)
        if self.kind == "number":
            return self._number(answer)
        if self.kind == "choices":
            return self._several(answer.replace(",", " ").split())
        if self.kind == "packages":
            # With commas it is they that part names, and a blank is in one.
            names = [name.strip() for name in answer.split(",")] if "," in answer else answer.split()
            return " ".join(dict.fromkeys(check_package_name(name) for name in names if name))
        if self.kind == "choice":
            return self._choice(answer)
        if self.kind == "flag":
            return self._flag(answer)
        if self.kind == "text" and not re.fullmatch(self.pattern, answer):
            raise UsageError(f"{self.option} `{answer}` cannot be written into the files: {self._text_rule()}")
        return answer

    def _choice(self, answer: str) -> str:
        answer = {choice.lower(): choice for choice in self.choices}.get(answer.lower(), answer)
        if answer not in self.choices:
            near = did_you_mean(answer, self.choices)
            if (meant := self.called.get(answer.lower())) is not None:
                near = f"; the nearest is `{meant}`"
            raise UsageError(f"{self.option} `{answer}` is not available{near}; there is: {', '.join(self.choices)}")
        return answer

    def _several(self, answers: list[str]) -> str:
        """Return them in the order of the choices, with spaces between; `none` alone is none of them."""
        if [answer.lower() for answer in answers] == ["none"]:
            return ""
        answers = [self._choice(answer) for answer in answers if answer != "and"]
        for answer in answers:
            if answers.count(answer) > 1:
                raise UsageError(f"{self.option} `{answer}` is given twice; one of each")
        return " ".join(choice for choice in self.choices if choice in answers)

    def _flag(self, answer: str) -> str:
        said = {"y": "yes", "yes": "yes", "true": "yes", "n": "no", "no": "no", "false": "no"}.get(answer.lower())
        if said is None:
            raise UsageError(f"{self.option} `{answer}` is neither yes nor no")
        return said

    def _text_rule(self) -> str:
        return (
            "it is not of the form name@host.domain, in ASCII"
            if "@[" in self.pattern
            else 'it is empty, or has a line break or one of < > & "'
        )

    def _number(self, answer: str) -> str:
        unit = f" {self.unit}" if self.unit else ""
        known = UNITS.get(self.unit, {})
        measure = _MEASURE.fullmatch(answer)
        try:
            value = float(measure[1]) * known[measure[2]] if measure and measure[2] in known else float(answer)
        except ValueError:
            in_unit = f" (in {', '.join(known) or self.unit})" if self.unit else ""
            near = answer.replace(",", ".", 1)
            hint = f"; did you mean `{near}`?" if re.fullmatch(r"-?\d*\.(?!\d{3}$)\d+", near) else ""
            raise UsageError(f"{self.option} `{answer}` is no number{in_unit}{hint}") from None
        least, greatest = self.range
        if not least <= value <= greatest:
            raise UsageError(f"{self.option} {answer}{unit} is out of range: {least:g} to {greatest:g}{unit}")
        return f"{value:.10g}"

    @property
    def explanation(self) -> str:
        """What to say to who does not know what is asked."""
        if self.help:
            return self.help
        if self.kind == "package":
            return "lower case letters, digits and single underscores, as in my_robot"
        if self.kind == "number":
            least, greatest = self.range
            return f"a number{f' in {self.unit}' if self.unit else ''}, {least:g} to {greatest:g}"
        among = ("yes", "no") if self.kind == "flag" else self.choices
        return f"one of {', '.join(among)}" if among else "any text"

    def out_of_range(self, answer: str) -> str:
        """Return what is wrong with a number that follows from other answers.

        Args:
            answer: the number.
        """
        unit = f" {self.unit}" if self.unit else ""
        return f"{self.option} comes to {answer}{unit}, and has to be {self.range[0]:g} to {self.range[1]:g}{unit}"


def applies(when: When, answers: Mapping[str, str]) -> bool:
    """Return whether the answers are among those that something is for.

    Args:
        when: what it is for; of a question that takes several answers, one of them is enough.
        answers: answers by question.
    """
    return all(answers[name] in values or set(answers[name].split()) & set(values) for name, values in when.items())


def numbers(answers: Mapping[str, str]) -> dict[str, float]:
    """Return the answers that are numbers, as such.

    Args:
        answers: answers by question.
    """
    found: dict[str, float] = {}
    for name, answer in answers.items():
        try:
            found[name] = float(answer)
        except ValueError:
            continue
    return found
