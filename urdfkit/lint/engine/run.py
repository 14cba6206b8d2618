"""Lint files: check each entry file or use its cached result, then merge and sort the findings."""

from __future__ import annotations

from pathlib import Path

from urdfkit.errors import ResourceError
from urdfkit.lint.engine.cache import cache_for
from urdfkit.lint.finding import SEVERITIES, EntryResult, Finding
from urdfkit.lint.project.options import Options
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from typing import Any

    from urdfkit.description.xml.source import Source, Span
    from urdfkit.lint.project.entry_files import Entry

_MIN_PARALLEL = 8
"""Minimum number of files for which several processes are faster."""
_LISTED_TARGETS = 3
"""Maximum number of packages of one target that have a note each."""


@record(eq=False)
class Outcome:
    """Result of a lint run.

    Attributes:
        findings: findings sorted by position.
        sources: name in findings → text, for every file read.
        files: name in findings → absolute path, for every file read.
        notes: one line for each guessed target.
        cached: number of entry files with a valid cached result.
        refused: one line for each file that could not be linted, with the reason.
    """

    findings: tuple[Finding, ...]
    sources: Mapping[str, Source]
    files: Mapping[str, Path]
    notes: tuple[str, ...] = ()
    cached: int = 0
    refused: tuple[str, ...] = ()


def run(
    entries: Iterable[Entry],
    options: Options,
    *,
    cached: bool = False,
    jobs: int = 1,
    keep_going: bool = False,
    progress: Callable[[int, int], None] | None = None,
) -> Outcome:
    """Lint entry files.

    Args:
        entries: the entry files.
        options: lint options.
        cached: use cached results of unchanged files, and store new results.
        jobs: maximum number of processes.
        keep_going: if one of several files cannot be linted or a rule fails, report it in the outcome and continue.
        progress: called with the number of linted files and of all files, after each file that was not cached.

    Raises:
        UsageError: a code or the target is unknown.
        ResourceError: an entry cannot be read, or a third-party rule cannot be imported.
        ModelError: an entry is not a robot description.
    """
    if options.target is not None:
        from urdfkit.lint.project.target_platform import parse_target

        options = Options(**{**options.__dict__, "target": parse_target(options.target)})
    entries = list(entries)
    cache = cache_for(options) if cached else None
    found = {entry: result for entry in entries if cache is not None and (result := cache.get(entry)) is not None}
    hits = len(found)
    left = [entry for entry in entries if entry not in found]
    sources: Mapping[str, Source] = {}
    if left or not entries:  # without files, only the options are validated
        from urdfkit.lint.engine.checker import Checker

        checker = Checker(options, cache=cache, keep_going=keep_going)
        sources = checker.sources
        if jobs > 1 and len(left) >= _MIN_PARALLEL and not options.texts:
            from urdfkit.lint.engine.parallel import check_all

            results = check_all(left, options, cached=cached, jobs=jobs, keep_going=keep_going)
        else:
            results = map(checker.check_or_refuse if keep_going and len(entries) > 1 else checker.check, left)
        for entry, result in zip(left, results, strict=True):
            found[entry] = result
            if progress is not None:
                progress(len(found), len(entries))
    every = [found[entry] for entry in entries]
    files = {name: Path(path) for one in every for name, path in one.files.items()}
    used = {each for one in every for each in one.used}
    findings = merged(finding for one in every for finding in one.findings if not _is_in_use(finding, one.unused, used))
    refused = tuple(dict.fromkeys(one.refused for one in every if one.refused))
    return Outcome(tuple(findings), Sources(sources, files), files, _notes(every), hits, refused)


def _notes(results: list[EntryResult]) -> tuple[str, ...]:
    """Return the notes of results once; one line for many packages of one target, and one for those without a robot."""
    of_targets: dict[str, dict[str, None]] = {}
    for one in results:
        if one.target and one.note:
            of_targets.setdefault(one.target, {})[one.note] = None
    note_of = {
        each: f"{next(iter(notes))}; also {len(notes) - 1} other packages" if len(notes) > _LISTED_TARGETS else each
        for notes in of_targets.values()
        for each in notes
    }
    names = list(dict.fromkeys(one.without_robot for one in results if one.without_robot))
    if len(names) > 1:
        shown = ", ".join(names[:3]) + (" …" if len(names) > 3 else "")
        notes = dict.fromkeys(note_of.get(one.note, one.note) for one in results if one.note and not one.without_robot)
        return (*notes, f"{len(names)} packages have no robot: only their other files are linted ({shown})")
    without = {name: f"{name} has no robot: only its other files are linted" for name in names}
    parts = (filter(None, (note_of.get(one.note, one.note), without.get(one.without_robot))) for one in results)
    return tuple(dict.fromkeys(filter(None, map("; ".join, parts))))


def _is_in_use(finding: Finding, unused: tuple[tuple[str, tuple[str, ...]], ...], used: set[tuple[str, str]]) -> bool:
    """Return whether a suppression that is unused in one robot suppresses a finding in another robot."""
    if finding.code != "E019" or not used:
        return False
    at = str(finding.span.start)
    codes = dict(unused).get(at, ())
    return any(place == at and (not codes or code in codes) for place, code in used)


class Sources(dict[str, "Source"]):
    """Name in findings → text of the file; texts of cached results are read on first access."""

    def __init__(self, sources: Mapping[str, Source], files: Mapping[str, Path]) -> None:
        super().__init__(sources)
        self._files = files

    def get(self, name: str, default: Any = None) -> Any:
        """Return the text of a file; the default if the file is unknown or has been deleted."""
        try:
            return self[name]
        except (KeyError, ResourceError):
            return default

    def __missing__(self, name: str) -> Source:
        from urdfkit.description.xml.source import Source

        self[name] = found = Source.read(self._files[name], shown_as=name)
        return found


def merged(findings: Iterable[Finding]) -> list[Finding]:
    """Return the findings sorted by position; merge findings of several expansions of the same source text."""
    groups: dict[tuple[str, Span], list[_MergedFinding]] = {}
    for finding in _at_common_places(list(findings)):
        merged_here = groups.setdefault((finding.code, finding.span), [])
        if not any(one.add(finding) for one in merged_here):
            merged_here.append(_MergedFinding(finding))
    return sorted(
        (one.finding() for group in groups.values() for one in group), key=lambda f: (f.span, f.code, f.message)
    )


def _at_common_places(findings: list[Finding]) -> Iterable[Finding]:
    """Yield the findings; those on one expression in several robots are at the last place that their values share.

    Where the values of one robot only show which place is wrong, that place is wrong in all robots.
    """
    uses: dict[tuple[str, Span], set[tuple[Span, ...]]] = {}
    for finding in findings:
        if finding.trail:
            uses.setdefault((finding.code, finding.trail[0]), set()).add(finding.trail)
    for finding in findings:
        trails = list(uses.get((finding.code, finding.trail[0] if finding.trail else finding.span), ()))
        if not trails:
            yield finding
            continue
        from urdfkit.lint.engine.call_values import common_trail

        span = common_trail(trails)[-1]
        yield finding if span == finding.span else Finding(**{**finding.__dict__, "span": span, "trail": ()})


class _MergedFinding:
    """Findings of several expansions at one source position; a macro may have thousands of expansions."""

    def __init__(self, first: Finding) -> None:
        self._most_severe = first
        self._chains = dict.fromkeys(first.chains)
        self._related = {each.span: each for each in first.related}

    def add(self, finding: Finding) -> bool:
        """Add a finding with the same message or from another expansion; return False if it is neither."""
        is_another = bool(finding.chains) and self._chains.keys().isdisjoint(finding.chains)
        if not is_another and self._most_severe.message != finding.message:
            return False
        if SEVERITIES.index(finding.severity) < SEVERITIES.index(self._most_severe.severity):
            self._most_severe = finding
        self._chains.update(dict.fromkeys(finding.chains))
        self._related.update((each.span, each) for each in finding.related)
        return True

    def finding(self) -> Finding:
        """Return the most severe finding, with the macro chains and related places of all."""
        found, chains, related = self._most_severe, tuple(self._chains), tuple(self._related.values())
        if (chains, len(related)) == (found.chains, len(found.related)):
            return found
        return Finding(**{**found.__dict__, "chains": chains, "related": related})
