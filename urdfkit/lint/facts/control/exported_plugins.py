"""Plugins that packages of the workspace export: in C++, or in a plugin description."""

import re
from itertools import islice
from pathlib import Path

from urdfkit.description.packages.related_files import neighbours
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import CPP, MAX_BYTES, code_texts

_SUFFIXES = (*CPP, ".xml")
_MAX_FILES = 400


def is_exported_plugin(model: Model, kind: str) -> bool:
    """Return whether a package next to the robot's package exports a plugin of that type.

    Args:
        model: the linted model.
        kind: lookup name of the plugin: ``package/Class``.
    """
    if model.package is None:
        return False
    package, _, name = kind.partition("/")
    export = re.compile(
        rf"PLUGINLIB_EXPORT_CLASS\s*\(\s*(?:::)?{re.escape(package)}::(?:\w+::)*{re.escape(name)}\b"
        rf"|<class\b[^<>]*(?:name\s*=\s*[\"']{re.escape(kind)}[\"']|{re.escape(package)}::(?:\w+::)*{re.escape(name)}[\"'])"
    )
    near = neighbours(model.package)
    folders = [near[package]] if package in near else list(near.values())
    for folder in folders:
        model.expanded.packages.watch(folder, ".xml")
    return any(export.search(text) for folder in folders for text in _sources(folder))


def is_built_library(model: Model, name: str) -> bool:
    """Return whether a package next to the robot's package builds a library, by its name without ``lib``, ``.so``."""
    if model.package is None:
        return False
    built = re.compile(rf"(?<![\w-]){re.escape(name)}(?![\w-])")
    for package, folder in neighbours(model.package).items():
        file = folder / "CMakeLists.txt"
        model.expanded.packages.watch(folder, file.name)
        if file.is_file() and file.stat().st_size <= MAX_BYTES:
            text = file.read_text("utf-8", "replace").replace("${PROJECT_NAME}", package)
            if built.search(text):
                return True
    return False


def _sources(folder: Path) -> list[str]:
    """Return the texts of the C++ files and plugin descriptions in a folder."""
    return [text for _, text in islice(code_texts(folder, _SUFFIXES, ("package.xml",)), _MAX_FILES)]
