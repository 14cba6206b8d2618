"""Make again in place what a template has made: after a change of the template, or of the answers.

What nobody has edited since is replaced. What somebody has is left alone, and what it would be now is put beside it
with ``.new`` behind its name, as package managers do with settings. What was deleted stays away, and what is made no
more goes, unless a file that stays names it. An outcome with errors that were not there is refused: then no more is put
there than what it has to be merged with.
"""

from __future__ import annotations

import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from itertools import chain, count
from pathlib import Path
from typing import Literal

from urdfkit.atomic import staging, undisturbed
from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold.templates.recipe import Made, digest
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.update.file_references import needed
from urdfkit.scaffold.update.rendering import Finisher, finished, render, write_recipe
from urdfkit.scaffold.update.staged_packages import Checker, Fault, worsened

BESIDE = ".new"
"""Behind the name of what a file that was edited would be now."""

_LISTED = 3
"""So many findings are told; of more, how many."""

Kind = Literal["add", "replace", "remove", "beside", "keep", "needed"]


@dataclass(frozen=True, slots=True)
class Change:
    """What becomes of one file.

    Attributes:
        kind: it is new; it takes the place of one that was not edited; it is no more; it is put beside one that was
            edited; it was edited or deleted and is left so; or it would be no more, and a file that stays names it.
        path: from the folder that is written to; of `beside` that of the file which was edited.
        before: what is there; empty where nothing is.
        after: what it would be; empty where nothing would.
        because: of `needed`, the file that names it.
        at: of `beside`, where it is put.
    """

    kind: Kind
    path: Path
    before: bytes = b""
    after: bytes = b""
    because: Path | None = None
    at: Path | None = None

    @property
    def is_none(self) -> bool:
        """Whether the file stays as it is."""
        return self.kind in ("keep", "needed")


@dataclass(frozen=True, slots=True)
class Update:
    """Changes that are ready to be made.

    Attributes:
        changes: by path.
        refused: why they are not to be made: with what was edited the outcome would not work; empty where it would.
        warned: what the linter would say of the outcome, and does not of what is there, a line each.
        unused: parts of models that are new, and that nothing names before what was edited is merged.
    """

    changes: tuple[Change, ...]
    refused: str
    warned: tuple[str, ...]
    unused: tuple[Path, ...]
    _stage: Path
    _folder: Path

    @property
    def beside(self) -> tuple[Change, ...]:
        """What is put beside files that were edited, to merge from."""
        return tuple(change for change in self.changes if change.kind == "beside")

    def apply(self) -> None:
        """Make the changes; if one fails all are undone.

        Raises:
            ResourceError: they are refused, or cannot be written.
        """
        if self.refused:
            raise ResourceError(f"nothing was changed: {self.refused}")
        self._make(self.changes)

    def offer(self) -> None:
        """Put no more than `beside` where it is to be merged from.

        Raises:
            ResourceError: it cannot be written.
        """
        self._make(self.beside)

    def _make(self, changes: Sequence[Change]) -> None:
        undo: list[tuple[Path, Path]] = []
        old = self._stage / ".old"
        try:
            with undisturbed():
                for number, change in enumerate(changes):
                    target = self._folder / (change.at or change.path)
                    if change.is_none:
                        continue
                    if os.path.lexists(target):
                        old.mkdir(exist_ok=True)
                        target.rename(old / str(number))
                        undo.append((old / str(number), target))
                    if change.kind != "remove":
                        target.parent.mkdir(parents=True, exist_ok=True)
                        (self._stage / change.path).rename(target)
                        undo.append((target, self._stage / change.path))
        except OSError as error:
            for here, there in reversed(undo):
                here.rename(there)
            raise ResourceError(f"nothing was changed: cannot write {target}: {error.strerror}") from error
        for change in changes:
            if change.kind == "remove":
                _remove_empty(self._folder / change.path.parent, self._folder)


def find_recipe(template: Template | None, folder: Path) -> tuple[Path, Path]:
    """Return the recipe in a folder that something was written to, and that folder.

    Args:
        template: what was written; any when None.
        folder: the folder, or a package that was written to it.

    Raises:
        ResourceError: there is none, or several.
    """
    pattern = "*/urdfkit-new.toml" if template is None or not template.recipe else _pattern(template.recipe)
    name = pattern.rpartition("/")[2]
    found = sorted(folder.glob(pattern))
    if not found and (folder / name).is_file():
        found = [folder.absolute() / name]
    if not found:
        raise ResourceError(f"nothing to update in {folder}: no {pattern}, which `urdfkit new` keeps")
    if len(found) > 1:
        listed = ", ".join(str(path.parent) for path in found)
        raise ResourceError(f"several to update in {folder}, name one by --into: {listed}")
    return found[0], found[0].parents[pattern.count("/")]


def _pattern(recipe: str) -> str:
    return "/".join("*" if "@" in part else part for part in recipe.split("/"))


@contextmanager
def updating(
    template: Template,
    answers: Mapping[str, str],
    folder: Path,
    made: Made,
    *,
    check: Checker | None = None,
    finish: Finisher | None = None,
) -> Iterator[Update]:
    """Provide what has to change for `folder` to be what the template makes now.

    Args:
        template: what to write.
        answers: answers by question, with the built-in ones.
        folder: it was written to.
        made: what was written.
        check: has to find nothing in what would be written.
        finish: adds what no template holds.

    Raises:
        ResourceError: the result does not pass `check`, or it cannot be written.
        UsageError: it is for another name: what would be written are other packages.
    """
    packages = {Path(name).parts[0] for name in made.digests}
    tops = {target.parts[0] for _, target in template.files(answers)} - template.spare(answers)
    if packages and not packages & tops:
        would = ", ".join(sorted(tops))
        raise UsageError(
            f"--update keeps names, and would make {would}: make that anew, with --from and another --into"
        )
    with staging(folder) as stage:
        render(template, answers, stage, without=_foreign(template, answers, folder, packages))
        files = finished(template, answers, stage, check=check, finish=finish)
        recipe = files[-1]
        gone = sorted(set(map(Path, made.digests)) - set(files))
        going = [change for path in gone if (change := _left_over(path, folder, made)) is not None]
        coming = [(path, _change(path, folder, stage, made, recipe)) for path in files if path != recipe]
        going = _without_needed(
            going, folder, [path for path, change in coming if _is_ours(path, change, folder, stage)]
        )
        needed_yet = {change.path: change.before for change in going if change.kind == "needed"}
        write_recipe(template, answers, stage, files, also=needed_yet)
        coming.append((recipe, _change(recipe, folder, stage, made, recipe)))
        changes = (*(change for _, change in coming if change is not None), *going)
        found, unused = ([], []) if check is None else _worsened(changes, check, folder, stage)
        warned = tuple(_shortened([str(fault) for fault in found]))
        yield Update(changes, _refused(changes, found), warned, tuple(unused), stage, folder)


def _worsened(
    changes: Sequence[Change], check: Checker, folder: Path, stage: Path
) -> tuple[Sequence[Fault], Sequence[Path]]:
    """Return what would be worse with what was edited in it, and what nothing uses before that is merged."""
    put = [change.path for change in changes if change.kind in ("add", "replace")]
    removed = [change.path for change in changes if change.kind == "remove"]
    if not put and not removed:
        return [], []
    tops = {change.path.parts[0] for change in changes if len(change.path.parts) > 1}
    edited = any(change.kind == "beside" for change in changes)
    added = [change.path for change in changes if change.kind == "add" and edited]
    return worsened(check, folder, stage, tops, put=put, removed=removed, added=added)


def _refused(changes: Sequence[Change], found: Sequence[Fault]) -> str:
    """Return why the outcome is refused, and what to do about it; empty where it works."""
    errors = [fault for fault in found if fault.is_error]
    if not errors:
        return ""
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    edited = [change.path.as_posix() for change in changes if change.kind == "beside"]
    told = f"; make it go with your {', '.join(edited)} first" if edited else ""
    return f"with what you have it would not be clean: {errors[0]}{more}{told}"


def _shortened(lines: Sequence[str]) -> Iterator[str]:
    yield from lines[:_LISTED]
    if len(lines) > _LISTED:
        yield f"… and {len(lines) - _LISTED} more"


def _without_needed(going: Sequence[Change], folder: Path, ours: Collection[Path]) -> list[Change]:
    """Return what becomes of files that the template makes no more, now that others may name them."""
    removed = [change.path for change in going if change.kind == "remove"]
    by = needed(removed, folder, {*removed, *ours})
    return [
        replace(change, kind="needed", because=by[change.path]) if change.path in by else change for change in going
    ]


def _is_ours(path: Path, change: Change | None, folder: Path, stage: Path) -> bool:
    """Whether a file is going to be as the template has it."""
    if change is not None:
        return change.kind in ("add", "replace")
    return (folder / path).read_bytes() == (stage / path).read_bytes()


def _remove_empty(folder: Path, above: Path) -> None:
    """Remove a folder that nothing is left in, and those above it that then are empty, but not `above` itself."""
    while folder != above and folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
        folder = folder.parent


def _foreign(template: Template, answers: Mapping[str, str], folder: Path, ours: set[str]) -> set[str]:
    """Return what was there before anything was written, and is none of ours."""
    return {name for name in template.spare(answers) - ours if os.path.lexists(folder / name)}


def _change(path: Path, folder: Path, stage: Path, made: Made, recipe: Path) -> Change | None:
    """Return what becomes of a file that the template makes now; None where nothing does."""
    there, after, was = folder / path, (stage / path).read_bytes(), made.digests.get(path.as_posix())
    if not there.is_file():
        return Change("keep" if was else "add", path, b"", after)
    before = there.read_bytes()
    if before == after:
        return None
    if path == recipe or was == digest(before):
        return Change("replace", path, before, after)
    if was == digest(after):
        return None
    return Change("beside", path, before, after, at=_place_beside(path, folder, {was, digest(after)}))


def _place_beside(path: Path, folder: Path, ours: Collection[str | None]) -> Path:
    """Return where what a file would be is put beside it: over what was put there before, unless that was edited."""
    first = path.with_name(path.name + BESIDE)
    places = chain([first], (first.with_name(f"{first.name}.{number}") for number in count(2)))
    return next(each for each in places if not os.path.lexists(folder / each) or _digest(folder / each) in ours)


def _digest(path: Path) -> str:
    return digest(path.read_bytes()) if path.is_file() else ""


def _left_over(path: Path, folder: Path, made: Made) -> Change | None:
    """Return what becomes of a file that the template makes no more."""
    if not (folder / path).is_file():
        return None
    before = (folder / path).read_bytes()
    return Change("remove" if digest(before) == made.digests[path.as_posix()] else "keep", path, before)
