"""Render a template into a folder: all of it or nothing, and nothing is overwritten."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from urdfkit.atomic import move_into_place, staging
from urdfkit.errors import ResourceError
from urdfkit.scaffold.filling import fill
from urdfkit.scaffold.recipe import recipe_text
from urdfkit.scaffold.template import Template

Checker = Callable[[Path], Sequence[str]]
"""Looks at the rendered folder before it is moved into place; returns what is wrong with it, a line each."""


def create(template: Template, answers: Mapping[str, str], folder: Path, *, check: Checker | None = None) -> list[Path]:
    """Write what a template makes into `folder`.

    It is rendered into a temporary folder there, checked, and moved into place. Whatever goes wrong, an interrupt
    included, leaves `folder` as it was.

    Args:
        template: what to write.
        answers: answers by question, with the built-in ones.
        folder: made if it is not there.
        check: has to find nothing.

    Returns:
        The files, absolute, sorted.

    Raises:
        ResourceError: something of that name is there, the result does not pass `check`, or it cannot be written.
    """
    for name in sorted({target.parts[0] for _, target in template.files(answers)}):
        if os.path.lexists(folder / name):
            raise ResourceError(f"{folder / name} is already there; nothing is overwritten")
    with made(folder), staging(folder) as stage:
        targets = template.render(answers, stage) + _recipe(template, answers, stage)
        if check is not None and (found := check(stage)):
            more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
            raise ResourceError(f"nothing was written: the result would not be clean: {found[0]}{more}")
        move_into_place(stage, folder)
    return sorted((folder / target).resolve() for target in targets)


def _recipe(template: Template, answers: Mapping[str, str], stage: Path) -> list[Path]:
    """Write the answers down where the template wants them; return the file's path in the result."""
    if not template.recipe:
        return []
    target = Path(fill(template.recipe, answers, where=f"{template.folder}/template.toml"))
    (stage / target).write_text(recipe_text(template, answers), encoding="utf-8")
    return [target]


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
