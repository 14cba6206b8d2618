"""Files related to a robot: launch files, YAML, SRDF and package files, with the text of each."""

import re
from collections.abc import Mapping
from pathlib import Path

from urdfkit.description.control.parameter_files import parameter_file
from urdfkit.description.control.ros2_controllers import manager_files
from urdfkit.description.hardware_defects import mock_blocks
from urdfkit.description.packages.related_files import SRDF, package_of
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import document_of, read_source, shown_path
from urdfkit.description.xml.source import Source
from urdfkit.errors import ResourceError, UrdfkitError, XmlError


def related_files(
    expanded: Expanded, robot: Robot, package: Path | None, texts: Mapping[str, str]
) -> tuple[dict[str, Source], dict[str, Element]]:
    """Return the related files of a robot, and the root elements of the SRDF files.

    Args:
        expanded: the expanded description.
        robot: the parsed robot.
        package: the package of the description.
        texts: absolute path → content that replaces the file on disk.

    Returns:
        Shown name → file; shown name → root element of each well-formed SRDF, expanded if it is a xacro file.
    """
    packages = expanded.packages
    files = dict.fromkeys(packages.around(package or expanded.path.absolute().parent))
    if package is not None:
        packages.watch(package)
    configured = _parameter_files(robot, packages, expanded.path.absolute())
    for other in _neighbours(configured, package) if package is not None else ():
        files.update(dict.fromkeys(packages.around(other)))
        packages.watch(other)
    files.update(dict.fromkeys(configured))
    included = () if any(file.name.endswith(SRDF) for file in files) else _of_included(expanded, package)
    files.update(dict.fromkeys(included))
    found: dict[str, Source] = {}
    roots: dict[str, Element] = {}
    for file in files:
        try:
            source = read_source(file, shown_as=shown_path(file), texts=texts)
            if file in included and not _describes(source.text, robot):
                continue
            found[shown_path(file)] = source
            if file.name.endswith(SRDF) and "<group" in source.text:
                root, sources = _semantic_description(file, source, packages, texts)
                found.update(sources)
                if root is not None:
                    roots[source.file] = root
        except ResourceError:
            continue
    return found, roots


def _of_included(expanded: Expanded, package: Path | None) -> list[Path]:
    """Return the SRDF files of the other packages from which the description includes files."""
    sources = [Path(file) for file in expanded.sources]
    folders = dict.fromkeys(package_of(file) for file in sources if file.suffix == ".xacro")
    others = [folder for folder in folders if folder is not None and folder != package]
    return [file for folder in others for file in expanded.packages.around(folder) if file.name.endswith(SRDF)]


def _describes(text: str, robot: Robot) -> bool:
    """Return whether most links in the pairs and chains of an SRDF exist in a robot."""
    names = re.findall(r"(?:link1|link2|base_link|tip_link)\s*=\s*[\"']([^\"']*)", text)
    return 5 * sum(name in robot.link_by_name for name in names) >= 4 * max(len(names), 1)


def _semantic_description(
    file: Path, source: Source, packages: Packages, texts: Mapping[str, str]
) -> tuple[Element | None, dict[str, Source]]:
    """Return the root element of an SRDF, and the files that its expansion read; None after an error."""
    if file.suffix != ".xacro":
        try:
            return document_of(source), {}
        except XmlError:
            return None, {}
    from urdfkit.description.xacro.expand import expand_leniently

    try:
        expanded: Expanded = expand_leniently(file, packages=packages, texts=texts)
    except UrdfkitError:
        return None, {}
    return (None if expanded.faults else expanded.root), expanded.sources


def _parameter_files(robot: Robot, packages: Packages, description: Path) -> list[Path]:
    """Return the existing files that the plugins of a robot, or its mock hardware, read parameters from."""
    found: dict[Path, None] = dict.fromkeys(manager_files(description)) if mock_blocks(robot) else {}
    for block in robot.gazebo:
        for plugin in block.plugins:
            for child in plugin.element.find_all("parameters"):
                try:
                    found[parameter_file(child.text, packages, description.parent)] = None
                except ResourceError:
                    continue
    return list(found)


def _neighbours(files: list[Path], own: Path) -> list[Path]:
    """Return the packages of files that are in the folder of a package, without the package."""
    packages = dict.fromkeys(package_of(file) for file in files)
    return [each for each in packages if each is not None and each.parent == own.parent and each != own]
