"""G618 texture-missing."""

from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.xml.element import Element
from urdfkit.errors import ResourceError
from urdfkit.lint.model.mesh_files import is_remote, path_of
from urdfkit.lint.rule import Findings, Model, RobotRule


class TextureMissing(RobotRule):
    """A visual shape has a texture whose image does not exist or cannot be read.

    ## What it does
    Checks the images of ``<texture>`` and of OBJ, COLLADA and glTF meshes. The image of a mesh is searched for at its
    path relative to the mesh, next to the mesh, and in ``materials/textures`` next to the folder of the mesh.

    ## Why is this bad?
    Viewers and camera images show the shape in one colour, often white or black, and usually without a message. Usually
    only the mesh was copied or committed, without its image.

    ## Example
    ```diff
     <robot name="crate">
       <link name="base">
         <visual>
           <geometry><box size="1 1 1"/></geometry>
    -      <material name="wood"><texture filename="textures/wod.png"/></material>
    +      <material name="wood"><color rgba="0.6 0.4 0.2 1"/></material>
         </visual>
       </link>
     </robot>
    ```
    """

    code = "G618"
    name = "texture-missing"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each image that is missing or invalid."""
        entry, packages = model.expanded.path, model.expanded.packages
        for texture in _textures(model):
            uri = (texture.get("filename") or "").strip()
            if not uri or "$" in uri or model.is_unresolved(texture, "filename"):
                continue
            if is_remote(uri):
                message = f"texture `{uri}` is not a file on this machine"
                yield self.at(model, texture, message, attribute="filename", severity="note")
                continue
            try:
                fault = _fault(packages.resolve(uri, entry))
            except ResourceError:
                fault = "does not exist"
            if fault:
                cause = f"textures of {uri.rpartition('/')[0]}" if fault == "does not exist" else ""
                yield self.at(model, texture, f"texture `{uri}` {fault}", attribute="filename", cause=cause)
        faults: dict[Path, list[tuple[str, str]]] = {}
        for mesh, element, link in model.meshes:
            if not mesh.uri.rstrip().lower().endswith((".obj", ".dae", ".gltf")):
                continue
            path = path_of(mesh, model.expanded)
            if path is None or not any(visual.geometry is mesh for visual in link.visuals):
                continue
            if path not in faults:
                faults[path] = list(_faults(model, path))
            for name, fault in faults[path]:
                message = f"texture `{name}` of mesh `{mesh.uri.strip()}` {fault}"
                cause = f"textures of {path.parent}" if fault == "does not exist" else ""
                yield self.at(model, element, message, attribute="filename", link=link.name, cause=cause)


def _textures(model: Model) -> Iterator[Element]:
    """Yield the texture of each material of the robot and of its visual shapes."""
    if not any("texture" in source.text for source in model.expanded.sources.values()):
        return
    materials = [child for child in model.robot.element.children if child.tag == "material"]
    materials += [
        each for link in model.robot.links for visual in link.visuals if (each := visual.element.find("material"))
    ]
    yield from (texture for each in materials for texture in each.children if texture.tag == "texture")


def _faults(model: Model, mesh: Path) -> Iterator[tuple[str, str]]:
    """Yield the name and the fault of each image that a mesh refers to and that cannot be shown."""
    from urdfkit.meshes.picture_files import picture_names, places

    try:
        names = picture_names(mesh)
    except OSError:
        return
    for name in names:
        found = None
        for place, within in places(mesh.parent.absolute(), name):
            try:  # by the resolver, so that a result in the cache is invalid once the image exists
                path = model.expanded.packages.resolve(str(place), model.expanded.path)
            except ResourceError:
                continue
            if path.resolve().is_relative_to(within.resolve()):
                found = path
                break
        if fault := "does not exist" if found is None else _fault(found):
            yield name, fault


def _fault(path: Path) -> str:
    """Return why an image cannot be read; empty if it can."""
    from urdfkit.meshes.picture_files import picture_fault

    try:
        return picture_fault(path)
    except OSError as error:
        return f"cannot be read: {error.strerror}"
