"""Cycles of dependencies between the packages of a workspace."""

import re
from collections.abc import Mapping
from pathlib import Path

from urdfkit.description.packages.related_files import manifest

_KINDS = "depend|build_depend|build_export_depend|buildtool_depend|exec_depend|run_depend"
_DEPENDENCY = rf"<(?:{_KINDS})(?:\s+version_\w+\s*=\s*[\"'][^\"']*[\"'])*\s*>\s*([\w.-]+)\s*<"
"""Matches a dependency without a condition; tests are built after all packages that they need."""


def cycle_over(name: str, other: str, packages: Mapping[str, Path]) -> list[str]:
    """Return the packages from a package over one of its dependencies back to it; empty if they are in no cycle."""
    before: dict[str, str] = {other: name}
    pending = [other]
    while pending:
        current = pending.pop(0)
        for needed in re.findall(_DEPENDENCY, manifest(packages[current])) if current in packages else ():
            if needed == name:
                path = [name, current]
                while path[-1] != other:
                    path.append(before[path[-1]])
                return [path[0], *reversed(path[1:]), name]
            if needed in packages and needed not in before:
                before[needed] = current
                pending.append(needed)
    return []
