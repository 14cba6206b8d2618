"""Element facts: results that follow from one element of the robot, kept from one check of a file to the next."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Mapping, Sequence
    from typing import Any, TypeVar

    Subject = TypeVar("Subject", bound=Hashable)
    Fact = TypeVar("Fact")

_MISSING: Any = object()
_NONE: Mapping[Any, Any] = {}


class ElementFacts:
    """The facts of the elements of one entry file at its last check.

    After a change in an editor, the unchanged links, joints and elements are the same objects as before, and they
    compare by identity, so that a fact is computed only for the changed ones.
    """

    def __init__(self) -> None:
        self._last: dict[object, dict[Any, Any]] = {}

    def of(
        self,
        fact: Callable[[Subject], Fact],
        subjects: Sequence[Subject],
        key: Callable[[Subject], Hashable] | None = None,
    ) -> list[Fact]:
        """Return a fact of each subject, in order.

        Args:
            fact: a function of a module; its result depends on nothing but the subject.
            subjects: links, joints, elements, or tuples of these.
            key: returns the same for subjects that have the fact in common; by default all may differ.
        """
        earlier = self._last.get(fact, _NONE)
        found = [earlier.get(subject, _MISSING) for subject in subjects]
        alike: dict[Hashable, Fact] = {}
        for index in [index for index, one in enumerate(found) if one is _MISSING]:
            subject = subjects[index]
            if key is None:
                found[index] = fact(subject)
                continue
            same = key(subject)
            if same not in alike:
                alike[same] = fact(subject)
            found[index] = alike[same]
        self._last[fact] = dict(zip(subjects, found, strict=True))
        return found
