"""Updates in place of packages written from a template, after a change of the template or of the answers.

Files that were not edited are replaced. Edited files are kept, and their new version is written next to them with the
suffix ``.new``, as package managers do with configuration files. Deleted files stay deleted. Files that the template no
longer has are removed unless a remaining file refers to them. An update that would add errors is refused; in that
case only the ``.new`` files are written.
"""

import os
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from itertools import chain, count
from pathlib import Path

from urdfkit.atomic import staging
from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold.templates.recipe_file import Made, digest
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.update.changes import Change, Update
from urdfkit.scaffold.update.file_references import needed
from urdfkit.scaffold.update.rendering import Finisher, finished, render, write_recipe
from urdfkit.scaffold.update.staged_packages import Checker, PackageFault, worsened

NEW_SUFFIX = ".new"
"""Suffix of the new version of an edited file."""

_LISTED = 3
"""Number of faults to print; of further ones, only the count is printed."""


def find_recipe(template: Template | None, folder: Path) -> tuple[Path, Path]:
    """Return the recipe in an output folder, and that folder.

    Args:
        template: the template of the recipe; None: any template.
        folder: the output folder, or a package in it.

    Raises:
        ResourceError: no recipe or several recipes were found.
    """
    pattern = "*/urdfkit-new.toml" if template is None or not template.recipe else _pattern(template.recipe)
    name = pattern.rpartition("/")[2]
    recipes = sorted(folder.glob(pattern))
    if not recipes and (folder / name).is_file():
        recipes = [folder.absolute() / name]
    if not recipes:
        raise ResourceError(f"nothing to update in {folder}: no {pattern}, which `urdfkit new` writes")
    if len(recipes) > 1:
        listed = ", ".join(str(path.parent) for path in recipes)
        raise ResourceError(f"found several recipes in {folder}; choose one with --into: {listed}")
    return recipes[0], recipes[0].parents[pattern.count("/")]


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
    """Provide the changes that make `folder` match the template and the answers.

    Args:
        template: the template.
        answers: answers by question, including the built-in placeholders.
        folder: the output folder.
        made: the record of the files written before.
        check: returns the faults of the rendered files; there must be none.
        finish: adds computed files.

    Raises:
        ResourceError: `check` finds a fault, or a file cannot be written.
        UsageError: the answers give packages of other names.
    """
    packages = {Path(name).parts[0] for name in made.digests}
    tops = {target.parts[0] for _, target in template.files(answers)} - template.spare(answers)
    if packages and not packages & tops:
        names = ", ".join(sorted(tops))
        raise UsageError(
            f"--update cannot rename packages, and these options give {names}: use --from and another --into instead"
        )
    with staging(folder) as staged:
        render(template, answers, staged, without=_existing(template, answers, folder, packages))
        files = finished(template, answers, staged, check=check, finish=finish)
        recipe = files[-1]
        gone = sorted(set(map(Path, made.digests)) - set(files))
        going = [change for path in gone if (change := _left_over(path, folder, made)) is not None]
        coming = [(path, _change(path, folder, staged, made, recipe)) for path in files if path != recipe]
        going = _without_needed(
            going, folder, [path for path, change in coming if _will_match_template(path, change, folder, staged)]
        )
        needed_yet = {change.path: change.before for change in going if change.kind == "needed"}
        write_recipe(template, answers, staged, files, also=needed_yet)
        # The recipe last: until then, the next update finds the unfinished work of a killed one.
        recipe_change = _change(recipe, folder, staged, made, recipe)
        every = (*(change for _, change in coming), *going, recipe_change)
        changes = tuple(change for change in every if change is not None)
        faults, unused = ([], []) if check is None else _worsened(changes, check, folder, staged)
        warned = tuple(_shortened([str(fault) for fault in faults]))
        yield Update(changes, _refusal(changes, faults), warned, tuple(unused), staged, folder)


def _worsened(
    changes: Sequence[Change], check: Checker, folder: Path, staged: Path
) -> tuple[Sequence[PackageFault], Sequence[Path]]:
    """Return the faults that the update would add, and new model files that no file refers to."""
    put = [change.path for change in changes if change.kind in ("add", "replace")]
    removed = [change.path for change in changes if change.kind == "remove"]
    if not put and not removed:
        return [], []
    tops = {change.path.parts[0] for change in changes if len(change.path.parts) > 1}
    edited = any(change.kind == "new_version" for change in changes)
    added = [change.path for change in changes if change.kind == "add" and edited]
    return worsened(check, folder, staged, tops, put=put, removed=removed, added=added)


def _refusal(changes: Sequence[Change], faults: Sequence[PackageFault]) -> str:
    """Return why the update is refused and how to proceed; empty if it can be applied."""
    errors = [fault for fault in faults if fault.is_error]
    if not errors:
        return ""
    more = f" (and {len(errors) - 1} more)" if len(errors) > 1 else ""
    edited = [change.path.as_posix() for change in changes if change.kind == "new_version"]
    advice = f"; adapt your {', '.join(edited)} first" if edited else ""
    return f"the update would add errors: {errors[0]}{more}{advice}"


def _shortened(lines: Sequence[str]) -> Iterator[str]:
    yield from lines[:_LISTED]
    if len(lines) > _LISTED:
        yield f"… and {len(lines) - _LISTED} more"


def _without_needed(going: Sequence[Change], folder: Path, generated: Collection[Path]) -> list[Change]:
    """Return the changes with ``needed`` instead of ``remove`` for files that remaining files refer to."""
    removed = [change.path for change in going if change.kind == "remove"]
    by = needed(removed, folder, {*removed, *generated})
    return [
        replace(change, kind="needed", because=by[change.path]) if change.path in by else change for change in going
    ]


def _will_match_template(path: Path, change: Change | None, folder: Path, staged: Path) -> bool:
    """Return whether a file will match the template."""
    if change is not None:
        return change.kind in ("add", "replace")
    return (folder / path).read_bytes() == (staged / path).read_bytes()


def _existing(template: Template, answers: Mapping[str, str], folder: Path, generated: set[str]) -> set[str]:
    """Return the names at the top of the output that existed before the template was written."""
    return {name for name in template.spare(answers) - generated if os.path.lexists(folder / name)}


def _change(path: Path, folder: Path, staged: Path, made: Made, recipe: Path) -> Change | None:
    """Return the change of a file of the template; None if it is unchanged."""
    target, after, was = folder / path, (staged / path).read_bytes(), made.digests.get(path.as_posix())
    if not target.is_file():
        return Change("keep" if was else "add", path, b"", after)
    before = target.read_bytes()
    if before == after:
        return None
    if path == recipe or was == digest(before):
        return Change("replace", path, before, after)
    if was == digest(after):
        return None
    return Change("new_version", path, before, after, at=_new_version_path(path, folder, {was, digest(after)}))


def _new_version_path(path: Path, folder: Path, digests: Collection[str | None]) -> Path:
    """Return the path for the new version of a file; an older new version is replaced unless it was edited."""
    first = path.with_name(path.name + NEW_SUFFIX)
    places = chain([first], (first.with_name(f"{first.name}.{number}") for number in count(2)))
    return next(each for each in places if not os.path.lexists(folder / each) or _digest(folder / each) in digests)


def _digest(path: Path) -> str:
    return digest(path.read_bytes()) if path.is_file() else ""


def _left_over(path: Path, folder: Path, made: Made) -> Change | None:
    """Return the change of a file that the template no longer has."""
    if not (folder / path).is_file():
        return None
    before = (folder / path).read_bytes()
    return Change("remove" if digest(before) == made.digests[path.as_posix()] else "keep", path, before)
