"""Suggestions for answers that contradict each other: the smallest change of one number that satisfies all checks."""

from collections.abc import Callable, Collection, Iterable, Mapping
from math import ceil, floor, isfinite, log10

from urdfkit.scaffold.templates.questions import Question

_HALVINGS = 50

Accepts = Callable[[Mapping[str, str]], bool]
"""Returns whether the template accepts a set of answers."""


def suggest_change(
    questions: Iterable[Question],
    user_answers: Mapping[str, str],
    answers: Mapping[str, str],
    named: Collection[str],
    accepts: Accepts,
) -> str:
    """Return a suggestion such as ``--payload 5 kg, at most 0.42 kg``; empty if changing one number is not enough.

    Numbers that the user gave are tried before computed ones, and numbers named in the error before other ones.

    Args:
        questions: the questions of the template.
        user_answers: the answers of the user.
        answers: all answers, including defaults.
        named: names of the questions that the error message names.
        accepts: returns whether the template accepts other answers in place of `user_answers`.
    """
    numeric = [
        each for each in questions if each.kind == "number" and each.name in answers and isfinite(sum(each.range))
    ]
    changeable = [each for each in numeric if each.name in user_answers or each.name in named]
    for question in sorted(changeable, key=lambda each: (each.name not in user_answers, each.name not in named)):
        value = float(answers[question.name])
        for end, at_most in ((question.range[0], True), (question.range[1], False)):
            bound = _bound(question, value, end, user_answers, accepts)
            if bound is not None and bound != value:
                unit = f" {question.unit}" if question.unit else ""
                return f"{question.option} {value:.4g}{unit}, at {'most' if at_most else 'least'} {bound:g}{unit}"
    return ""


def _bound(
    question: Question, rejected: float, end: float, user_answers: Mapping[str, str], accepts: Accepts
) -> float | None:
    """Return the accepted number nearest to a rejected one, towards one end of the range, to three digits."""

    def is_accepted(number: float) -> bool:
        return accepts({**user_answers, question.name: f"{number:.10g}"})

    good = next((number for number in _towards(rejected, end) if is_accepted(number)), None)
    if good is None:
        return None
    bad = rejected
    for _ in range(_HALVINGS):
        middle = (good + bad) / 2
        good, bad = (middle, bad) if is_accepted(middle) else (good, middle)
    digits = 2 - floor(log10(abs(good))) if good else 0
    toward = floor if good < rejected else ceil
    rounded = toward(good * 10**digits) / 10**digits
    return rounded if is_accepted(rounded) else None


def _towards(start: float, end: float) -> Iterable[float]:
    """Yield numbers between `start` and `end`, then `end`, in increasing steps, since only an interval may be accepted."""
    yield from (start + (end - start) * share for share in (0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 0.95, 0.99))
    yield end
