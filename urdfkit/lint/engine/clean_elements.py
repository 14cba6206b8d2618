"""Clean elements: after a change, a rule that checks each element alone checks only new elements.

A rule that found nothing is run on a model of the new elements alone. If it finds something there, or found something
before, it is run on the whole model, so that its findings are those of a fresh check.
"""

from collections.abc import Callable

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.element_facts import ElementFacts
from urdfkit.lint.model.model import Model
from urdfkit.lint.rule import Rule

_MAX_NEW = 0.25
"""Proportion of new elements above which a rule is run on the whole model."""


class CleanElements:
    """The children of the root element in which rules found nothing at the last check of one entry file.

    Attributes:
        facts: facts of the elements of the last check.
    """

    def __init__(self) -> None:
        self.facts = ElementFacts()
        self._surroundings: object = None
        self._clean: dict[str, frozenset[Element]] = {}

    def begin(self, model: Model) -> None:
        """Begin a check."""
        robot = model.robot
        head = robot.element.tag, robot.element.attributes.get("version")
        surroundings = model.target, model.release, head, [one.element for one in robot.materials]
        is_unique = len(robot.link_by_name) == len(robot.links)  # the shapes of duplicate links are not checked
        if surroundings != self._surroundings or not is_unique:
            self._clean.clear()
        self._surroundings = surroundings if is_unique else None
        self._model, self._every = model, frozenset(robot.element.children)
        self._parts: dict[frozenset[Element], Model | None] = {}

    def check(self, rule: type[Rule], check: Callable[[Model], list[Finding]]) -> list[Finding]:
        """Return the findings of a rule.

        Args:
            rule: checks each element alone.
            check: returns the findings of the rule in a model.
        """
        clean = self._clean.pop(rule.code, None)
        part = self._part(clean) if clean is not None else None
        model = self._model.distinct if part is None else part
        before = len(model.documents_read)
        found = check(model)
        if found and model is not self._model:
            found = check(self._model)
        if not found and self._surroundings is not None and len(model.documents_read) == before:
            self._clean[rule.code] = self._every
        return found

    def forget(self, rule: type[Rule]) -> None:
        """Run a rule on the whole model at the next check."""
        self._clean.pop(rule.code, None)

    def _part(self, clean: frozenset[Element]) -> Model | None:
        """Return a model of the elements that are not clean; None if there are many."""
        if clean not in self._parts:
            self._parts[clean] = self._without(clean)
        return self._parts[clean]

    def _without(self, clean: frozenset[Element]) -> Model | None:
        new = self._every - clean
        return self._model.part(new) if len(new) <= _MAX_NEW * len(self._every) else None
