"""``urdfkit new --update``: show the changes, confirm, apply them. Also the checks of every created package."""

import argparse
import difflib
import os
import re
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from pathlib import Path

from urdfkit.cli.colors import colored_diff
from urdfkit.errors import ResourceError, UsageError
from urdfkit.scaffold import (
    NEW_SUFFIX,
    Change,
    PackageFault,
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
from urdfkit.scaffold.templates.recipe_file import Made
from urdfkit.scaffold.update.simulator_leftovers import left_behind

_WORDS = {
    "add": "new",
    "replace": "changed",
    "remove": "removed",
    "new_version": "edited by you: the new version is saved as {at}",
    "keep": "kept as you edited it",
    "needed": "kept: {because} refers to it",
}
_JOINT = re.compile(r"\b\w+_joint\b")
"""Names of joints in the templates."""


def run(
    template: Template | None,
    preset: Mapping[str, str],
    folder: Path,
    arguments: argparse.Namespace,
    *,
    own_template: str | None = None,
) -> int:
    """Print the changes and, if confirmed, apply them.

    Args:
        template: the template of the packages; None for the template that the recipe names.
        preset: answers that override those of the recipe.
        folder: the folder that was written to, or a package in it.
        arguments: from the command line.
        own_template: folder of the user's own template.

    Returns:
        The exit code: 1 where changes are pending and none was made.

    Raises:
        UrdfkitError: the update failed; nothing was changed.
    """
    recipe, into = find_recipe(template, folder)
    made = read_made(recipe)
    template = with_relative_source(template, into) if template else _recipe_template(made, own_template, into)
    before, answers = (template.answers(read_recipe(template, recipe, each)) for each in ({}, preset))
    answers |= computed(template.name, answers)
    answers |= {"into": into.as_posix()} | ({"year": made.year} if made.year else {})
    finish = add_picture if answers.get("picture") == "yes" else None
    with updating(template, answers, into, made, check=partial(findings, package_path=into), finish=finish) as update:
        pending = [change for change in update.changes if not change.is_empty]
        if not pending:
            print(f"{into}: nothing to update", file=sys.stderr)
            _print_notes(
                f"{path}{NEW_SUFFIX} remains to be merged"
                for path in made.digests
                if (into / f"{path}{NEW_SUFFIX}").is_file()
            )
            return 0
        _show(update.changes, recipe.relative_to(into), color=arguments.color, quiet=arguments.quiet)
        if _has_option(arguments, "diff") or (update.refused and not update.new_versions):
            if update.refused:
                raise ResourceError(f"nothing was changed: {update.refused}")
            _print_notes(_remaining_steps(update))
            return 1
        count = len(update.new_versions if update.refused else pending)
        if not _has_option(arguments, "yes") and not _is_confirmed(count, update.refused):
            return 1
        if update.refused:
            update.apply_new_versions()
            saved = ", ".join(_saved_as(change) for change in update.new_versions)
            raise ResourceError(
                f"nothing was changed: {update.refused} (new version: {saved}); then run the same command again"
            )
        update.apply()
        _print_notes(_remaining_steps(update))
    if answers.get("sim") != before.get("sim"):
        tops = {Path(path).parts[0] for path in made.digests if len(Path(path).parts) > 1}
        _print_notes(left_behind(into, tops, answers.get("sim", "")))
    return 0


def _print_notes(lines: Iterable[str]) -> None:
    for line in lines:
        print(f"urdfkit: {line}", file=sys.stderr)


def _saved_as(change: Change) -> str:
    return change.at.name if change.at is not None else ""


def _remaining_steps(update: Update) -> Iterator[str]:
    """Yield the steps that an update leaves to the user, one per line."""
    for change in update.new_versions:
        unused = (
            "; until then its new elements have no effect" if update.unused and change.path.suffix == ".xacro" else ""
        )
        joints = _new_joints(change) if change.path.suffix in (".yaml", ".yml") else []
        if joints:
            unused = f"; until then its controllers do not move {', '.join(f'`{joint}`' for joint in joints)}"
        yield f"to do: merge {(change.at or change.path).as_posix()} into your {change.path.name}{unused}"
    yield from (f"the linter will report: {line}" for line in update.warned)


def _new_joints(change: Change) -> list[str]:
    """Return the joints that the new controller parameters name and the present ones do not."""
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


def findings(folder: Path, *, package_path: Path | None = None) -> list[PackageFault]:
    """Return the findings of the linter in the created packages.

    Args:
        folder: the folder that the packages were rendered to.
        package_path: destination, whose other packages may be dependencies.

    Raises:
        UrdfkitError: a file of the packages cannot be read.
    """
    from urdfkit.description.sdf import load_world
    from urdfkit.lint import lint
    from urdfkit.robot_files import models_in

    for world in (*folder.glob("*.sdf"), *folder.glob("*.world")):
        load_world(world)
    if not models_in(folder):
        return []
    found = lint([folder], package_path=[folder, *([package_path] if package_path is not None else [])])
    return [
        PackageFault(f"{f.code} {f.message}", f.severity == "error", Path(f.file).name, f.line)
        for f in found
        if f.severity != "note"
    ]


def add_picture(folder: Path) -> None:
    """Draw the robot into the folder ``docs`` of its package.

    Args:
        folder: the folder that the package was rendered to.

    Raises:
        UrdfkitError: the robot cannot be loaded or drawn.
    """
    from urdfkit.description import load
    from urdfkit.robot_files import models_in
    from urdfkit.scaffold.wrap.readme_picture import drawing_of

    for model in models_in(folder):
        robot = load(model, package_path=[folder])
        picture = drawing_of(robot)
        if picture is None:
            raise ResourceError(f"cannot draw {robot.name}: it has only meshes; use --no-picture")
        docs = model.parents[1] / "docs"
        docs.mkdir(exist_ok=True)
        (docs / f"{robot.name}.svg").write_text(picture, encoding="utf-8")


def _recipe_template(made: Made, own_template: str | None, into: Path) -> Template:
    """Return the template that a recipe names."""
    if own_template is not None:
        return with_relative_source(template_at(own_template), into)
    if not made.source:
        return named_template(made.kind)
    if not Path(into, made.source).is_dir():
        bundled = ", ".join(template_names())
        raise ResourceError(
            f"the template {made.source} of this {made.kind} does not exist: use --template DIR (bundled: {bundled})"
        )
    return replace(template_at(str(into / made.source)), source=made.source)


def with_relative_source(template: Template, into: Path) -> Template:
    """Return a template; the user's own with its path relative to the folder that is written to.

    Args:
        template: any template.
        into: the folder that is written to.
    """
    if not template.source or Path(template.source).is_absolute():
        return template
    return replace(template, source=os.path.relpath(template.folder, into.resolve()))


def _show(changes: tuple[Change, ...], recipe: Path, *, color: str, quiet: bool) -> None:
    for change in changes:
        print(f"{change.path.as_posix()}: {_WORDS[change.kind].format(at=_saved_as(change), because=change.because)}")
        if quiet or change.is_empty or change.path == recipe:
            continue
        for line in _difference(change):
            print(colored_diff(line, color))


def _difference(change: Change) -> Iterator[str]:
    try:
        before, after = change.before.decode().splitlines(), change.after.decode().splitlines()
    except UnicodeDecodeError:
        yield "  (not text)"
        return
    for line in difflib.unified_diff(before, after, n=2, lineterm=""):
        if not line.startswith(("---", "+++")):
            yield line


def _has_option(arguments: argparse.Namespace, option: str) -> bool:
    """Return whether an option is set, before or after the KIND."""
    return bool(getattr(arguments, option, False) or getattr(arguments, f"above_{option}", False))


def _is_confirmed(count: int, refused: str) -> bool:
    files = f"{count} file{'s' if count > 1 else ''}"
    if not (sys.stdin.isatty() and sys.stderr.isatty()):
        if refused:
            raise ResourceError(
                f"nothing was changed: {refused}; --yes saves the new version of {files} for a manual merge"
            )
        raise UsageError(
            f"{files} would change; nothing was changed: use --yes to change them, --diff to print the changes"
        )
    if refused:
        print(f"urdfkit: {refused}", file=sys.stderr)
    question = f"Save {files} to merge from?" if refused else f"Change {files}?"
    print(f"{question} [y/N] ", end="", file=sys.stderr, flush=True)
    return sys.stdin.readline().strip().lower() in ("y", "yes")
