"""From files to findings: check each, or take what is known of it; merge, sort."""

from __future__ import annotations

from pathlib import Path

from urdfkit.errors import ResourceError
from urdfkit.lint.engine.checker import Checker
from urdfkit.lint.finding import SEVERITIES, Finding
from urdfkit.lint.project.entry_files import Entry, find_entries
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.target import known_target
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from typing import Any

    from urdfkit.description.xml.source import Source, Span

_AT_ONCE = 8
"""From so many files on it pays to lint them in several processes."""


@record(eq=False)
class Outcome:
    """What came of linting.

    Attributes:
        findings: sorted by place.
        sources: the text of every file that was read, by the name findings use.
        files: every file that was read, absolute; by the same name.
        notes: what targets were guessed, one line each.
        cached: how many entry files had not changed since they were linted before.
        refused: why some of several files could not be linted, one line each.
    """

    findings: tuple[Finding, ...]
    sources: Mapping[str, Source]
    files: Mapping[str, Path]
    notes: tuple[str, ...] = ()
    cached: int = 0
    refused: tuple[str, ...] = ()


def lint(
    paths: str | Path | Iterable[str | Path],
    *,
    select: Iterable[str] = (),
    ignore: Iterable[str] = (),
    target: str | None = None,
    arguments: Mapping[str, str] | None = None,
    package_path: Iterable[str | Path] = (),
) -> list[Finding]:
    """Lint files, packages or workspaces.

    Args:
        paths: one or more files or folders, or names of robots we ship.
        select: codes, or beginnings of codes, to report; all where it is empty.
        ignore: codes, or beginnings, not to report.
        target: the consumer the robot is meant for, one of `TARGETS`, or with its release: ``ros2-jazzy``.
        arguments: values for ``$(arg …)``.
        package_path: folders to look for packages in first.

    Returns:
        The findings, sorted by place. Faults in the files are findings, not exceptions.

    Raises:
        UsageError: a code or the target is not known.
        ResourceError: a path is not there, or holds no description.
    """
    several = [paths] if isinstance(paths, (str, Path)) else list(paths)
    folders = tuple(Path(folder) for folder in package_path)
    options = Options(tuple(select), tuple(ignore), target, arguments or {}, folders)
    return list(run(find_entries(several), options).findings)


def run(
    entries: Iterable[Entry], options: Options, *, cached: bool = False, jobs: int = 1, keep_going: bool = False
) -> Outcome:
    """Lint entry files.

    Args:
        entries: what to lint.
        options: how.
        cached: take what was found before where nothing has changed since, and keep what is found now.
        jobs: how many processes to lint in at most.
        keep_going: lint the others where some of several cannot be linted, or a rule fails, and say so in the outcome.

    Raises:
        UsageError: a code or the target is not known.
        ResourceError: an entry cannot be read, or a third-party rule cannot be imported.
        ModelError: an entry is no robot description.
    """
    options = Options(**{**options.__dict__, "target": known_target(options.target)})
    entries = list(entries)
    checker = Checker(options, cached=cached, keep_going=keep_going)
    check = checker.tried if keep_going and len(entries) > 1 else checker.check
    found = {entry: known for entry in entries if (known := checker.known(entry)) is not None}
    hits = len(found)
    left = [entry for entry in entries if entry not in found]
    if jobs > 1 and len(left) >= _AT_ONCE and not options.texts:
        from urdfkit.lint.engine.parallel import check_all

        found.update(zip(left, check_all(left, options, cached=cached, jobs=jobs, keep_going=keep_going), strict=True))
    else:
        found.update((entry, check(entry)) for entry in left)
    every = [found[entry] for entry in entries]
    files = {name: Path(path) for one in every for name, path in one.files.items()}
    used = {place for one in every for place in one.used}
    findings = merged(finding for one in every for finding in one.findings if not _is_in_use(finding, used))
    notes = dict.fromkeys(one.note for one in every if one.note)
    refused = tuple(dict.fromkeys(one.refused for one in every if one.refused))
    return Outcome(tuple(findings), Sources(checker.sources, files), files, tuple(notes), hits, refused)


def _is_in_use(finding: Finding, used: set[str]) -> bool:
    """Whether a suppression without use in one robot is in use in another."""
    if finding.code != "E019" or not used:
        return False
    codes = finding.message.split("`")[1::2]
    at = str(finding.span.start)
    return any(place.startswith(f"{at} ") and (not codes or place.split()[-1] in codes) for place in used)


class Sources(dict[str, "Source"]):
    """The text of every file that was read, by the name findings use; read again when it is not at hand.

    What was found before comes without the texts that it was found in.
    """

    def __init__(self, sources: Mapping[str, Source], files: Mapping[str, Path]) -> None:
        super().__init__(sources)
        self._files = files

    def get(self, name: str, default: Any = None) -> Any:
        """Return the text of a file, the default where nobody has read it or it has gone."""
        try:
            return self[name]
        except (KeyError, ResourceError):
            return default

    def __missing__(self, name: str) -> Source:
        from urdfkit.description.xml.source import Source

        self[name] = found = Source.read(self._files[name], shown_as=name)
        return found


def merged(findings: Iterable[Finding]) -> list[Finding]:
    """Return the findings sorted by place; what was found at one place in several expansions becomes one finding."""
    groups: dict[tuple[str, Span], list[_Together]] = {}
    for finding in findings:
        together = groups.setdefault((finding.code, finding.span), [])
        if not any(one.takes(finding) for one in together):
            together.append(_Together(finding))
    return sorted(
        (one.finding() for group in groups.values() for one in group), key=lambda f: (f.span, f.code, f.message)
    )


class _Together:
    """What was found at one place in several expansions: a macro may have thousands."""

    def __init__(self, first: Finding) -> None:
        self._worst = first
        self._chains = dict.fromkeys(first.chains)

    def takes(self, finding: Finding) -> bool:
        """Take a finding that says the same, or the same of another expansion; return whether it is one."""
        is_another = bool(finding.chains) and self._chains.keys().isdisjoint(finding.chains)
        if not is_another and self._worst.message != finding.message:
            return False
        if SEVERITIES.index(finding.severity) < SEVERITIES.index(self._worst.severity):
            self._worst = finding
        self._chains.update(dict.fromkeys(finding.chains))
        return True

    def finding(self) -> Finding:
        """Return the worst of them, with the chains of all."""
        chains = tuple(self._chains)
        return self._worst if chains == self._worst.chains else Finding(**{**self._worst.__dict__, "chains": chains})
