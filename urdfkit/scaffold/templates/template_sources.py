"""Sources of templates: bundled ones, those of installed packages, and folders of the user."""

from pathlib import Path
from types import ModuleType

from urdfkit.errors import ResourceError, did_you_mean
from urdfkit.missing_files import expanded_path, missing_path
from urdfkit.entry_points import EntryPoint, entry_points
from urdfkit.resources import templates_dir
from urdfkit.scaffold.templates.template_parser import NAME, load_template
from urdfkit.scaffold.templates.template import Template

GROUP = "urdfkit.templates"
"""Group of entry points; each refers to the folder of a template, as a path or as a package in that folder."""


def template_names() -> list[str]:
    """Return the names of the bundled templates and of those in installed packages, sorted.

    Raises:
        ResourceError: the installation is incomplete.
    """
    return sorted({*(path.parent.name for path in templates_dir().glob(f"*/{NAME}")), *_from_packages()})


def named_template(name: str) -> Template:
    """Return the template with that name; bundled templates come before those of installed packages.

    Args:
        name: name of the template.

    Raises:
        ResourceError: the template is missing or invalid.
    """
    bundled = templates_dir() / name
    if (bundled / NAME).is_file():
        return load_template(bundled)
    if (entry := _from_packages().get(name)) is None:
        raise ResourceError(f"no template `{name}`{did_you_mean(name, template_names())}")
    return load_template(_folder(entry), name=name)


def template_at(place: str) -> Template:
    """Return the template in a folder.

    Args:
        place: the folder or its ``template.toml``, as typed.

    Raises:
        ResourceError: the template is missing or invalid.
    """
    folder = expanded_path(place)
    if folder.name == NAME:
        folder = folder.parent
    if not (folder / NAME).is_file():
        if not folder.is_dir():
            raise ResourceError(f"--template: {missing_path(place, 'folder')}")
        near = [path.parent.name for path in folder.absolute().parent.glob(f"*/{NAME}")]
        raise ResourceError(f"--template {place}: it contains no {NAME}{did_you_mean(folder.name, near)}")
    return load_template(folder.resolve(), source=str(folder))


def _from_packages() -> dict[str, EntryPoint]:
    return {entry.name: entry for entry in entry_points(GROUP)}


def _folder(entry: EntryPoint) -> Path:
    folder = entry.load()
    if isinstance(folder, ModuleType):
        folder = Path(folder.__file__).parent if folder.__file__ else next(iter(folder.__path__))
    if not isinstance(folder, str | Path) or not (Path(folder) / NAME).is_file():
        raise ResourceError(
            f"{entry.distribution}: entry point {entry.name} = {entry.value}: not a folder with a {NAME}"
        )
    return Path(folder)
