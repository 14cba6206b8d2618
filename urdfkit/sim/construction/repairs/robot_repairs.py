"""Repair of a robot before it is simulated: mimic joints, shapes, inertia tensors and masses, in this order."""

from dataclasses import replace

from urdfkit.defect_message import with_effect
from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.massless_links import first_massless, massless
from urdfkit.description.urdf.repair_record import Repair
from urdfkit.description.urdf.robot import Robot
from urdfkit.description.value_defects import repaired_values, require_valid_values
from urdfkit.kinematics.mimic import without_impossible_mimics
from urdfkit.scene import Scene, scene_of
from urdfkit.scene.placeholders import require_valid_shapes
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.construction.repairs.collision_shapes import with_substitutes, without_empty_shapes
from urdfkit.sim.construction.repairs.estimated_masses import with_causes, with_estimates
from urdfkit.sim.construction.repairs.inertia_tensors import possible, repair_at
from urdfkit.sim.construction.repairs.least_masses import with_least_masses
from urdfkit.sim.construction.repairs.line_masses import with_thickness

_SHOWN = 6
"""Largest number of masses in a message."""


def repaired(robot: Robot, scene: Scene | None, repairs: Repairs, *, floating: bool) -> tuple[Robot, Scene]:
    """Return a robot that can be simulated, and its shapes.

    Defects that no repair removes, such as negative masses, stay.

    Args:
        robot: the robot, one tree.
        scene: its shapes, if they have been loaded already.
        repairs: collects the repairs.
        floating: whether the base of the robot moves.

    Raises:
        UrdfkitError: a repair is a warning, and `repairs` is strict.
    """
    if repairs.strict:
        repairs.add(*robot.repairs)
        require_valid_values(robot)
        require_valid_shapes(robot)
    written = robot = without_impossible_mimics(robot)
    robot, found = without_empty_shapes(robot)
    scene = scene_of(robot, strict=False) if scene is None or found else scene
    scene, missing = with_substitutes(scene) if not repairs.strict else (scene, [])
    bodies = AttachedBodies(robot)
    pairs = [possible(link, bodies) for link in robot.links]
    found += missing + [repair for _, repair in pairs if repair is not None]
    if any(repair is not None for _, repair in pairs):
        robot = replace(robot, links=tuple([link for link, _ in pairs]))
    robot, values = repaired_values(robot)
    found += values
    robot, estimated = with_estimates(robot, scene, floating=floating, density=repairs.density)
    robot, least = with_least_masses(robot, floating=floating)
    robot, thick = with_thickness(robot, floating=floating)
    masses = _of_whole_robot(written, robot, [*estimated, *least], repairs.density, floating=floating)
    repairs.add(*with_causes(written.repairs, masses), *found, *thick)
    return robot, scene


def _of_whole_robot(
    written: Robot, robot: Robot, masses: list[Repair], density: float, *, floating: bool
) -> list[Repair]:
    """Return one repair instead of one per body if no link of a robot has an ``<inertial>``."""
    bodies = massless(written, floating=floating)
    if len(bodies) < 2 or not masses or any(link.inertial is not None for link in written.links):
        return masses
    link, joint = first_massless(bodies)
    amounts = [f"`{each.name}` {each.inertial.mass:.4g} kg" for each in robot.links if each.inertial is not None]
    more = f" and {len(amounts) - _SHOWN} others" if len(amounts) > _SHOWN else ""
    message = with_effect(
        f"no link of the robot has a mass, but joints move `{link.name}` and other links",
        f"simulated with {', '.join(amounts[:_SHOWN])}{more} "
        f"(from shapes at {density:g} kg/m³, an estimate for links without shapes)",
    )
    name = None if joint is None else joint.name
    return [repair_at(link.element, "mass", "I511", message, link=link.name, joint=name)]
