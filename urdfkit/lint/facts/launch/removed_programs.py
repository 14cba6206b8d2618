"""Commands in launch files that the last release of ROS 1 no longer has.

Source: the migration guide of Noetic ("Use xacro instead of xacro.py").
"""

import re
from collections.abc import Iterator

from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.launch_package_paths import uncommented
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import code_texts

_FORMER = r"\$\(find\s+xacro\)/(xacro\.py)\b|\brosrun\s+xacro\s+(xacro\.py)\b"
_OF_NOETIC = r"VERSION\s+3\.0\.2\b|<\w*depend>\s*python3-|\b[Nn]oetic\b"
"""Matches build files for Noetic; its migration guide requires this version of CMake."""


def removed_programs(model: Model) -> Iterator[tuple[Source, int, str, str]]:
    """Yield file, offset, program and replacement of each removed program, in workspaces for Noetic only."""
    sources = [source for name, source in model.related_files.items() if name.endswith(".launch")]
    found = [(source, at) for source in sources for at in re.finditer(_FORMER, uncommented(source))]
    if found and _is_for_noetic(model):
        for source, at in found:
            group = 1 if at[1] else 2
            yield source, at.start(group), at[group], "xacro"


def _is_for_noetic(model: Model) -> bool:
    if any(re.search(_OF_NOETIC, source.text) for source in model.related_files.values()):
        return True
    folders = neighbours(model.package).values() if model.package is not None else ()
    return any(re.match(r"#!.*\bpython3", text) for folder in folders for _, text in code_texts(folder, (".py",)))
