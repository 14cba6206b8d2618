"""Files of controller parameters that the ``<parameters>`` of a ros2_control plugin name."""

import re
from pathlib import Path

from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.packages.similar_names import near_path
from urdfkit.errors import ResourceError
from urdfkit.position import Position

_FIND = re.compile(r"\$\(\s*(?:find|find-pkg-share)\s+([^()\s]+)\s*\)")


def parameter_file(
    text: str, packages: Packages | None, folder: Path, *, in_any_case: bool = False, position: Position | None = None
) -> Path:
    """Return the path of the file that a ``<parameters>`` element names.

    Args:
        text: text of the element.
        packages: resolves ``$(find …)`` and ``package://``; None to resolve paths only.
        folder: folder of the robot, for relative paths.
        in_any_case: accept a file whose path differs in capital letters, and add it to the notes of the packages.
        position: of the element, for that note.

    Raises:
        ResourceError: file or package not found; the message names the nearest file.
    """
    text = text.strip()
    if packages is not None:
        text = _FIND.sub(lambda match: str(packages.find(match[1])), text)
        if "://" in text:
            if in_any_case:
                return packages.resolve_in_any_case(text, folder, position)
            return packages.resolve(text, folder)
    path = folder / text
    if is_file(path):
        return path
    moved = packages.relocate(path) if packages is not None else None
    if moved is not None:
        return moved
    # A file that is installed to <share>/config may be in another folder of the sources, such as bringup/config.
    for package in (folder for folder in path.parents if is_file(folder / "package.xml")):
        found = sorted(package.glob(f"*/{path.relative_to(package)}"))
        if len(found) == 1:
            return found[0]
    if in_any_case and packages is not None and (other := packages.in_any_case(path, text, position)) is not None:
        return other
    raise ResourceError(f"no file {text}" + near_path(path), kind="file")
