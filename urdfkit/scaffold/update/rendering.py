"""Render a template into a folder: all of it or nothing, and nothing is overwritten."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from urdfkit.atomic import move_into_place, staging
from urdfkit.errors import ResourceError
from urdfkit.scaffold.templates.placeholders import fill, inside
from urdfkit.scaffold.templates.recipe import digest, recipe_text
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.update.staged_packages import Checker

_WORLDS = (".sdf", ".world")
"""What the names of files end in that a folder to write to is mistaken for."""

Finisher = Callable[[Path], None]
"""Adds to the rendered folder what no template holds, such as a picture of the robot."""

_OF_A_FRESH_CLONE = {".git", ".gitattributes", ".gitignore", "LICENSE", "README.md"}


def is_fresh(folder: Path) -> bool:
    """Return whether a folder is not there yet, is empty, or holds no more than a repository just cloned does.

    Args:
        folder: what is going to be written to.
    """
    if not folder.is_dir():
        return not os.path.lexists(folder)
    there = {path.name for path in folder.iterdir() if not path.name.startswith(".urdfkit-")}
    return not there or (".git" in there and there <= _OF_A_FRESH_CLONE)


def create(
    template: Template,
    answers: Mapping[str, str],
    folder: Path,
    *,
    check: Checker | None = None,
    finish: Finisher | None = None,
) -> list[Path]:
    """Write what a template makes into `folder`.

    It is rendered into a temporary folder there, checked, and moved into place. Whatever goes wrong, an interrupt
    included, leaves `folder` as it was.

    Args:
        template: what to write.
        answers: answers by question, with the built-in ones.
        folder: made if it is not there.
        check: has to find nothing.
        finish: adds what no template holds.

    Returns:
        The files, absolute, sorted.

    Raises:
        ResourceError: something of that name is there, the result does not pass `check`, or it cannot be written.
    """
    if folder.suffix in _WORLDS and not folder.is_dir():
        raise ResourceError(f"{folder} would be a folder, and has the name of a world's file; try {folder.parent}")
    spare = template.spare(answers)
    for name in sorted({target.parts[0] for _, target in template.files(answers)} - spare):
        if os.path.lexists(folder / name):
            raise ResourceError(f"{folder / name} is already there; nothing is overwritten")
    with made(folder), staging(folder) as stage:
        render(template, answers, stage, without={name for name in spare if os.path.lexists(folder / name)})
        files = finished(template, answers, stage, check=check, finish=finish)
        move_into_place(stage, folder)
    return sorted((folder / target).resolve() for target in files)


def render(template: Template, answers: Mapping[str, str], stage: Path, *, without: Collection[str] = ()) -> None:
    """Write what a template makes into a temporary folder.

    Args:
        template: what to write.
        answers: answers by question, with the built-in ones.
        stage: has to exist.
        without: topmost names that are left out.

    Raises:
        ResourceError: the template is wrong, or it cannot be written.
    """
    template.render(answers, stage)
    for name in without:
        if (stage / name).is_dir():
            shutil.rmtree(stage / name)
        else:
            (stage / name).unlink()


def finished(
    template: Template,
    answers: Mapping[str, str],
    stage: Path,
    *,
    check: Checker | None = None,
    finish: Finisher | None = None,
) -> list[Path]:
    """Check what was rendered, add what no template holds, and write down the answers and what was made from them.

    Args:
        template: what was rendered.
        answers: answers by question, with the built-in ones.
        stage: where it was rendered to.
        check: has to find nothing.
        finish: adds what no template holds.

    Returns:
        All files, relative to `stage`.

    Raises:
        ResourceError: the result does not pass `check`, or it cannot be written.
    """
    if check is not None and (found := check(stage)):
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        raise ResourceError(f"nothing was written: the result would not be clean: {found[0]}{more}")
    if finish is not None:
        finish(stage)
    files = sorted(path.relative_to(stage) for path in stage.rglob("*") if path.is_file())
    if not template.recipe:
        return files
    return [*files, write_recipe(template, answers, stage, files)]


def write_recipe(
    template: Template,
    answers: Mapping[str, str],
    stage: Path,
    files: Sequence[Path],
    *,
    also: Mapping[Path, bytes] | None = None,
) -> Path:
    """Write down the answers and what was made from them; return where, relative to `stage`.

    Args:
        template: what was rendered.
        answers: answers by question, with the built-in ones.
        stage: where it was rendered to.
        files: that were, relative to it; the recipe may be among them.
        also: what was made before and is there yet.

    Raises:
        ResourceError: the template is wrong.
    """
    where = f"{template.folder}/template.toml"
    target = inside(fill(template.recipe, answers, where=where), where=where)
    contents = {path: (stage / path).read_bytes() for path in files if path != target} | dict(also or {})
    digests = {path.as_posix(): digest(content) for path, content in sorted(contents.items())}
    (stage / target).parent.mkdir(parents=True, exist_ok=True)
    (stage / target).write_text(recipe_text(template, answers, digests), encoding="utf-8")
    return target


@contextmanager
def made(folder: Path) -> Iterator[None]:
    """Make `folder` and the ones above it; take those made away again if the body fails.

    Args:
        folder: may be there.

    Raises:
        ResourceError: it cannot be made.
    """
    missing = [path for path in (folder, *folder.parents) if not path.exists()]
    try:
        folder.mkdir(parents=True, exist_ok=True)
        yield
    except BaseException as error:
        for path in missing:
            if path.is_dir() and not any(path.iterdir()):
                path.rmdir()
        if isinstance(error, FileExistsError | NotADirectoryError):
            raise ResourceError(f"cannot write into {folder}: it is no folder") from error
        if isinstance(error, OSError):
            raise ResourceError(f"cannot write into {folder}: {error.strerror}") from error
        raise
