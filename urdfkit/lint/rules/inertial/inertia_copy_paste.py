"""I510 inertia-copy-paste."""

from itertools import pairwise

from urdfkit.description.urdf.robot import Link
from urdfkit.lint.facts.features import inertia_components
from urdfkit.lint.rule import Findings, Model, RobotRule


class InertiaCopyPaste(RobotRule):
    """Links of different sizes have the same inertia tensor.

    ## What it does
    Checks for a tensor that three or more links share although the sizes of their shapes differ by more than a tenth.

    ## Why is this bad?
    A tensor depends on shape and mass, so a shared tensor was copied instead of computed.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    +      <inertia ixx="0.016" ixy="0" ixz="0" iyy="0.016" iyz="0" izz="0.016"/>
         </inertial>
         <visual><geometry><sphere radius="0.2"/></geometry></visual>
       </link>
       <link name="upper">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    +      <inertia ixx="0.00667" ixy="0" ixz="0" iyy="0.01083" iyz="0" izz="0.01083"/>
         </inertial>
       </link>
    -  <link name="lower">
    -    <inertial>
    -      <mass value="1"/>
    -      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    -    </inertial>
    -    <visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual>
    -  </link>
       <joint name="a" type="fixed"><parent link="base"/><child link="upper"/></joint>
    -  <joint name="b" type="fixed"><parent link="upper"/><child link="lower"/></joint>
     </robot>
    ```
    """

    code = "I510"
    name = "inertia-copy-paste"
    severity = "note"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor that several links of different size share, at the first link."""
        groups: dict[tuple[float, ...], list[Link]] = {}
        for link, values in zip(model.robot.links, model.facts.of(inertia_components, model.robot.links), strict=True):
            if values is not None:
                groups.setdefault(values, []).append(link)
        for values, links in groups.items():
            if len(links) < 3 or not any(values):
                continue
            every = model.extents
            diagonals = {extent.diagonal for link in links if (extent := every.get(link.name)) is not None}
            sizes = sorted({round(diagonal, 6) for diagonal in diagonals})
            size_steps = [a for a, b in pairwise(sizes) if b > 1.1 * a]
            inertial = links[0].inertial
            if not size_steps or inertial is None or inertial.inertia is None:
                continue
            names = ", ".join(link.name for link in links[:3])
            message = (
                f"{len(links)} links of different sizes share this inertia: {names}{' …' if len(links) > 3 else ''}"
            )
            help = "compute each tensor from shape and mass"
            yield self.at(model, inertial.inertia.element, message, link=links[0].name, help=help)
