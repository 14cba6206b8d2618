"""G621 mesh-of-other-link."""

from collections import Counter
from pathlib import PurePosixPath

from urdfkit.description.urdf.robot import Collision, Link, Mesh, Visual
from urdfkit.description.xml.element import Element
from urdfkit.lint.rule import Findings, Model, RobotRule


class MeshOfOtherLink(RobotRule):
    """The visual and collision meshes of a link belong to two different links.

    ## What it does
    Compares the file names, without suffix, of the visual mesh and the collision mesh in links with one mesh of each
    kind. Reports a link with two different names if another link uses one of these names for both of its meshes. Robots
    in which most links have two meshes of different names are not checked.

    ## Why is this bad?
    A part is drawn in the shape of another part, or collides with it. The usual cause is a copied ``<mesh>``.

    ## Example
    ```diff
     <robot name="arm">
       <link name="world"/>
       <link name="base">
         <visual><geometry><mesh filename="visual/base.stl"/></geometry></visual>
         <collision><geometry><mesh filename="collision/base.stl"/></geometry></collision>
       </link>
       <link name="upper_arm">
         <visual><geometry><mesh filename="visual/upper_arm.stl"/></geometry></visual>
         <collision><geometry><mesh filename="collision/upper_arm.stl"/></geometry></collision>
       </link>
       <link name="forearm">
    -    <visual><geometry><mesh filename="visual/upper_arm.stl"/></geometry></visual>
    +    <visual><geometry><mesh filename="visual/forearm.stl"/></geometry></visual>
         <collision><geometry><mesh filename="collision/forearm.stl"/></geometry></collision>
       </link>
       <joint name="mount" type="fixed"><parent link="world"/><child link="base"/></joint>
       <joint name="first" type="fixed"><parent link="base"/><child link="upper_arm"/></joint>
       <joint name="second" type="fixed"><parent link="upper_arm"/><child link="forearm"/></joint>
     </robot>
    ```
    """

    code = "G621"
    name = "mesh-of-other-link"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link with the mesh of another link."""
        links = model.robot.links
        pairs = zip(links, model.facts.of(_stems, links), strict=True)
        both = [(link, visual, collision) for link, (visual, collision) in pairs if visual and collision]
        equal = Counter(visual for _, visual, collision in both if visual == collision)
        different = [each for each in both if each[1] != each[2]]
        if len(different) > 1 or sum(equal.values()) < 2:
            return
        for link, visual, collision in different:
            if (visual in equal) == (collision in equal):
                continue
            wrong, right, group = (
                (visual, collision, link.visuals) if visual in equal else (collision, visual, link.collisions)
            )
            element = _mesh(group[0])
            message = f"link `{link.name}` has the mesh `{wrong}` of another link; its other mesh is `{right}`"
            yield self.at(
                model, element, message, attribute="filename", link=link.name, help="check the file names of the meshes"
            )


def _stems(link: Link) -> tuple[str, str]:
    """Return the names of the visual and the collision mesh of a link; empty if it does not have one of each."""
    found = []
    for group in (link.visuals, link.collisions):
        shapes = [shape.geometry for shape in group]
        is_mesh = len(shapes) == 1 and isinstance(shapes[0], Mesh)
        found.append(PurePosixPath(shapes[0].uri).stem.lower() if is_mesh and isinstance(shapes[0], Mesh) else "")
    return found[0], found[1]


def _mesh(shape: Visual | Collision) -> Element:
    geometry = shape.element.find("geometry")
    return (geometry.find("mesh") if geometry is not None else None) or shape.element
