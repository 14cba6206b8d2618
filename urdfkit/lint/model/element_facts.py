"""Element facts: results that follow from one element of the robot, kept from one check of a file to the next."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Sequence
    from typing import Any, TypeVar

    Subject = TypeVar("Subject", bound=Hashable)
    Fact = TypeVar("Fact")


class ElementFacts:
    """The facts of the elements of one entry file at its last check.

    After a change in an editor, the unchanged links, joints and elements are the same objects as before, and they
    compare by identity, so that a fact is computed only for the changed ones.
    """

    def __init__(self) -> None:
        self._last: dict[object, tuple[Sequence[Any], list[Any]]] = {}

    def of(
        self,
        fact: Callable[[Subject], Fact],
        subjects: Sequence[Subject],
        key: Callable[[Subject], Hashable] | None = None,
    ) -> list[Fact]:
        """Return a fact of each subject, in order, in a list that the caller does not change.

        Args:
            fact: a function of a module; its result depends on nothing but the subject.
            subjects: links, joints, elements, or tuples of these; a sequence that is not changed afterwards.
            key: returns the same for subjects that have the fact in common; by default all may differ.
        """
        before, facts = self._last.get(fact, ((), []))
        first, last = _difference(before, subjects)
        longer = len(subjects) - len(before)
        earlier = dict(zip(before[first:last], facts[first:last], strict=True))
        alike: dict[Hashable, Fact] = {}
        new: list[Fact] = []
        for subject in subjects[first : last + longer]:
            if subject not in earlier:
                same = subject if key is None else key(subject)
                if same not in alike:
                    alike[same] = fact(subject)
                earlier[subject] = alike[same]
            new.append(earlier[subject])
        found = [*facts[:first], *new, *facts[last:]]
        self._last[fact] = subjects, found
        return found


def _difference(one: Sequence[Any], other: Sequence[Any]) -> tuple[int, int]:
    """Return the part of the first sequence outside of which both are the same: its start and its end."""
    shorter = min(len(one), len(other))
    start = _same(one[:shorter], other[:shorter])
    rest = shorter - start
    return start, len(one) - (_same(one[len(one) - rest :][::-1], other[len(other) - rest :][::-1]) if rest else 0)


def _same(one: Sequence[Any], other: Sequence[Any]) -> int:
    """Return how many items two sequences of one length begin with alike."""
    low, high = 0, len(one)
    while low < high:  # Comparing slices takes a tenth of the time of a loop over the items.
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low
