"""Check one entry file: expand with error recovery, run the rules, drop suppressed findings."""

from __future__ import annotations

import os
import re
from functools import partial
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position
from urdfkit.lint.engine.cache import packages_of
from urdfkit.lint.engine.package_without_robot import empty_root, package_model, package_rules
from urdfkit.lint.finding import EntryResult, Finding
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.robot_text import is_nearly_robot
from urdfkit.lint.project.rule_selection import selection
from urdfkit.lint.project.target_platform import family_of, release_of
from urdfkit.lint.project.unrelated_packages import WITHOUT_ROBOT
from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule
from urdfkit.lint.rules import fault_rules, related_file_rules, robot_rules, source_rules

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping
    from typing import Any

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.description.xacro.memory import Memory
    from urdfkit.description.xml.cost_limit import CostError
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.engine.cache import Cache
    from urdfkit.lint.engine.clean_elements import CleanElements
    from urdfkit.lint.facts.suppressions import Suppression
    from urdfkit.lint.model.placement import Extent

_EVERYWHERE = ("xml", "encoding", "misspelt-directive", "directive-attribute", "too-large", "too-many")
"""Fault kinds reported in included files too; other faults may come from definitions in the including file."""
_DEFINED_BY_ROBOT = ("undefined-macro", "undefined-property")


def model_of(
    path: Path,
    options: Options,
    *,
    packages: Packages | None = None,
    memory: Memory | None = None,
    extents: dict[Element, Extent] | None = None,
) -> Model:
    """Expand a file with error recovery and parse the robot in it.

    Args:
        path: the file.
        options: how to expand it.
        packages: package resolver; by default for packages near the file and in the environment.
        memory: parsed files of earlier calls.
        extents: see `Model.cached_extents`.

    Raises:
        ResourceError: the file cannot be read.
        ModelError: the file is not a robot description.
    """
    # A cached result needs neither, and their imports are a tenth of the time it takes.
    from urdfkit.description.urdf.parser import parse
    from urdfkit.description.xacro.expand import expand_leniently

    packages = packages if packages is not None else Packages(options.package_path, near=path)

    def as_written() -> Robot:
        expanded = expand_leniently(
            path, arguments=options.arguments, packages=packages, add_prefixes=False, texts=options.texts
        )
        return parse(expanded.root) if expanded.root is not None else robot

    expanded = expand_leniently(
        path, arguments=options.arguments, packages=packages, texts=options.texts, memory=memory
    )
    root = expanded.root
    if root is not None and root.tag != "robot" and not is_nearly_robot(root.tag):
        from urdfkit.errors import ModelError

        raise ModelError(f"<{root.tag}> is not a robot description", position=root.origin.position)
    parsed = memory.parts if memory is not None else None
    robot = parse(root if root is not None else empty_root(path), cached_parts=parsed)
    target, release = family_of(options.target), release_of(options.target)
    return Model(expanded, robot, target, as_written, release, options.texts, extents if extents is not None else {})


class Checker:
    """One lint run over several entry files.

    Args:
        options: lint options.
        cache: stores new results; None for none.
        keep_going: if a rule raises an exception, run the other rules and report the failure in the result.
    """

    def __init__(self, options: Options, *, cache: Cache | None = None, keep_going: bool = False) -> None:
        self.options, self.keep_going = options, keep_going
        self.memory: Memory | None = None
        self.clean: CleanElements | None = None
        self.sources: dict[str, Source] = {}
        self.cache = cache
        self.packages = cache.packages if cache is not None else packages_of(options)
        self.foreign = _third_party()
        self.wanted = selection(options.select, options.ignore, self._codes)

    def _codes(self) -> tuple[str, ...]:
        return (*codes(), *(rule.code for rule in self.foreign))

    def _applies(self, rule: type[Rule], target: str | None) -> bool:
        return self.wanted(rule.code) and target not in rule.not_for and (not rule.only_for or target in rule.only_for)

    def check(self, entry: Entry) -> EntryResult:
        """Lint one entry file and all files it includes."""
        from urdfkit.description.xml.cost_limit import CostError
        from urdfkit.errors import UrdfkitError, bug

        try:
            found, model = self.examine(entry)
            others: list[Model] = []
            if self.options.launch_arguments and entry.has_robot and not entry.is_library:
                from urdfkit.lint.engine.launch_variants import with_variants

                own = self.options.arguments
                found, others = with_variants(found, model, lambda passed: self.examine(entry, passed), own)
            if self.options.confinement is not None:
                refused = self._refused_reads(entry, self.options.confinement.take_refused())
                return EntryResult(**{**found.__dict__, "findings": (*found.findings, *refused)})
            if self.cache is not None and not found.refused:
                self.cache.put(entry, found, *(each.expanded for each in (model, *others)))
        except CostError as error:
            return too_costly(entry.path, error)
        except UrdfkitError:
            raise
        except Exception as error:
            if not self.keep_going:
                raise
            return EntryResult((), {}, refused=f"{entry.path}: {bug(error)}")
        return found

    def _refused_reads(self, entry: Entry, paths: tuple[str, ...]) -> Iterator[Finding]:
        """Yield a finding for each file that was not read because of the confinement."""
        from urdfkit.description.packages.resolver import OUTSIDE
        from urdfkit.description.xml.reader import shown_path
        from urdfkit.description.xml.source import Span
        from urdfkit.lint.rules.xacro.expansion_error import ExpansionError

        span = Span(shown_path(entry.path), 1, 1, 1, 2)
        for path in paths:
            message = f"`{shown_path(Path(path))}` is not read: it is {OUTSIDE}"
            yield Finding(ExpansionError.code, ExpansionError.name, "error", message, span)

    def check_or_refuse(self, entry: Entry) -> EntryResult:
        """Lint one of several entry files; record failures in the result instead of raising them."""
        from urdfkit.errors import UrdfkitError

        try:
            return self.check(entry)
        except UrdfkitError as error:
            return EntryResult((), {}, refused=str(error))

    def examine(self, entry: Entry, arguments: Mapping[str, str] | None = None) -> tuple[EntryResult, Model]:
        """Lint one entry file, on request with other xacro arguments; return the result and the model."""
        from urdfkit.description.xml.cost_limit import CostLimit

        with CostLimit(self.options.time_limit):
            return self._examine(entry, arguments)

    def _examine(self, entry: Entry, arguments: Mapping[str, str] | None) -> tuple[EntryResult, Model]:
        options, note = self.options, ""
        if arguments is not None:
            options = Options(**{**options.__dict__, "arguments": arguments})
        if options.guess_target and options.target is None:
            from urdfkit.lint.project.target_platform import guess

            guessed = guess(entry.path)
            if guessed.target is not None and guessed.manifest is not None:
                options = Options(**{**options.__dict__, "target": guessed.target})
                note = f"linted for {guessed.target}: {guessed.manifest.parent.name} {guessed.why}"
        if options.select:
            from urdfkit.lint.engine.inapplicable import inapplicable

            note = "; ".join(filter(None, (note, inapplicable(options.select, family_of(options.target)))))
        packages, extents = self.packages.near_file(entry.path), self.clean.extents if self.clean is not None else None
        if not entry.has_robot:
            return self._check_package(entry, options, packages, note)
        model = model_of(entry.path, options, packages=packages, memory=self.memory, extents=extents)
        self.sources.update(model.expanded.sources)
        self._failures: list[str] = []
        if not entry.is_library and _is_part(model):
            entry = Entry(entry.path, entry.only, is_library=True)
        findings = list(self._run_source_rules(model))
        findings += self._run_fault_rules(model, entry)
        if model.expanded.root is not None and not entry.is_library:
            foreign = [rule for rule in self.foreign if issubclass(rule, RobotRule)]
            outside = related_file_rules(model.related_files)
            if self.clean is not None:
                self.clean.begin(model)
            features = self.clean.features if self.clean is not None else None
            for rule in (*robot_rules(model.robot, model.target, features, model.key), *outside, *foreign):
                if self._applies(rule, model.target):
                    findings += self._run_robot_rule(rule, entry.path, model)
        used: tuple[tuple[str, str], ...] = ()
        unused: tuple[tuple[str, tuple[str, ...]], ...] = ()
        if any("urdfkit:" in source.text for source in model.expanded.sources.values()):
            findings, used, unused = self._suppress(findings, model, entry)
        here = str(Path.cwd())
        read = (*model.expanded.sources, *(model.related_files if model.expanded.root is not None else ()))
        files = {name: os.path.join(here, name) for name in read}  # noqa: PTH118
        findings = _only(entry, findings, files)
        return EntryResult(tuple(findings), files, note, used, "; ".join(self._failures), unused), model

    def _check_package(
        self, entry: Entry, options: Options, packages: Packages, note: str
    ) -> tuple[EntryResult, Model]:
        """Return the findings in the launch, YAML and build files of a package without a robot, and its model."""
        model = package_model(entry.path, options, packages)
        self._failures = []
        rules = [rule for rule in package_rules(model) if self._applies(rule, model.target)]
        findings = [finding for rule in rules for finding in self._run_robot_rule(rule, entry.path, model)]
        files = {name: os.path.join(str(Path.cwd()), name) for name in model.related_files}  # noqa: PTH118
        self.sources.update(model.related_files)
        without = f"{entry.path.absolute().parent.name}{WITHOUT_ROBOT}"
        note = f"{note}; {without}" if note else without
        result = EntryResult(tuple(_only(entry, findings, files)), files, note, refused="; ".join(self._failures))
        return result, model

    def _run_source_rules(self, model: Model) -> Iterator[Finding]:
        sources = model.expanded.sources
        foreign = [rule for rule in self.foreign if issubclass(rule, SourceRule)]
        rules = [rule for rule in (*source_rules(sources), *foreign) if self._applies(rule, model.target)]
        for file in sources:
            for rule in rules:
                yield from self._run(rule, file, model.document(file), model)

    def _run_fault_rules(self, model: Model, entry: Entry) -> Iterator[Finding]:
        faults = (*model.encoding_faults, *model.expanded.faults)
        if not faults:
            return
        rules = [rule() for rule in (*fault_rules(), *(rule for rule in self.foreign if issubclass(rule, FaultRule)))]
        for fault in faults:
            if entry.is_library and fault.kind not in _EVERYWHERE:
                continue
            for rule in rules:
                if rule.claims(fault) and self._applies(type(rule), model.target):
                    yield from self._run(type(rule), entry.path, fault, model)

    def _run_robot_rule(self, rule: type[Any], file: Path, model: Model) -> list[Finding]:
        """Return the findings of a rule; sizes of meshes in their conditions and messages are exact."""
        boxes, failures = model.mesh_boxes, len(self._failures)
        while True:
            boxes.were_used = False
            found = list(self._findings_of(rule, file, model))
            if not (found and boxes.were_used and boxes.measure(model.robot, (finding.link for finding in found))):
                return found
            del self._failures[failures:]

    def _findings_of(self, rule: type[Any], file: Path, model: Model) -> Iterable[Finding]:
        if not rule.checks_each_alone:
            return self._run(rule, file, model)
        failures = len(self._failures)
        if self.clean is not None:
            found = self.clean.check(rule, lambda part: list(self._run(rule, file, part)))
            if len(self._failures) > failures:
                self.clean.forget(rule)
            return found
        found = list(self._run(rule, file, model.distinct))
        if model.distinct is model or not (found or len(self._failures) > failures):
            return found
        del self._failures[failures:]
        return self._run(rule, file, model)

    def _run(self, rule: type[Any], file: Path | str, *subject: Any) -> Iterator[Finding]:
        """Yield the findings of a rule; if the rule raises an exception, record the failure and continue."""
        from urdfkit.errors import UrdfkitError, bug

        try:
            yield from rule().check(*subject)
        except UrdfkitError:
            raise
        except Exception as error:
            if not self.keep_going:
                raise
            package = rule.__module__.partition(".")[0]
            self._failures.append(f"{file}: {rule.code} {rule.name} could not check this file: {bug(error, package)}")

    def _suppress(
        self, findings: list[Finding], model: Model, entry: Entry
    ) -> tuple[list[Finding], tuple[tuple[str, str], ...], tuple[tuple[str, tuple[str, ...]], ...]]:
        """Return the findings that no comment suppresses, and `used` and `unused` of the `EntryResult`."""
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
        judged = {code for code, target in self._applicability().items() if target(model.target)}
        if entry.is_library or model.is_incomplete:
            judged.clear()
        every = bool(judged) and not self.options.select and not self.options.ignore
        codes: dict[int, set[str]] = {}
        for item, code in used:
            codes.setdefault(id(item), set()).add(code)
        without: list[tuple[Suppression, tuple[str, ...]]] = []
        for items in comments.values():
            unused = []
            for item in items:
                met = codes.get(id(item), set())
                lost = tuple(code for code in item.codes if code in judged and code not in met)
                if lost or (every and not item.codes and not met):
                    unused.append((item, lost))
            without += unused
            if self._applies(UnusedSuppression, model.target):
                valid = [one for one in unused if one[0].verb in ("ignore", "ignore-file")]
                left += UnusedSuppression().check(valid, model)
        places = tuple(sorted({(str(item.position), code) for item, code in used}))
        return left, places, tuple((str(item.position), codes) for item, codes in without)

    def _applicability(self) -> dict[str, Callable[[str | None], bool]]:
        from urdfkit.lint.rules import RULES

        return {rule.code: partial(self._applies, rule) for rule in RULES}


def _only(entry: Entry, findings: list[Finding], files: Mapping[str, str]) -> list[Finding]:
    """Return the findings in the files that the entry is about."""
    if not entry.only:
        return findings
    only = {path.resolve() for path in entry.only}
    names = {name for name, path in files.items() if not only.isdisjoint(((at := Path(path).resolve()), *at.parents))}
    return [finding for finding in findings if finding.file in names]


def _is_part(model: Model) -> bool:
    """Return whether a file without a robot's name uses macros and properties that other files of its package define.

    No file includes it, so it is a part of a robot that does not include it any more, or not yet.
    """
    lacking = {fault.name for fault in model.expanded.faults if fault.kind in _DEFINED_BY_ROBOT and fault.name}
    root = model.expanded.root
    if not lacking or root is None or "name" in root.attributes or model.package is None:
        return False
    from urdfkit.lint.project.description_files import SUFFIXES, near_descriptions

    model.watch(*SUFFIXES)
    texts = [text for _, text in near_descriptions(model.package, model.expanded.path)]
    patterns = (rf"<xacro:(?:macro|property|arg)\s[^<>]*\bname\s*=\s*[\"']{re.escape(name)}[\"']" for name in lacking)
    return all(any(re.search(pattern, text) for text in texts) for pattern in patterns)


def too_costly(path: Path, error: CostError) -> EntryResult:
    """Return the one finding of a file that takes more CPU time or memory than permitted."""
    from urdfkit.description.xml.reader import shown_path
    from urdfkit.description.xml.source import Span
    from urdfkit.lint.rules.xacro.too_large import TooLarge

    shown = shown_path(path)
    at = error.position or Position(shown, 1, 1)
    span = Span(at.file, at.line, at.column, at.line, at.column + 1)
    finding = Finding(TooLarge.code, TooLarge.name, TooLarge.severity, f"linting takes {error.message}", span)
    files = {name: os.path.join(str(Path.cwd()), name) for name in (shown, at.file)}  # noqa: PTH118
    return EntryResult((finding,), files)


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
