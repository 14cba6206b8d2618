"""RuleRunner: the rules that apply to a target, run on a file's sources, its expansion faults and its robot."""

from __future__ import annotations

from pathlib import Path

from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.rule_selection import selection
from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule
from urdfkit.lint.rules import fault_rules, related_file_rules, robot_rules, source_rules

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import Any

    from urdfkit.lint.engine.clean_elements import CleanElements

_EVERYWHERE = ("xml", "encoding", "misspelt-directive", "directive-attribute", "too-large", "too-many")
"""Fault kinds reported in included files too; other faults may come from definitions in the including file."""


class RuleRunner:
    """Runs the selected rules; third-party rules too.

    Args:
        options: lint options; they select the rules.
        keep_going: if a rule raises an exception, run the other rules and record the failure.

    Attributes:
        clean: the elements without findings at an earlier check; None to run every rule on the whole model.
        failures: one line for each rule that raised an exception.

    Raises:
        UsageError: a selected code is unknown.
    """

    def __init__(self, options: Options, *, keep_going: bool = False) -> None:
        self._keep_going = keep_going
        self._foreign = _third_party()
        self._wanted = selection(options.select, options.ignore, every_code)
        self.clean: CleanElements | None = None
        self.failures: list[str] = []

    def applies(self, rule: type[Rule], target: str | None) -> bool:
        """Return whether a rule is selected and holds for a target."""
        return self._wanted(rule.code) and target not in rule.not_for and (not rule.only_for or target in rule.only_for)

    def source_findings(self, model: Model) -> Iterator[Finding]:
        """Yield the findings of the rules on the files as written."""
        sources = model.expanded.sources
        foreign = [rule for rule in self._foreign if issubclass(rule, SourceRule)]
        rules = [rule for rule in (*source_rules(sources), *foreign) if self.applies(rule, model.target)]
        for file in sources:
            for rule in rules:
                yield from self._run(rule, file, model.document(file), model)

    def fault_findings(self, model: Model, entry: Entry) -> Iterator[Finding]:
        """Yield the findings of the rules on faults of the expansion."""
        faults = (*model.encoding_faults, *model.expanded.faults)
        if not faults:
            return
        rules = [rule() for rule in (*fault_rules(), *(rule for rule in self._foreign if issubclass(rule, FaultRule)))]
        for fault in faults:
            if entry.is_library and fault.kind not in _EVERYWHERE:
                continue
            for rule in rules:
                if rule.claims(fault) and self.applies(type(rule), model.target):
                    yield from self._run(type(rule), entry.path, fault, model)

    def findings_of_robot(self, model: Model, entry: Entry) -> list[Finding]:
        """Return the findings of the rules on the robot and on the files of its package."""
        foreign = [rule for rule in self._foreign if issubclass(rule, RobotRule)]
        outside = related_file_rules(model.related_files)
        if self.clean is not None:
            self.clean.begin(model)
        findings: list[Finding] = []
        for rule in (*robot_rules(model.robot, model.target, model.facts, model.key), *outside, *foreign):
            if self.applies(rule, model.target):
                findings += self.robot_findings(rule, entry.path, model)
        return findings

    def robot_findings(self, rule: type[Any], file: Path, model: Model) -> list[Finding]:
        """Return the findings of a rule; sizes of meshes in their conditions and messages are exact."""
        boxes, failures = model.mesh_boxes, len(self.failures)
        while True:
            boxes.were_used = False
            found = list(self._findings_of(rule, file, model))
            if not (found and boxes.were_used and boxes.measure(model.robot, (finding.link for finding in found))):
                return found
            del self.failures[failures:]

    def _findings_of(self, rule: type[Any], file: Path, model: Model) -> Iterable[Finding]:
        if not rule.checks_each_alone:
            return self._run(rule, file, model)
        failures = len(self.failures)
        if self.clean is not None:
            found = self.clean.check(rule, lambda part: list(self._run(rule, file, part)))
            if len(self.failures) > failures:
                self.clean.forget(rule)
            return found
        found = list(self._run(rule, file, model.distinct))
        if model.distinct is model or not (found or len(self.failures) > failures):
            return found
        del self.failures[failures:]
        return self._run(rule, file, model)

    def _run(self, rule: type[Any], file: Path | str, *subject: Any) -> Iterator[Finding]:
        """Yield the findings of a rule; if the rule raises an exception, record the failure and continue."""
        from urdfkit.errors import UrdfkitError, bug

        try:
            for found in rule().check(*subject):
                yield _with_fix(rule, found, subject[-1])
        except UrdfkitError:
            raise
        except Exception as error:
            if not self._keep_going:
                raise
            package = rule.__module__.partition(".")[0]
            self.failures.append(f"{file}: {rule.code} {rule.name} could not check this file: {bug(error, package)}")


def _with_fix(rule: type[Rule], found: Finding, model: Model) -> Finding:
    """Return a finding in a launch, YAML, SRDF or package file with the fix that writes the nearest name."""
    if rule.fix == "none" or found.fix is not None or found.suggestion is None or found.file in model.expanded.sources:
        return found
    from urdfkit.lint.fix_builders import nearest_name

    return Finding(**{**found.__dict__, "fix": nearest_name(found, model.document(found.file))})


def codes() -> tuple[str, ...]:
    """Return the codes of all built-in rules, sorted."""
    from urdfkit.lint.rules import RULES

    return tuple(rule.code for rule in RULES)


def every_code() -> tuple[str, ...]:
    """Return the codes of all built-in and third-party rules."""
    return (*codes(), *(rule.code for rule in _third_party()))


def _third_party() -> tuple[type[Rule], ...]:
    from urdfkit.entry_points import load

    return tuple(load("urdfkit.rules"))
