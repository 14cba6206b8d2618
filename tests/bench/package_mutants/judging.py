"""Lint a mutant and judge the findings."""

from __future__ import annotations

import ast
import os
import re
import shutil
import tempfile
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import yaml

from tests.bench.package_mutants.mutant import Mutant
from urdfkit import expand
from urdfkit.errors import UrdfkitError
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import find_each
from urdfkit.lint.project.options import Options


@dataclass(frozen=True)
class Report:
    """Output of the linter: one finding, or a file that it refuses."""

    code: str
    severity: str
    message: str
    file: str = ""
    first: int = 0
    last: int = 0
    calls: tuple[tuple[str, int], ...] = ()


@dataclass(frozen=True)
class Verdict:
    """The judgement of one mutant; `effective` is False if it changes nothing that a reader sees."""

    mutant: Mutant
    effective: bool = True
    found: tuple[Report, ...] = ()
    at_line: bool = False
    others: tuple[Report, ...] = ()
    line: int = 0
    before: str = ""


def lint(folder: Path) -> list[Report]:
    """Return the findings of a workspace, with paths inside it."""
    os.chdir(folder)
    options = Options(guess_target=True)
    try:
        entries, refused = find_each(["."])
        outcome = run(entries, options, keep_going=True)
    except UrdfkitError as error:
        return [Report("refused", "error", str(error))]
    reports = [Report("refused", "error", line) for line in (*refused, *outcome.refused)]
    for finding in outcome.findings:
        calls = tuple((call.position.file, call.position.line) for call in finding.expansions)
        message = f"{finding.message} {finding.help or ''}"
        span = finding.span
        reports.append(Report(finding.code, finding.severity, message, finding.file, span.line, span.end_line, calls))
    return reports


def apply(mutant: Mutant, folder: Path) -> None:
    """Make the mistake."""
    path = folder / mutant.file
    if mutant.action == "delete":
        path.unlink()
    elif mutant.action == "rename":
        path.rename(folder / mutant.text)
    elif mutant.action == "add":
        path.write_text(mutant.text, "utf-8")
    else:
        text = path.read_text("utf-8")
        path.write_text(text[: mutant.start] + mutant.text + text[mutant.end :], "utf-8")


def _content(path: Path, text: str) -> object:
    """Return the parsed content of a file; the error if it cannot be read."""
    try:
        if path.suffix == ".yaml":
            return yaml.safe_load(text)
        if path.suffix == ".py":
            return ast.dump(ast.parse(text))
        if path.suffix in (".xml", ".launch", ".srdf", ".xacro", ".world"):
            return ElementTree.canonicalize(text, strip_text=True)
    except (yaml.YAMLError, SyntaxError) as error:
        return repr(error)
    return " ".join(re.sub(r"#.*", "", text).split())


def _expanded(folder: Path) -> list[str]:
    os.chdir(folder)
    found = []
    for path in sorted(Path().glob("*_description/urdf/*.urdf.xacro")):
        try:
            found.append(expand(path))
        except UrdfkitError as error:
            found.append(str(error))
    return found


def is_effective(mutant: Mutant, before: Path, after: Path) -> bool:
    """Return whether the mutant changes the parsed content of its file and, for the model, the expanded robot."""
    if mutant.action != "edit":
        return True
    path = before / mutant.file
    if _content(path, path.read_text("utf-8")) == _content(path, (after / mutant.file).read_text("utf-8")):
        return False
    return mutant.area != "model" or _expanded(before) != _expanded(after)


def judge(mutant: Mutant, base: Path) -> Verdict:
    """Lint a copy of a workspace with a mistake."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary).resolve() / "src"
        shutil.copytree(base, folder)
        apply(mutant, folder)
        if not is_effective(mutant, base, folder):
            return Verdict(mutant, effective=False)
        reports = lint(folder)
        found, others, at_line = [], [], False
        places = Places(mutant, base, folder)
        for report in reports:
            exact = places.at_line(report)
            if exact or places.names_it(report):
                found.append(report)
                at_line = at_line or exact
            else:
                others.append(report)
        os.chdir(base)
    return Verdict(mutant, True, tuple(found), at_line, tuple(others), places.first, places.before)


class Places:
    """The lines that a finding may name."""

    def __init__(self, mutant: Mutant, base: Path, folder: Path) -> None:
        self.mutant = mutant
        self.folder = folder
        self.names = [re.compile(rf"(?<![\w-]){re.escape(name)}(?![\w-])") for name in mutant.names if name]
        original = (base / mutant.file).read_text("utf-8") if (base / mutant.file).exists() else ""
        text = mutant.text if mutant.action == "edit" else ""
        changed = original[: mutant.start] + text + original[mutant.end :]
        shift = len(text) - (mutant.end - mutant.start)

        def line(offset: int) -> int:
            moved = offset if offset <= mutant.start else max(offset + shift, mutant.start)
            return changed.count("\n", 0, min(moved, len(changed))) + 1

        self.first = line(mutant.start)
        self.before = original[mutant.start : mutant.end]
        end = mutant.start + len(text.rstrip("\n"))
        self.exact = [(self.first, changed.count("\n", 0, end) + 1)]
        if mutant.also is not None:
            self.exact.append((line(mutant.also[0]), line(max(mutant.also[0], mutant.also[1] - 1))))
        self.around = (line(mutant.around[0]), line(mutant.around[1])) if mutant.around is not None else self.exact[0]

    def at_line(self, report: Report) -> bool:
        """Return whether a finding is at the changed line, at a use of the changed name, or names the line."""
        mutant = self.mutant
        if report.file == mutant.file and mutant.action in ("edit", "add"):
            near = [first - 1 <= report.last and report.first <= last + 1 for first, last in self.exact]
            if any(near) or mutant.anywhere or mutant.action == "add":
                return True
        for file, at in report.calls:
            if file == mutant.file and any(first - 1 <= at <= last + 1 for first, last in self.exact):
                return True
        lines = [f"{first}" for first, _ in self.exact]
        if any(f"{mutant.file}:{line}" in report.message for line in lines):
            return True
        if report.file == mutant.file and any(re.search(rf"\bline {line}\b", report.message) for line in lines):
            return True
        if mutant.anywhere and any(name.search(report.message) for name in self.names):
            return True
        return mutant.uses and any(name.search(self._text(report)) for name in self.names)

    def names_it(self, report: Report) -> bool:
        """Return whether a finding is inside of the changed element or quotes a name of the mistake."""
        first, last = self.around
        if (
            report.file == self.mutant.file
            and self.mutant.action == "edit"
            and first <= report.last
            and report.first <= last
        ):
            return True
        return any(name.search(report.message) for name in self.names)

    def _text(self, report: Report) -> str:
        path = self.folder / report.file
        if not report.file or not path.is_file():
            return report.message
        lines = path.read_text("utf-8").splitlines()
        return "\n".join(lines[report.first - 1 : report.last])
