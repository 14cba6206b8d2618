"""``urdfkit new --update``: show what would change, ask, change it. And what each result has to pass first."""

from __future__ import annotations

import argparse
import difflib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold import (
    BESIDE,
    Change,
    Fault,
    Template,
    Update,
    computed,
    find_recipe,
    named_template,
    read_made,
    read_recipe,
    template_at,
    template_names,
    updating,
)
from urdfkit.scaffold.update.simulator_leftovers import left_behind

_WORDS = {
    "add": "new",
    "replace": "changed",
    "remove": "removed",
    "beside": "edited by you: what it would be is put beside it as {at}",
    "keep": "left as you have it",
    "needed": "kept: {because} names it",
}
_JOINT = re.compile(r"\b\w+_joint\b")
"""What joints are called in the templates."""
_COLOURS = {"+": "32", "-": "31", "@": "36"}


def run(
    template: Template | None,
    given: Mapping[str, str],
    folder: Path,
    arguments: argparse.Namespace,
    *,
    own: str | None = None,
) -> int:
    """Show what would change and, when told to, change it.

    Args:
        template: of what is made again; None for the one that the recipe names.
        given: answers in the place of the recipe's.
        folder: it was written to, or a package in it.
        arguments: from the command line.
        own: the folder of a template of the user's own.

    Returns:
        The exit code: 1 where something would change and nothing was changed.

    Raises:
        UrdfkitError: it could not be done; nothing was changed then.
    """
    recipe, into = find_recipe(template, folder)
    made = read_made(recipe)
    template = placed(template, into) if template else _made_by(made.kind, made.source, own, into)
    before, answers = (template.answers(read_recipe(template, recipe, each)) for each in ({}, given))
    answers |= computed(template.name, answers)
    answers |= {"into": into.as_posix()} | ({"year": made.year} if made.year else {})
    finish = drawn if answers.get("picture") == "yes" else None
    with updating(template, answers, into, made, check=partial(findings, beside=into), finish=finish) as update:
        real = [change for change in update.changes if not change.is_none]
        if not real:
            print(f"{into}: nothing to update", file=sys.stderr)
            _tell(f"{path}{BESIDE} is left to merge" for path in made.digests if (into / f"{path}{BESIDE}").is_file())
            return 0
        _show(update.changes, recipe.relative_to(into), colour=_coloured(arguments.color), quiet=arguments.quiet)
        if _said(arguments, "diff") or (update.refused and not update.beside):
            if update.refused:
                raise ResourceError(f"nothing was changed: {update.refused}")
            _tell(_left(update))
            return 1
        count = len(update.beside if update.refused else real)
        if not _said(arguments, "yes") and not _agreed(count, update.refused):
            return 1
        if update.refused:
            update.offer()
            beside = ", ".join(_beside(change) for change in update.beside)
            raise ResourceError(f"nothing was changed: {update.refused} by {beside} beside it; then the same again")
        update.apply()
        _tell(_left(update))
    if answers.get("sim") != before.get("sim"):
        tops = {Path(path).parts[0] for path in made.digests if len(Path(path).parts) > 1}
        _tell(left_behind(into, tops, answers.get("sim", "")))
    return 0


def _tell(lines: Iterable[str]) -> None:
    for line in lines:
        print(f"urdfkit: {line}", file=sys.stderr)


def _beside(change: Change) -> str:
    return change.at.name if change.at is not None else ""


def _left(update: Update) -> Iterator[str]:
    """Yield what an update leaves to the user, a line each."""
    for change in update.beside:
        unused = "; until then nothing uses what is new" if update.unused and change.path.suffix == ".xacro" else ""
        joints = _new_joints(change) if change.path.suffix in (".yaml", ".yml") else []
        if joints:
            unused = f"; until then no controller of it moves {', '.join(f'`{joint}`' for joint in joints)}"
        yield f"left to merge: {(change.at or change.path).as_posix()} into your {change.path.name}{unused}"
    yield from (f"the linter would say: {line}" for line in update.warned)


def _new_joints(change: Change) -> list[str]:
    """Return the joints that settings of controllers would be for, and those that are there are not."""
    named = (
        [
            word
            for line in text.decode("utf-8", "replace").splitlines()
            for word in _JOINT.findall(line.partition("#")[0])
        ]
        for text in (change.before, change.after)
    )
    before, after = named
    return [joint for joint in dict.fromkeys(after) if joint not in before]


def findings(folder: Path, *, beside: Path | None = None) -> list[Fault]:
    """Return what is wrong with a result.

    Args:
        folder: where it was rendered to.
        beside: where it goes: there may be other packages that it needs.

    Raises:
        UrdfkitError: a file of it cannot be read.
    """
    from urdfkit.description.sdf import load_world
    from urdfkit.lint import lint
    from urdfkit.resources import models_in

    for world in (*folder.glob("*.sdf"), *folder.glob("*.world")):
        load_world(world)
    if not models_in(folder):
        return []
    found = lint([folder], package_path=[folder, *([beside] if beside is not None else [])])
    return [
        Fault(f"{f.code} {f.message} ({Path(f.file).name}:{f.line})", f.severity == "error")
        for f in found
        if f.severity != "note"
    ]


def drawn(folder: Path) -> None:
    """Draw the robot into ``docs`` of its package.

    Args:
        folder: where it was rendered to.

    Raises:
        UrdfkitError: it cannot be loaded, or drawn.
    """
    from urdfkit.description import load
    from urdfkit.resources import models_in
    from urdfkit.scaffold.wrap.readme_picture import drawing_of

    for model in models_in(folder):
        robot = load(model, package_path=[folder])
        picture = drawing_of(robot)
        if picture is None:
            raise ResourceError(f"there is nothing of {robot.name} to draw but meshes: --no-picture")
        docs = model.parents[1] / "docs"
        docs.mkdir(exist_ok=True)
        (docs / f"{robot.name}.png").write_bytes(picture)


def _made_by(kind: str, source: str, own: str | None, into: Path) -> Template:
    """Return the template that a recipe names."""
    if own is not None:
        return placed(template_at(own), into)
    if not source:
        return named_template(kind)
    if not Path(into, source).is_dir():
        there = ", ".join(template_names())
        raise ResourceError(f"the template {source} that {kind} was made by is gone: --template DIR (ours: {there})")
    return replace(template_at(str(into / source)), source=source)


def placed(template: Template, into: Path) -> Template:
    """Return a template of the user's own with its place as seen from the folder that is written to.

    Args:
        template: any.
        into: the folder.
    """
    if not template.source or Path(template.source).is_absolute():
        return template
    return replace(template, source=os.path.relpath(template.folder, into.resolve()))


def _show(changes: tuple[Change, ...], recipe: Path, *, colour: bool, quiet: bool) -> None:
    for change in changes:
        print(f"{change.path.as_posix()}: {_WORDS[change.kind].format(at=_beside(change), because=change.because)}")
        if quiet or change.is_none or change.path == recipe:
            continue
        for line in _difference(change):
            code = _COLOURS.get(line[:1])
            print(f"\x1b[{code}m{line}\x1b[0m" if colour and code else line)


def _difference(change: Change) -> Iterator[str]:
    try:
        before, after = change.before.decode().splitlines(), change.after.decode().splitlines()
    except UnicodeDecodeError:
        yield "  (not text)"
        return
    for line in difflib.unified_diff(before, after, n=2, lineterm=""):
        if not line.startswith(("---", "+++")):
            yield line


def _said(arguments: argparse.Namespace, option: str) -> bool:
    """Return whether an option was given, behind the thing or before it."""
    return bool(getattr(arguments, option, False) or getattr(arguments, f"above_{option}", False))


def _agreed(count: int, refused: str) -> bool:
    files = f"{count} file{'s' if count > 1 else ''}"
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        if refused:
            raise ResourceError(f"nothing was changed: {refused}; --yes puts {files} there to merge from")
        raise UsageError(f"{files} would change and nothing was changed: --yes changes them, --diff only shows it")
    if refused:
        print(f"urdfkit: {refused}", file=sys.stderr)
    asked = f"Put {files} there to merge from?" if refused else f"Change {files}?"
    print(f"{asked} [y/N] ", end="", file=sys.stderr, flush=True)
    return sys.stdin.readline().strip().lower() in ("y", "yes")


def _coloured(choice: str) -> bool:
    return choice == "always" or (choice == "auto" and sys.stdout.isatty() and "NO_COLOR" not in os.environ)
