"""Project: the files open in an editor, saved or not, and the models read from them."""

from collections.abc import Mapping, Sequence
from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.memory import Memory
from urdfkit.description.xml.cost_limit import CostError
from urdfkit.errors import UrdfkitError, bug
from urdfkit.lint.engine.checker import Checker, model_of, too_costly
from urdfkit.lint.engine.clean_elements import CleanElements
from urdfkit.lint.engine.run import merged
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry, find_entries
from urdfkit.lint.project.options import Options
from urdfkit.record import record


@record(eq=False)
class Analysis:
    """One entry file, expanded and linted with the texts of the editor.

    Attributes:
        model: the expanded model; None if the entry file cannot be read.
        findings: the findings in all files of the model.
        files: name in findings → absolute path.
        failure: the reason why the model is None, or the rule that failed.
        is_ours: whether the failure is an internal error of urdfkit.
        last_readable: the last readable model; provides names while a tag is being typed.
    """

    model: Model | None
    findings: tuple[Finding, ...]
    files: Mapping[str, Path]
    failure: str = ""
    is_ours: bool = False
    last_readable: Model | None = None


class Project:
    """The texts in an editor and their analyses.

    Args:
        options: lint options.
    """

    def __init__(self, options: Options) -> None:
        self.options = options
        self.texts: dict[str, str] = {}
        self._entries: dict[Path, Sequence[Entry]] = {}
        self._analyses: dict[Entry, Analysis] = {}
        self._last: dict[Entry, Model] = {}
        self._checker: Checker | None = None
        self._packages = Packages(options.package_path)
        self._memories: dict[Entry, tuple[Memory, CleanElements]] = {}

    def set_text(self, path: Path, text: str | None) -> None:
        """Set the editor's text of a file; None to read the file from disk again."""
        if text is None:
            self.texts.pop(str(path), None)
        elif self.texts.get(str(path)) == text:
            return
        else:
            self.texts[str(path)] = text
        self._analyses.clear()

    def forget(self) -> None:
        """Discard cached models, packages and file contents, so that they are read from disk again."""
        self._entries.clear()
        self._analyses.clear()
        self._memories.clear()
        self._packages = Packages(self.options.package_path)

    def entries(self, path: Path) -> Sequence[Entry]:
        """Return the models that a file belongs to: itself, or the models that include it."""
        if path not in self._entries:
            try:
                found = find_entries([path])
            except UrdfkitError:
                found = [Entry(path)]
            self._entries[path] = [Entry(entry.path, (), entry.is_library) for entry in found]
        return self._entries[path]

    def analyses(self, path: Path) -> list[Analysis]:
        """Return the models that a file is part of, expanded and linted with the current texts."""
        return [self._analysis(entry) for entry in self.entries(path)]

    def findings(self, path: Path) -> dict[Path, list[Finding]]:
        """Return the findings of each file of the models that a file belongs to, including files without findings."""
        found: dict[Path, list[Finding]] = {path: []}
        every: list[Finding] = []
        files: dict[str, Path] = {}
        for analysis in self.analyses(path):
            files.update(analysis.files)
            every += analysis.findings
        for file in files.values():
            found.setdefault(file, [])
        for finding in merged(every):
            if finding.file in files:
                found[files[finding.file]].append(finding)
        return found

    def failures(self, path: Path) -> list[str]:
        """Return one line for each internal error in the models that a file belongs to."""
        return list(dict.fromkeys(one.failure for one in self.analyses(path) if one.is_ours))

    def probe(self, entry: Path, path: Path, offset: int, written: str) -> list[str]:
        """Return the values of a text inserted into a file, one for each expansion; see `probe_all`."""
        return self.probe_all(entry, path, [(offset, written)])[0]

    def probe_all(self, entry: Path, path: Path, probes: Sequence[tuple[int, str]]) -> list[list[str]]:
        """Return the values of texts inserted into a file, in one expansion.

        Args:
            entry: the model to expand.
            path: the file.
            probes: where to insert an element with a text in an attribute, and the text, including its ``${…}``.

        Returns:
            For each text its different values; several if a macro is expanded several times.
        """
        text = self.texts.get(str(path))
        text = path.read_text("utf-8", "replace") if text is None else text
        for number, (offset, written) in sorted(enumerate(probes), key=lambda each: each[1][0], reverse=True):
            quoted = written.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")
            mark = f'<urdfkit_probe number="{number}" value="{quoted}"/>'
            text = text[:offset] + mark + text[offset:]
        texts = {**self.texts, str(path): text}
        found: list[dict[str, None]] = [{} for _ in probes]
        try:
            root = model_of(entry, Options(**{**self.options.__dict__, "texts": texts})).expanded.root
        except UrdfkitError:
            root = None
        for element in root.walk() if root is not None else ():
            if element.tag == "urdfkit_probe" and "$" not in (value := element.get("value") or ""):
                found[int(element.get("number") or 0)][value] = None
        return [list(values) for values in found]

    def expanded_with(self, model: Model, texts: Mapping[str, str]) -> Model:
        """Return a model that is expanded again, with other texts of some files."""
        changed = {"texts": {**self.texts, **texts}, "target": model.target}
        return model_of(model.expanded.path, Options(**{**self.options.__dict__, **changed}))

    def _analysis(self, entry: Entry) -> Analysis:
        if entry not in self._analyses:
            options = Options(**{**self.options.__dict__, "texts": dict(self.texts)})
            try:
                if self._checker is None:  # created once, because it searches installed packages for rules
                    self._checker = Checker(options, keep_going=True)
                checker = self._checker
                checker.options, checker.packages = options, self._packages
                checker.memory, checker.runner.clean = self._memories.setdefault(entry, (Memory(), CleanElements()))
                checker.sources.clear()
                found, model = checker.examine(entry)
                files = {name: Path(path) for name, path in found.files.items()}
                findings = tuple(merged(found.findings))
                if model.robot.links and not any(fault.kind == "xml" for fault in model.expanded.faults):
                    self._last[entry] = model
                readable, failure = self._last.get(entry, model), found.refused
                self._analyses[entry] = Analysis(model, findings, files, failure, bool(failure), readable)
            except CostError as error:
                self._memories.pop(entry, None)  # half updated
                found = too_costly(entry.path, error)
                files = {name: Path(path) for name, path in found.files.items()}
                kept = self._last.get(entry)
                self._analyses[entry] = Analysis(None, found.findings, files, str(error), False, kept)
            except UrdfkitError as error:
                self._analyses[entry] = Analysis(None, (), {}, str(error))
            except Exception as error:
                self._analyses[entry] = Analysis(None, (), {}, f"{entry.path}: {bug(error)}", is_ours=True)
        return self._analyses[entry]
