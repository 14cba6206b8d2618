"""From one entry file to what is found in it: expand with recovery, ask the rules, suppress."""

from __future__ import annotations

import os
from functools import partial
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.urdf.parser import parse
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin, Position
from urdfkit.lint.finding import Finding, Found
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry, is_nearly_robot
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.rule_selection import selection
from urdfkit.lint.project.target import family_of, release_of
from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule
from urdfkit.lint.rules import around_rules, fault_rules, robot_rules, source_rules

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.description.xacro.fast.incremental import Memory
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.engine.cache import Cache
    from urdfkit.lint.facts.suppressions import Suppression

_EVERYWHERE = ("xml", "encoding", "misspelt-directive", "directive-attribute", "too-large", "too-many")
"""Kinds of faults that count in a file which others include, too: the rest may be due to what only those define."""


def model_of(path: Path, options: Options, *, packages: Packages | None = None, memory: Memory | None = None) -> Model:
    """Expand a file, going on after errors, and read the robot in it.

    Args:
        path: the file.
        options: how to expand it.
        packages: resolves what it names; by default what lies near it and in the environment.
        memory: what is known of its files from when they were looked at before.

    Raises:
        ResourceError: it cannot be read.
        ModelError: it is no robot description.
    """
    packages = packages if packages is not None else Packages(options.package_path, near=path)

    def as_written() -> Robot:
        expanded = expand_leniently(
            path, arguments=options.arguments, packages=packages, mend_prefixes=False, texts=options.texts
        )
        return parse(expanded.root) if expanded.root is not None else robot

    expanded = expand_leniently(
        path, arguments=options.arguments, packages=packages, texts=options.texts, memory=memory
    )
    root = expanded.root
    if root is not None and root.tag != "robot" and not is_nearly_robot(root.tag):
        from urdfkit.errors import ModelError

        raise ModelError(f"<{root.tag}> is no robot description", position=root.origin.position)
    known = memory.parts if memory is not None else None
    robot = parse(root if root is not None else _nothing(path), known=known)
    return Model(expanded, robot, family_of(options.target), as_written, release_of(options.target), options.texts)


class Checker:
    """One run over several entries.

    Args:
        options: what to look for, and how to expand.
        cached: take and keep what was found before.
        keep_going: where a rule fails by a fault of its own, ask the others, and say so in what was found.
    """

    def __init__(self, options: Options, *, cached: bool = False, keep_going: bool = False) -> None:
        self.options, self.keep_going = options, keep_going
        self.memory: Memory | None = None
        self.sources: dict[str, Source] = {}
        self.packages = Packages(options.package_path)
        self.foreign = _third_party()
        self.wanted = selection(options.select, options.ignore, self._codes)
        self.cache: Cache | None = None
        if cached and not options.texts and not self.foreign:  # nobody knows what the rules of others read
            from urdfkit.lint.engine.cache import Cache

            self.cache = Cache(options, self.packages)

    def _codes(self) -> tuple[str, ...]:
        return (*codes(), *(rule.code for rule in self.foreign))

    def _applies(self, rule: type[Rule], target: str | None) -> bool:
        return self.wanted(rule.code) and target not in rule.not_for and (not rule.only_for or target in rule.only_for)

    def known(self, entry: Entry) -> Found | None:
        """Return what was found before, where nothing has changed since."""
        return self.cache.get(entry) if self.cache is not None else None

    def check(self, entry: Entry) -> Found:
        """Lint one entry file and everything it includes."""
        from urdfkit.errors import UrdfkitError, bug

        try:
            found, model = self.examine(entry)
            if self.cache is not None and not found.refused:
                self.cache.put(entry, found, model.expanded)
        except UrdfkitError:
            raise
        except Exception as error:
            if not self.keep_going:
                raise
            return Found((), {}, refused=f"{entry.path}: {bug(error)}")
        return found

    def tried(self, entry: Entry) -> Found:
        """Lint one entry file of several; what cannot be linted is said in the outcome."""
        from urdfkit.errors import UrdfkitError

        try:
            return self.check(entry)
        except UrdfkitError as error:
            return Found((), {}, refused=str(error))

    def examine(self, entry: Entry) -> tuple[Found, Model]:
        """Lint one entry file; return what was found, and the model it was found in."""
        options, note = self.options, ""
        if options.guess_target and options.target is None:
            from urdfkit.lint.project.target import guess

            guessed = guess(entry.path)
            if guessed.target is not None and guessed.manifest is not None:
                options = Options(**{**options.__dict__, "target": guessed.target})
                note = f"linted for {guessed.target}: {guessed.manifest.parent.name} {guessed.why}"
        model = model_of(entry.path, options, packages=self.packages.near_file(entry.path), memory=self.memory)
        self.sources.update(model.expanded.sources)
        self._failures: list[str] = []
        findings = list(self._ask_source_rules(model))
        findings += self._ask_fault_rules(model, entry)
        if model.expanded.root is not None and not entry.is_library:
            foreign = [rule for rule in self.foreign if issubclass(rule, RobotRule)]
            outside = around_rules() if model.around else ()
            for rule in (*robot_rules(model.robot, model.target), *outside, *foreign):
                if self._applies(rule, model.target):
                    findings += self._ask(rule, entry.path, model)
        used: tuple[str, ...] = ()
        if any("urdfkit:" in source.text for source in model.expanded.sources.values()):
            findings, used = self._suppress(findings, model, entry)
        here = str(Path.cwd())
        read = (*model.expanded.sources, *(model.around if model.expanded.root is not None else ()))
        files = {name: os.path.join(here, name) for name in read}  # noqa: PTH118
        if entry.only:
            only = {path.resolve() for path in entry.only}
            names = {name for name, path in files.items() if Path(path).resolve() in only}
            findings = [finding for finding in findings if finding.file in names]
        return Found(tuple(findings), files, note, used, "; ".join(self._failures)), model

    def _ask_source_rules(self, model: Model) -> Iterator[Finding]:
        sources = model.expanded.sources
        foreign = [rule for rule in self.foreign if issubclass(rule, SourceRule)]
        rules = [rule for rule in (*source_rules(sources), *foreign) if self._applies(rule, model.target)]
        for file in sources:
            for rule in rules:
                yield from self._ask(rule, file, model.document(file), model)

    def _ask_fault_rules(self, model: Model, entry: Entry) -> Iterator[Finding]:
        faults = (*model.misread, *model.expanded.faults)
        if not faults:
            return
        rules = [rule() for rule in (*fault_rules(), *(rule for rule in self.foreign if issubclass(rule, FaultRule)))]
        for fault in faults:
            if entry.is_library and fault.kind not in _EVERYWHERE:
                continue
            for rule in rules:
                if rule.claims(fault) and self._applies(type(rule), model.target):
                    yield from self._ask(type(rule), entry.path, fault, model)

    def _ask(self, rule: type[Any], file: Path | str, *subject: Any) -> Iterator[Finding]:
        """Yield what a rule finds in a subject; where it fails, note that for the file and go on."""
        from urdfkit.errors import UrdfkitError, bug

        try:
            yield from rule().check(*subject)
        except UrdfkitError:
            raise
        except Exception as error:
            if not self.keep_going:
                raise
            whose = rule.__module__.partition(".")[0]
            self._failures.append(f"{file}: {rule.code} {rule.name} could not look at it: {bug(error, whose)}")

    def _suppress(self, findings: list[Finding], model: Model, entry: Entry) -> tuple[list[Finding], tuple[str, ...]]:
        """Return what no comment suppresses, and the places of the comments that do, for all files of the model."""
        from urdfkit.lint.facts.suppressions import suppressed, suppressions
        from urdfkit.lint.rules.document.unknown_suppression import UnknownSuppression
        from urdfkit.lint.rules.document.unused_suppression import UnusedSuppression

        comments: dict[str, list[Suppression]] = {}
        for file, source in model.expanded.sources.items():
            if "urdfkit:" in source.text:
                comments[file] = suppressions(model.document(file))
                if self._applies(UnknownSuppression, model.target):
                    findings += UnknownSuppression().check(comments[file], self._codes(), model)
        left, used = suppressed(findings, comments)
        judged = {code for code, target in self._asked().items() if target(model.target)}
        if entry.is_library or model.is_incomplete:
            judged.clear()
        every = bool(judged) and not self.options.select and not self.options.ignore
        for items in comments.values():
            unused = []
            for item in items:
                met = {code for other, code in used if other is item}
                lost = tuple(code for code in item.codes if code in judged and code not in met)
                if lost or (every and not item.codes and not met):
                    unused.append((item, lost))
            if self._applies(UnusedSuppression, model.target):
                known = [one for one in unused if one[0].verb in ("ignore", "ignore-file")]
                left += UnusedSuppression().check(known, model)
        return left, tuple(sorted({f"{item.position} {code}" for item, code in used}))

    def _asked(self) -> dict[str, Callable[[str | None], bool]]:
        from urdfkit.lint.rules import RULES

        return {rule.code: partial(self._applies, rule) for rule in RULES}


def codes() -> tuple[str, ...]:
    """Return the codes of all our rules, sorted."""
    from urdfkit.lint.rules import RULES

    return tuple(rule.code for rule in RULES)


def every_code() -> tuple[str, ...]:
    """Return the codes of all our rules and of those that others brought."""
    return (*codes(), *(rule.code for rule in _third_party()))


def _third_party() -> tuple[type[Rule], ...]:
    from urdfkit.registry import load

    return tuple(load("urdfkit.rules"))


def _nothing(path: Path) -> Element:
    """Return the root of a robot that could not be read."""
    return Element("robot", {}, [], "", Origin(Position(str(path), 1, 1)))
