"""The rules, by layer and family. `RULES` is all of them in the order of their codes.

They are imported when they are asked for, by the `table`: a clean file needs neither the pages of the catalogue nor
the fault rules, and a robot without ``<gazebo>`` needs none of those on Gazebo.
"""

from __future__ import annotations

from importlib import import_module

from urdfkit.lint.table import AROUND, FAULTS, ROBOT, SOURCE, SUPPRESSION, TARGETED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from typing import Any

    from urdfkit.description.robot import Robot
    from urdfkit.description.source import Source
    from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule
    from urdfkit.lint.table import Row

    RULES: tuple[type[Rule], ...]


def source_rules(sources: Mapping[str, Source] | None = None) -> tuple[type[SourceRule], ...]:
    """Return the rules on the text of each file.

    Args:
        sources: leave out the rules that have nothing to look at in these; without them all are returned.
    """
    if sources is None:
        return tuple(_rules(SOURCE))

    def has(word: str) -> bool:
        if word.startswith("*"):
            return any(file.endswith(word[1:]) for file in sources)
        return any(word in source.text for source in sources.values())

    return tuple(_rules(row for row in SOURCE if not row[0] or any(map(has, row[0].split()))))


def fault_rules() -> tuple[type[FaultRule], ...]:
    """Return the rules on what xacro could not expand."""
    return tuple(_rules(FAULTS))


def around_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on launch files and YAML around the description."""
    return tuple(_rules(AROUND))


def robot_rules(robot: Robot | None = None, target: str | None = None) -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot.

    Args:
        robot: leave out the rules that have nothing to look at in this one; without it all are returned.
        target: leave out those for other targets, where a robot is given.
    """
    if robot is None:
        return tuple(_rules((*ROBOT, *AROUND, *TARGETED)))
    from urdfkit.lint.glance import traits

    found = traits(robot)
    rows = ROBOT if target is None else (*ROBOT, *TARGETED)
    return tuple(_rules(row for row in rows if not row[0] or not found.isdisjoint(row[0].split())))


def suppression_rules() -> tuple[type[Rule], ...]:
    """Return the rules on the comments that suppress findings."""
    return tuple(_rules(SUPPRESSION))


def _rules(rows: Iterable[Row]) -> Iterator[Any]:
    for _, module, name in rows:
        yield getattr(import_module(f"urdfkit.lint.rules.{module}"), name)


def __getattr__(name: str) -> Any:
    if name != "RULES":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    every = (*source_rules(), *fault_rules(), *robot_rules(), *suppression_rules())
    return tuple(sorted(every, key=lambda rule: rule.code))
