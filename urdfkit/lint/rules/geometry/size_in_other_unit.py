"""G619 size-in-other-unit."""

from urdfkit.description.urdf.robot import Link, Mesh
from urdfkit.lint.model.placement import Extent, offset_of, shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule
from urdfkit.lint.rules.inertial.mass_vs_volume import MIN_DENSITY, PLACEHOLDER, SCENERY_SIZE

_TIMES = 50.0
"""Ratio of a size to the median of the others that only another unit explains."""

_MIN_SIZE = 2.0
"""Smallest size that is checked [m]."""

_LONGEST_RAIL = 100.0
"""Largest size of a link along which another link slides [m]."""

_MIN_OTHERS = 3
"""Smallest number of sizes and distances to compare with."""


class SizeInOtherUnit(RobotRule):
    """A shape is far larger than the rest of the robot.

    ## What it does
    Compares boxes, cylinders, spheres and capsules with the median of the distances between joints and the sizes of the
    other shapes. Reports shapes of more than 50 times that median and more than 2 m. The root link is not checked,
    because it may be a ground plane. A link on which another link slides may be up to 100 m long. Links with an
    implausible density, which I514 reports, are not checked either. G604 checks meshes.

    ## Why is this bad?
    The shape hides the robot and collides with everything. Usually its size was written in millimetres.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"><visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual></link>
       <link name="upper_arm">
         <visual>
    -      <geometry><cylinder radius="40" length="300"/></geometry>
    +      <geometry><cylinder radius="0.04" length="0.3"/></geometry>
         </visual>
       </link>
       <link name="forearm"><visual><geometry><cylinder radius="0.04" length="0.3"/></geometry></visual></link>
       <joint name="shoulder_joint" type="fixed">
         <parent link="base"/><child link="upper_arm"/><origin xyz="0 0 0.1"/>
       </joint>
       <joint name="elbow_joint" type="fixed">
         <parent link="upper_arm"/><child link="forearm"/><origin xyz="0 0 0.3"/>
       </joint>
     </robot>
    ```
    """

    code = "G619"
    name = "size-in-other-unit"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link with a shape that is far too large."""
        extents = model.extents
        large = {name: extent for name, extent in extents.items() if extent.diagonal > _MIN_SIZE}
        if not large or model.is_incomplete:
            return
        children = {joint.child for joint in model.robot.joints}
        rails = {joint.parent for joint in model.robot.joints if joint.type == "prismatic"}
        for name, extent in large.items():
            link = model.robot.link_by_name[name]
            if name not in children or any(isinstance(shape.geometry, Mesh) for shape in shapes_of(link)):
                continue
            if name in rails and extent.diagonal <= _LONGEST_RAIL:
                continue
            offsets = filter(None, model.facts.of(offset_of, model.robot.joints))
            others = sorted([*(other.diagonal for key, other in extents.items() if key != name), *offsets])
            median = others[len(others) // 2] if len(others) >= _MIN_OTHERS else 0.0
            if not median or extent.diagonal <= _TIMES * median or _has_impossible_density(link, extent):
                continue
            shape = shapes_of(link)[0].element
            message = f"link `{name}` has a size of {extent.diagonal:.3g} m, "
            message += f"more than {_TIMES:g} times the median size of the other parts"
            yield self.at(model, shape.find("geometry") or shape, message, link=name, help="write sizes in metres")


def _has_impossible_density(link: Link, extent: Extent) -> bool:
    """Return whether I514 reports the density of a link."""
    mass = link.inertial.mass if link.inertial is not None else None
    if not mass or mass <= PLACEHOLDER or not extent.volumes or extent.diagonal > SCENERY_SIZE:
        return False
    return mass < MIN_DENSITY * min(extent.volumes)
