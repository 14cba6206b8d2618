"""Where templates come from: ours, those of installed packages, and a folder of the user's own."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

from urdfkit.errors import ResourceError, did_you_mean
from urdfkit.registry import EntryPoint, entry_points
from urdfkit.resources import templates_dir
from urdfkit.scaffold.templates.template_parser import NAME, load_template
from urdfkit.scaffold.templates.template import Template

GROUP = "urdfkit.templates"
"""Entry points: each a folder with a template, as a path or as a module that lies in it."""


def template_names() -> list[str]:
    """Return the names of the templates we ship and of those of installed packages, sorted.

    Raises:
        ResourceError: the installation is incomplete.
    """
    return sorted({*(path.parent.name for path in templates_dir().glob(f"*/{NAME}")), *_foreign()})


def named_template(name: str) -> Template:
    """Return the template of that name, ours before those of installed packages.

    Args:
        name: which.

    Raises:
        ResourceError: there is none, or it is wrong.
    """
    ours = templates_dir() / name
    if (ours / NAME).is_file():
        return load_template(ours)
    if (entry := _foreign().get(name)) is None:
        raise ResourceError(f"no template `{name}`{did_you_mean(name, template_names())}")
    return load_template(_folder(entry), called=name)


def template_at(place: str) -> Template:
    """Return the template in a folder.

    Args:
        place: the folder, or its ``template.toml``, as typed.

    Raises:
        ResourceError: there is none, or it is wrong.
    """
    folder = Path(place).expanduser()
    if folder.name == NAME:
        folder = folder.parent
    if not (folder / NAME).is_file():
        what = f"no {NAME} in it" if folder.is_dir() else "no such folder"
        near = [path.parent.name for path in folder.absolute().parent.glob(f"*/{NAME}")]
        raise ResourceError(f"--template {place}: {what}{did_you_mean(folder.name, near)}")
    return load_template(folder.resolve(), source=str(folder))


def _foreign() -> dict[str, EntryPoint]:
    return {entry.name: entry for entry in entry_points(GROUP)}


def _folder(entry: EntryPoint) -> Path:
    found = entry.load()
    if isinstance(found, ModuleType):
        found = Path(found.__file__).parent if found.__file__ else next(iter(found.__path__))
    if not isinstance(found, str | Path) or not (Path(found) / NAME).is_file():
        raise ResourceError(f"{entry.distribution}: entry point {entry.name} = {entry.value}: no folder with a {NAME}")
    return Path(found)
