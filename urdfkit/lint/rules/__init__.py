"""The rules, by layer and family. `RULES` is all of them in the order of their codes.

Rules are imported on demand, as the `table` selects them: a clean file needs neither the pages of the catalogue nor
the fault rules, and a robot without ``<gazebo>`` needs no rules for Gazebo.
"""

from __future__ import annotations

import re
from importlib import import_module

from urdfkit.lint.table import FAULTS, RELATED_FILES, ROBOT, SOURCE, SUPPRESSION, TARGETED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
    from typing import Any

    from urdfkit.description.urdf.robot import Joint, Link, Robot
    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.model.element_facts import ElementFacts
    from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule
    from urdfkit.lint.table import Row

    RULES: tuple[type[Rule], ...]


def source_rules(sources: Mapping[str, Source] | None = None) -> tuple[type[SourceRule], ...]:
    """Return the rules for the text of each file.

    Args:
        sources: skip the rules that cannot apply to these files; None returns all rules.
    """
    if sources is None:
        return tuple(_rules(SOURCE))

    def has(words: str) -> bool:
        if words.startswith("*"):
            return any(file.endswith(words[1:]) for file in sources)
        if words.startswith("<"):
            pattern = re.compile("|".join(words.split()))
            return any(pattern.search(source.text) for source in sources.values())
        return any(word in source.text for source in sources.values() for word in words.split())

    return tuple(_rules(row for row in SOURCE if not row[0] or has(row[0])))


def fault_rules() -> tuple[type[FaultRule], ...]:
    """Return the rules for parts that xacro could not expand."""
    return tuple(_rules(FAULTS))


def related_file_rules(files: Iterable[str]) -> tuple[type[RobotRule], ...]:
    """Return the rules for the launch, YAML, SRDF and build files of the package.

    Args:
        files: names of the related files; skip the rules that cannot apply to them.
    """
    names = tuple(files)
    return tuple(_rules(row for row in RELATED_FILES if any(name.endswith(tuple(row[0].split())) for name in names)))


def robot_rules(
    robot: Robot | None = None,
    target: str | None = None,
    facts: ElementFacts | None = None,
    key: Callable[[Link | Joint | Element], Hashable] | None = None,
) -> tuple[type[RobotRule], ...]:
    """Return the rules for the expanded robot.

    Args:
        robot: skip the rules that cannot apply to this robot; None returns all rules.
        target: with a robot, None skips the rules that apply only to some targets.
        facts: see `urdfkit.lint.facts.features.features_of`.
        key: see `urdfkit.lint.facts.features.features_of`.
    """
    if robot is None:
        return tuple(_rules((*ROBOT, *RELATED_FILES, *TARGETED)))
    from urdfkit.lint.facts.features import features_of

    features = features_of(robot, facts, key)
    rows = ROBOT if target is None else (*ROBOT, *TARGETED)
    return tuple(_rules(row for row in rows if not row[0] or not features.isdisjoint(row[0].split())))


def suppression_rules() -> tuple[type[Rule], ...]:
    """Return the rules for comments that suppress findings."""
    return tuple(_rules(SUPPRESSION))


def _rules(rows: Iterable[Row]) -> Iterator[Any]:
    for _, module, name in rows:
        yield getattr(import_module(f"urdfkit.lint.rules.{module}"), name)


def __getattr__(name: str) -> Any:
    if name != "RULES":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    every = (*source_rules(), *fault_rules(), *robot_rules(), *suppression_rules())
    return tuple(sorted(every, key=lambda rule: rule.code))
