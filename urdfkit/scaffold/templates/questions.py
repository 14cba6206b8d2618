"""Questions of a template, and the validation of answers."""

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
"""Accepted units by the SI unit of the question, each with its factor."""

_MEASURE = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([^\W\d].*)", re.IGNORECASE)

When = Mapping[str, tuple[str, ...]]
"""Answers by question that enable an item of the template; empty: always enabled."""


@dataclass(frozen=True, slots=True)
class Question:
    """One question of a template; its answer replaces ``@name@`` in the files.

    Attributes:
        name: the placeholder, and, with dashes, the option of the command line unless `own_option` is set.
        prompt: text of the interactive prompt.
        kind: type of the answer.
        default: default answer, computed from earlier answers if it begins with ``=``; None: an answer is required.
        default_for: defaults that depend on an earlier answer: question → answer → default.
        unit: SI unit of a number.
        choices: valid answers.
        called: alternative names that are not accepted: name → nearest choice, for the error message.
        range: smallest and largest number.
        pattern: regular expression that a text must match as a whole.
        suffixes: suffixes that the template appends to the package names.
        help: additional line for ``--help``.
        interactive: whether the interactive dialog shows the question; if False, the default applies.
        when: answers to earlier questions that enable this question.
        own_option: the option, if it differs from the name.
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
    interactive: bool = True
    when: When = field(default_factory=dict)
    own_option: str = ""

    @property
    def option(self) -> str:
        """The option of the command line."""
        return self.own_option or "--" + self.name.replace("_", "-")

    @property
    def several(self) -> bool:
        """Whether the question accepts several answers."""
        return self.kind in ("choices", "packages")

    @property
    def is_computed(self) -> bool:
        """Whether the default is computed from earlier answers."""
        defaults = [self.default or "", *(text for texts in self.default_for.values() for text in texts.values())]
        return any(text.startswith("=") for text in defaults)

    def declines(self, answers: Mapping[str, str]) -> bool:
        """Return whether the answer to this flag is ``no``, which is valid even if the question is not enabled.

        Args:
            answers: answers by question.
        """
        return self.kind == "flag" and self._flag(answers.get(self.name, "")) == "no"

    def default_after(self, answers: Mapping[str, str]) -> str | None:
        """Return the default; a computed default is rounded to four digits.

        Args:
            answers: the answers to the questions before this one.

        Raises:
            ResourceError: the expression in the template is invalid.
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
        """Validate an answer and return it as it is written into the files.

        Args:
            answer: as typed.

        Raises:
            UsageError: the answer is invalid; the message names valid answers.
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
            # Names separated by commas may contain blanks, which `check_package_name` then reports.
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
            choices, near = ", ".join(self.choices), did_you_mean(answer, self.choices)
            if (meant := self.called.get(answer.lower())) is not None:
                near = f"; the nearest is `{meant}`"
            listed = f" The choices are {choices}" if near.endswith("?") else f"; choose from: {choices}"
            raise UsageError(f"{self.option} `{answer}` is not available{near}{listed}")
        return answer

    def _several(self, answers: list[str]) -> str:
        """Return the answers in the order of the choices, separated by spaces; ``none`` gives an empty text."""
        if [answer.lower() for answer in answers] == ["none"]:
            return ""
        answers = [self._choice(answer) for answer in answers if answer != "and"]
        for answer in answers:
            if answers.count(answer) > 1:
                raise UsageError(f"{self.option} `{answer}` is repeated; write each value once")
        return " ".join(choice for choice in self.choices if choice in answers)

    def _flag(self, answer: str) -> str:
        value = {"y": "yes", "yes": "yes", "true": "yes", "n": "no", "no": "no", "false": "no"}.get(answer.lower())
        if value is None:
            raise UsageError(f"{self.option} `{answer}` is neither yes nor no")
        return value

    def _text_rule(self) -> str:
        return (
            "use the form name@host.domain, in ASCII"
            if "@[" in self.pattern
            else 'use text without line breaks and without < > & "'
        )

    def _number(self, answer: str) -> str:
        unit = f" {self.unit}" if self.unit else ""
        factors = UNITS.get(self.unit, {})
        measure = _MEASURE.fullmatch(answer)
        try:
            value = float(measure[1]) * factors[measure[2]] if measure and measure[2] in factors else float(answer)
        except ValueError:
            in_unit = f" (in {', '.join(factors) or self.unit})" if self.unit else ""
            near = answer.replace(",", ".", 1)
            hint = f"; did you mean `{near}`?" if re.fullmatch(r"-?\d*\.(?!\d{3}$)\d+", near) else ""
            raise UsageError(f"{self.option} `{answer}` is not a number{in_unit}{hint}") from None
        least, greatest = self.range
        if not least <= value <= greatest:
            raise UsageError(f"{self.option} {answer}{unit} is out of range: {least:g} to {greatest:g}{unit}")
        return f"{value:.10g}"

    @property
    def explanation(self) -> str:
        """Explanation of the question for the interactive dialog."""
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
        """Return the error message for a number that is computed from other answers.

        Args:
            answer: the number.
        """
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"{self.option} is computed as {answer}{unit}; it must be between {self.range[0]:g} and "
            f"{self.range[1]:g}{unit}"
        )


def applies(when: When, answers: Mapping[str, str]) -> bool:
    """Return whether answers enable an item of the template.

    Args:
        when: the enabling answers; of a question with several answers, one match is enough.
        answers: answers by question.
    """
    return all(answers[name] in values or set(answers[name].split()) & set(values) for name, values in when.items())


def numbers(answers: Mapping[str, str]) -> dict[str, float]:
    """Return the answers that are numbers, converted.

    Args:
        answers: answers by question.
    """
    converted: dict[str, float] = {}
    for name, answer in answers.items():
        try:
            converted[name] = float(answer)
        except ValueError:
            continue
    return converted
