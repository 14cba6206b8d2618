"""What would do instead, where answers do not go together: one answer changed, as little as it takes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from math import ceil, floor, isfinite, log10

from urdfkit.scaffold.templates.questions import Question

_HALVINGS = 50

Goes = Callable[[Mapping[str, str]], bool]
"""Whether answers go together."""


def remedy(
    questions: Iterable[Question], given: Mapping[str, str], found: Mapping[str, str], said: str, goes: Goes
) -> str:
    """Return ``--payload 5 kg is too much: at most 0.42 kg``, or an empty text where no one number would do.

    What was given comes before what follows from it, and what is named in the error before what is not.

    Args:
        questions: of the template.
        given: what was answered.
        found: all answers, with those by default.
        said: the error.
        goes: whether other answers than `given` go together.
    """
    named = re.findall(r"--[a-z-]+[a-z]", said)
    numeric = [each for each in questions if each.kind == "number" and each.name in found and isfinite(sum(each.range))]
    asked = [each for each in numeric if each.name in given or each.option in named]
    for question in sorted(asked, key=lambda each: (each.name not in given, each.option not in named)):
        value = float(found[question.name])
        for end, at_most in ((question.range[0], True), (question.range[1], False)):
            bound = _bound(question, value, end, given, goes)
            if bound is not None and bound != value:
                unit = f" {question.unit}" if question.unit else ""
                return f"{question.option} {value:.4g}{unit}, at {'most' if at_most else 'least'} {bound:g}{unit}"
    return ""


def _bound(question: Question, wrong: float, end: float, given: Mapping[str, str], goes: Goes) -> float | None:
    """Return the number nearest to a wrong one, towards an end of its range, that goes; to three digits."""

    def does(number: float) -> bool:
        return goes({**given, question.name: f"{number:.10g}"})

    good = next((number for number in _towards(wrong, end) if does(number)), None)
    if good is None:
        return None
    bad = wrong
    for _ in range(_HALVINGS):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if does(middle) else (good, middle)
    digits = 2 - floor(log10(abs(good))) if good else 0
    toward = floor if good < wrong else ceil
    rounded = toward(good * 10**digits) / 10**digits
    return rounded if does(rounded) else None


def _towards(start: float, end: float) -> Iterable[float]:
    """Yield numbers from one on towards another, in ever larger steps: between bounds there may be a gap only."""
    yield from (start + (end - start) * share for share in (0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 0.95, 0.99))
    yield end
