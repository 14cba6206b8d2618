"""Rendering a template into a folder, completely or not at all, without overwriting files."""

import os
import shutil
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from urdfkit.atomic import clean_up, move_into_place, staging
from urdfkit.errors import ResourceError
from urdfkit.scaffold.templates.placeholders import fill, path_inside
from urdfkit.scaffold.templates.recipe_file import digest, recipe_text
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.update.staged_packages import Checker

_WORLDS = (".sdf", ".world")
"""Suffixes of world files; a folder with such a name is probably a mistake."""

Finisher = Callable[[Path], None]
"""Adds files to the rendered folder that are computed, such as a picture of the robot."""

_FRESH_CLONE = {".git", ".gitattributes", ".gitignore", "LICENSE", "README.md"}


def is_fresh(folder: Path) -> bool:
    """Return whether a folder does not exist, is empty, or contains only the files of a newly cloned repository.

    Args:
        folder: the output folder.
    """
    if not folder.is_dir():
        return not os.path.lexists(folder)
    existing = {path.name for path in folder.iterdir() if not path.name.startswith(".urdfkit-")}
    return not existing or (".git" in existing and existing <= _FRESH_CLONE)


def create(
    template: Template,
    answers: Mapping[str, str],
    folder: Path,
    *,
    check: Checker | None = None,
    finish: Finisher | None = None,
) -> list[Path]:
    """Write the files of a template into `folder`.

    The template is rendered into a temporary folder, checked, and moved into place. If anything fails, including an
    interrupt, `folder` is unchanged.

    Args:
        template: the template.
        answers: answers by question, including the built-in placeholders.
        folder: the output folder; created if it does not exist.
        check: returns the faults of the rendered files; there must be none.
        finish: adds computed files.

    Returns:
        The absolute paths of the files, sorted.

    Raises:
        ResourceError: a file of the same name exists, `check` finds a fault, or a file cannot be written.
    """
    if folder.suffix in _WORLDS and not folder.is_dir():
        raise ResourceError(f"{folder} has the name of a world file, but would be a folder; try {folder.parent}")
    clean_up(folder)
    spare = template.spare(answers)
    for name in sorted({target.parts[0] for _, target in template.files(answers)} - spare):
        if os.path.lexists(folder / name):
            raise ResourceError(f"{folder / name} already exists; nothing was overwritten")
    with created(folder), staging(folder) as staged:
        render(template, answers, staged, without={name for name in spare if os.path.lexists(folder / name)})
        files = finished(template, answers, staged, check=check, finish=finish)
        move_into_place(staged, folder)
    return sorted((folder / target).resolve() for target in files)


def render(template: Template, answers: Mapping[str, str], staged: Path, *, without: Collection[str] = ()) -> None:
    """Write the files of a template into a temporary folder.

    Args:
        template: the template.
        answers: answers by question, including the built-in placeholders.
        staged: an existing folder.
        without: names of files and folders at the top to leave out.

    Raises:
        ResourceError: the template is invalid, or a file cannot be written.
    """
    template.render(answers, staged)
    for name in without:
        if (staged / name).is_dir():
            shutil.rmtree(staged / name)
        else:
            (staged / name).unlink()


def finished(
    template: Template,
    answers: Mapping[str, str],
    staged: Path,
    *,
    check: Checker | None = None,
    finish: Finisher | None = None,
) -> list[Path]:
    """Check the rendered files, add computed files, and write the recipe.

    Args:
        template: the template.
        answers: answers by question, including the built-in placeholders.
        staged: the folder with the rendered files.
        check: returns the faults of the rendered files; there must be none.
        finish: adds computed files.

    Returns:
        The paths of all files, relative to `staged`.

    Raises:
        ResourceError: `check` finds a fault, or a file cannot be written.
    """
    if check is not None and (faults := check(staged)):
        more = f" (and {len(faults) - 1} more)" if len(faults) > 1 else ""
        raise ResourceError(f"nothing was written because the result has errors: {faults[0]}{more}")
    if finish is not None:
        finish(staged)
    files = sorted(path.relative_to(staged) for path in staged.rglob("*") if path.is_file())
    if not template.recipe:
        return files
    return [*files, write_recipe(template, answers, staged, files)]


def write_recipe(
    template: Template,
    answers: Mapping[str, str],
    staged: Path,
    files: Sequence[Path],
    *,
    also: Mapping[Path, bytes] | None = None,
) -> Path:
    """Write the recipe: the answers, and digests of the files; return its path relative to `staged`.

    Args:
        template: the template.
        answers: answers by question, including the built-in placeholders.
        staged: the folder with the rendered files.
        files: paths of the rendered files, relative to `staged`; may include the recipe.
        also: contents of files from an earlier version that are kept.

    Raises:
        ResourceError: the template is invalid.
    """
    where = f"{template.folder}/template.toml"
    target = path_inside(fill(template.recipe, answers, where=where), where=where)
    contents = {path: (staged / path).read_bytes() for path in files if path != target} | dict(also or {})
    digests = {path.as_posix(): digest(content) for path, content in sorted(contents.items())}
    (staged / target).parent.mkdir(parents=True, exist_ok=True)
    (staged / target).write_text(recipe_text(template, answers, digests), encoding="utf-8")
    return target


@contextmanager
def created(folder: Path) -> Iterator[None]:
    """Create `folder` and its parents; remove the created folders if the body fails.

    Args:
        folder: a folder that may exist.

    Raises:
        ResourceError: the folder cannot be created.
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
            raise ResourceError(f"cannot write into {folder}: not a folder") from error
        if isinstance(error, OSError):
            raise ResourceError(f"cannot write into {folder}: {error.strerror}") from error
        raise
