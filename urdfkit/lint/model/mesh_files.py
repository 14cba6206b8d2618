"""Mesh files: their elements and paths."""

from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.urdf.robot import Link, Mesh, Robot
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.element import Element


def meshes(robot: Robot) -> Iterator[tuple[Mesh, Element, Link]]:
    """Yield every mesh that has a file name, with its ``<mesh>`` element and link."""
    for link in robot.links:
        yield from meshes_of(link)


def meshes_of(link: Link) -> list[tuple[Mesh, Element, Link]]:
    """Return the meshes of a link that have a file name, each with its ``<mesh>`` element and the link."""
    from urdfkit.lint.model.placement import shapes_of

    found = []
    for item in shapes_of(link):
        if not isinstance(item.geometry, Mesh) or not item.geometry.uri.strip():
            continue
        geometry = item.element.find("geometry")
        element = geometry.find("mesh") if geometry is not None else None
        if element is not None:
            found.append((item.geometry, element, link))
    return found


def path_of(mesh: Mesh, expanded: Expanded) -> Path | None:
    """Return the path of a mesh; None if it was not found."""
    from urdfkit.errors import ResourceError

    try:
        return expanded.packages.resolve(mesh.uri.strip(), expanded.path)
    except ResourceError:
        return None


def missing(mesh: Mesh, expanded: Expanded) -> tuple[str, str | None] | None:
    """Return the missing part of a mesh's URI; None if it exists.

    The part is ``package`` with its name, or ``file`` with the similar name of a file or folder, if there is one.
    """
    from urdfkit.errors import ResourceError

    uri = mesh.uri.strip()
    scheme, separator, rest = uri.partition("://")
    if separator and scheme in ("package", "model"):
        name = rest.partition("/")[0]
        try:
            expanded.packages.find(name)
        except ResourceError:
            return "package", name
    elif separator and scheme != "file":
        return None  # Remote URIs are not checked.
    try:
        expanded.packages.resolve(uri, expanded.path)
    except ResourceError as error:
        return "file", error.near
    return None


def is_remote(uri: str) -> bool:
    """Return whether a URI names a file of another machine."""
    scheme, separator, _ = uri.strip().partition("://")
    return bool(separator) and scheme not in ("package", "model", "file") and "$" not in scheme
