"""Make again in place what a template has made: after a change of the template, or of the answers.

What nobody has edited since is replaced. What somebody has is left alone, and what it would be now is put beside it
with ``.new`` behind its name, as package managers do with settings. What was deleted stays away.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from urdfkit.atomic import staging, undisturbed
from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold.new import Checker, Finisher, finished, render
from urdfkit.scaffold.recipe import Made, digest
from urdfkit.scaffold.template import Template

BESIDE = ".new"
"""Behind the name of what a file that was edited would be now."""

Kind = Literal["add", "replace", "remove", "beside", "keep"]


@dataclass(frozen=True, slots=True)
class Change:
    """What becomes of one file.

    Attributes:
        kind: it is new; it takes the place of one that was not edited; it is no more; it is put beside one that was
            edited; or it was edited or deleted and is left so.
        path: from the folder that is written to; of `beside` without the ending.
        before: what is there; empty where nothing is.
        after: what it would be; empty where nothing would.
    """

    kind: Kind
    path: Path
    before: bytes = b""
    after: bytes = b""


@dataclass(frozen=True, slots=True)
class Update:
    """Changes that are ready to be made.

    Attributes:
        changes: by path.
    """

    changes: tuple[Change, ...]
    _stage: Path
    _folder: Path

    def apply(self) -> None:
        """Make the changes; if one fails all are undone.

        Raises:
            ResourceError: it cannot be written.
        """
        undo: list[tuple[Path, Path]] = []
        old = self._stage / ".old"
        try:
            with undisturbed():
                for number, change in enumerate(self.changes):
                    target = self._folder / change.path
                    if change.kind == "beside":
                        target = target.with_name(target.name + BESIDE)
                    if change.kind == "keep":
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
        found = [_change(path, folder, stage, made, recipe) for path in files]
        gone = sorted(set(map(Path, made.digests)) - set(files))
        found += [_left_over(path, folder, made) for path in gone]
        yield Update(tuple(change for change in found if change is not None), stage, folder)


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
    return None if was == digest(after) else Change("beside", path, before, after)


def _left_over(path: Path, folder: Path, made: Made) -> Change | None:
    """Return what becomes of a file that the template makes no more."""
    if not (folder / path).is_file():
        return None
    before = (folder / path).read_bytes()
    return Change("remove" if digest(before) == made.digests[path.as_posix()] else "keep", path, before)
