"""Inputs that a description expects from its user: values of arguments, packages on the machine."""

import re
from pathlib import Path

from urdfkit.description.packages.existence import is_folder
from urdfkit.description.packages.related_files import LAUNCH, dependencies_in, package_of
from urdfkit.lint.model.model import Model

_DECLARED = r"<xacro:arg\b[^<>]*\bname\s*=\s*[\"']{}[\"'][^<>]*>"


def is_required_argument(model: Model, name: str) -> bool:
    """Return whether users pass the argument: it is declared without default, or launch files mention it.

    False if launch files run xacro on the description and none of them mentions the argument.

    Args:
        model: the linted model.
        name: an argument without value.
    """
    launch_files = [source.text for source in model.related_files.values() if source.file.endswith(LAUNCH)]
    launch_files = [text for text in launch_files if "xacro" in text and model.expanded.path.name in text]
    if any(re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) for text in launch_files):
        return True
    declaration = _DECLARED.format(re.escape(name))
    sources = model.expanded.sources.values()
    return not launch_files and any(re.search(declaration, source.text) for source in sources)


def argument_in_path(model: Model, path: str) -> str:
    """Return the argument whose default is the first missing folder or file of a path, or an empty text.

    Such a default (``ur_type`` of ``ur5x``) selects nothing: users pass the argument.

    Args:
        model: the linted model.
        path: absolute path of a missing file.
    """
    missing = Path(path)
    if not missing.is_absolute():
        return ""
    while not is_folder(missing.parent) and missing.parent != missing:
        missing = missing.parent
    for source in model.expanded.sources.values():
        for declaration in re.findall(_DECLARED.format(r"\w+"), source.text):
            default = re.search(r"\bdefault\s*=\s*[\"']([^\"']*)[\"']", declaration)
            if default is not None and default[1] in (missing.name, missing.stem):
                return re.search(r"\bname\s*=\s*[\"'](\w+)", declaration)[1]  # type: ignore[index]
    return ""


def is_declared_dependency(model: Model, package: str) -> bool:
    """Return whether the package.xml of the robot, or of a package it includes files from, depends on a package."""
    files = [Path(source.file) for source in model.expanded.sources.values()]
    folders = {folder for file in (model.expanded.path, *files) if (folder := package_of(file)) is not None}
    return any(package in dependencies_in(model.manifest(folder)) for folder in folders)
