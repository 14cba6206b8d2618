"""Check one entry file: expand with error recovery, run the rules, drop suppressed findings."""

from __future__ import annotations

import os
import re
from pathlib import Path

from urdfkit.description.packages.kept_files import keeping_results
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xml.source import Position
from urdfkit.lint.engine.cache import packages_of
from urdfkit.lint.engine.contradictions import at_wrong_side
from urdfkit.lint.engine.package_without_robot import empty_root, package_model, package_rules
from urdfkit.lint.engine.rule_runner import RuleRunner
from urdfkit.lint.facts.values.missing_calls import with_missing_calls
from urdfkit.lint.facts.values.renamed_definitions import with_renamed_definitions
from urdfkit.lint.facts.values.renaming_arguments import at_renaming_arguments
from urdfkit.lint.finding import EntryResult, Finding
from urdfkit.lint.model.element_facts import ElementFacts
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.robot_text import is_nearly_robot
from urdfkit.lint.project.target_platform import family_of, release_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.description.xacro.memory import Memory
    from urdfkit.description.xml.cost_limit import CostError
    from urdfkit.description.xml.source import Source
    from urdfkit.lint.engine.cache import Cache

_DEFINED_BY_ROBOT = ("undefined-macro", "undefined-property")


def model_of(
    path: Path,
    options: Options,
    *,
    packages: Packages | None = None,
    memory: Memory | None = None,
    facts: ElementFacts | None = None,
) -> Model:
    """Expand a file with error recovery and parse the robot in it.

    Args:
        path: the file.
        options: how to expand it.
        packages: package resolver; by default for packages near the file and in the environment.
        memory: parsed files of earlier calls.
        facts: see `Model.facts`.

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

        world = "; a world goes after --world of `urdfkit sim run`" if root.tag == "sdf" else ""
        raise ModelError(f"<{root.tag}> is not a robot description{world}", position=root.origin.position)
    parsed = memory.parts if memory is not None else None
    robot = parse(root if root is not None else empty_root(path), cached_parts=parsed)
    target, release = family_of(options.target), release_of(options.target)
    kept = facts if facts is not None else ElementFacts()
    return Model(expanded, robot, target, as_written, release, options.texts, kept)


_OPTIONAL = re.compile(r"<!--.*?(?:-->|\Z)|\$\(optenv\s+([^\s)]+)", re.DOTALL)


def _hidden_variables(sources: Iterable[Source]) -> Iterator[Finding]:
    """Yield a note for each environment variable with a default that the confinement hides."""
    from urdfkit.description.packages.resolver import NOT_READ
    from urdfkit.description.xml.source import Span
    from urdfkit.lint.rules.xacro.expansion_error import ExpansionError

    places: dict[str, Position] = {}
    for source in sources:
        for match in _OPTIONAL.finditer(source.text):
            if match[1] and match[1] not in places:
                places[match[1]] = source.position(match.start(1))
    for name, at in places.items():
        span = Span(at.file, at.line, at.column, at.line, at.column + len(name))
        message = f"environment variable '{name}' {NOT_READ}; its default is used"
        yield Finding(ExpansionError.code, ExpansionError.name, "note", message, span)


def _not_read(path: Path, entry: Path) -> Finding:
    """Return the finding for a file that the confinement hides: at a link that leads out, else at the entry file."""
    from urdfkit.description.packages.resolver import OUTSIDE
    from urdfkit.description.xml.reader import shown_path
    from urdfkit.description.xml.source import Span
    from urdfkit.lint.rules.xacro.expansion_error import ExpansionError

    span = Span(shown_path(path if path.is_symlink() else entry), 1, 1, 1, 2)
    message = f"`{shown_path(path)}` is not read: it is {OUTSIDE}"
    return Finding(ExpansionError.code, ExpansionError.name, "error", message, span)


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
        self.sources: dict[str, Source] = {}
        self.cache = cache
        self.packages = cache.packages if cache is not None else packages_of(options)
        self.runner = RuleRunner(options, keep_going=keep_going)

    @keeping_results()
    def check(self, entry: Entry) -> EntryResult:
        """Lint one entry file and all files it includes."""
        from urdfkit.description.xml.cost_limit import CostError
        from urdfkit.errors import UrdfkitError, bug

        confinement = self.options.confinement
        if confinement is not None and not confinement.permits(entry.path):
            return EntryResult((_not_read(entry.path, entry.path),), {})
        try:
            found, model = self.examine(entry)
            others: list[Model] = []
            if self.options.launch_arguments and entry.has_robot and not entry.is_library:
                from urdfkit.lint.engine.variants.branch_variants import with_branches
                from urdfkit.lint.engine.variants.launch_variants import with_variants

                own = self.options.arguments
                found, others = with_variants(found, model, lambda passed: self.examine(entry, passed), own)
                found, branches = with_branches(found, model, others, lambda passed: self.examine(entry, passed), own)
                others += branches
            if confinement is not None:
                refused = (_not_read(Path(path), entry.path) for path in confinement.take_refused())
                hidden = _hidden_variables(model.expanded.sources.values())
                return EntryResult(**{**found.__dict__, "findings": (*found.findings, *refused, *hidden)})
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
        options, note, target = self.options, "", ""
        if arguments is not None:
            options = Options(**{**options.__dict__, "arguments": arguments})
        if options.guess_target and options.target is None:
            from urdfkit.lint.project.target_platform import guess

            guessed = guess(entry.path)
            if guessed.target is not None and guessed.manifest is not None:
                target = guessed.target
                options = Options(**{**options.__dict__, "target": target})
                note = f"linted for {target}: {guessed.manifest.parent.name} {guessed.why}"
        if options.select:
            from urdfkit.lint.engine.inapplicable import inapplicable

            note = "; ".join(filter(None, (note, inapplicable(options.select, family_of(options.target)))))
        packages, clean = self.packages.near_file(entry.path), self.runner.clean
        facts = clean.facts if clean is not None else None
        if not entry.has_robot:
            return self._check_package(entry, options, packages, note, target)
        model = model_of(entry.path, options, packages=packages, memory=self.memory, facts=facts)
        self.sources.update(model.expanded.sources)
        self.runner.failures = []
        if not entry.is_library and _is_part(model):
            entry = Entry(entry.path, entry.only, is_library=True)
        findings = list(self.runner.source_findings(model))
        findings += self.runner.fault_findings(model, entry)
        if model.expanded.root is not None and not entry.is_library:
            findings += self.runner.findings_of_robot(model, entry)
        if model.target != "urdfkit" and findings and (model.expanded.properties or model.expanded.macros):
            from urdfkit.lint.engine.call_values import at_calls
            from urdfkit.lint.engine.fault_causes import at_missing_definitions

            findings = at_missing_definitions(at_calls(findings, model), model)
        if model.target != "urdfkit":  # whose repairs are findings
            from urdfkit.lint.engine.consequences import without_consequences

            findings = without_consequences(findings, lambda: model.unknown_parts)
        used: tuple[tuple[str, str], ...] = ()
        unused: tuple[tuple[str, tuple[str, ...]], ...] = ()
        if any("urdfkit:" in source.text for source in model.expanded.sources.values()):
            from urdfkit.lint.engine.suppression import without_suppressed

            findings, used, unused = without_suppressed(findings, model, entry, options, self.runner)
        if model.target != "urdfkit":
            findings = with_renamed_definitions(at_renaming_arguments(findings, model), model)
            findings = at_wrong_side(with_missing_calls(findings, model))
        here = str(Path.cwd())
        related = model.related_files if model.expanded.root is not None else ()
        read = (*model.expanded.sources, *related, *(each.file for each in findings))  # such as YAML files of xacro
        files = {name: os.path.join(here, name) for name in read}  # noqa: PTH118
        findings = _only(entry, findings)
        refused = "; ".join(self.runner.failures)
        return EntryResult(tuple(findings), files, note, used, refused, unused, target=target), model

    def _check_package(
        self, entry: Entry, options: Options, packages: Packages, note: str, target: str
    ) -> tuple[EntryResult, Model]:
        """Return the findings in the launch, YAML and build files of a package without a robot, and its model."""
        model = package_model(entry.path, options, packages)
        self.runner.failures = []
        rules = [rule for rule in package_rules(model) if self.runner.applies(rule, model.target)]
        findings = [finding for rule in rules for finding in self.runner.robot_findings(rule, entry.path, model)]
        findings = at_wrong_side(findings)
        files = {name: os.path.join(str(Path.cwd()), name) for name in model.related_files}  # noqa: PTH118
        self.sources.update(model.related_files)
        folder = entry.path.absolute().parent
        is_included = any(next(folder.rglob(end), None) for end in ("*.urdf", "*.xacro"))  # by other packages
        name = "" if is_included else folder.name
        found, refused = tuple(_only(entry, findings)), "; ".join(self.runner.failures)
        return EntryResult(found, files, note, refused=refused, without_robot=name, target=target), model


def _only(entry: Entry, findings: list[Finding]) -> list[Finding]:
    """Return the findings in the files that the entry is about."""
    if not entry.only:
        return findings
    only = {path.resolve() for path in entry.only}
    names = {name for one in findings for name in (one.file, *(each.file for each in one.related))}
    names = {name for name in names if not only.isdisjoint(((at := Path(name).resolve()), *at.parents))}
    return [one for one in findings if not names.isdisjoint((one.file, *(each.file for each in one.related)))]


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
