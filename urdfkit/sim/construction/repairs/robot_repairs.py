"""Repair of a robot before it is simulated: shapes, inertia tensors and masses, in this order."""

from __future__ import annotations

from dataclasses import replace

from urdfkit.description.urdf.robot import Robot
from urdfkit.scene import Scene, scene_of
from urdfkit.sim.construction.repairs.collector import Repairs
from urdfkit.sim.construction.repairs.collision_shapes import with_substitutes, without_empty_shapes
from urdfkit.sim.construction.repairs.estimated_masses import with_estimates
from urdfkit.sim.construction.repairs.inertia_tensors import possible
from urdfkit.sim.construction.repairs.least_masses import with_least_masses


def repaired(robot: Robot, scene: Scene | None, repairs: Repairs, *, floating: bool) -> tuple[Robot, Scene]:
    """Return a robot that can be simulated, and its shapes; the robot as it is if `repairs` is strict.

    Defects that no repair removes, such as negative masses, stay.

    Args:
        robot: the robot as written.
        scene: its shapes, if they have been loaded already.
        repairs: collects the repairs.
        floating: whether the base of the robot moves.
    """
    if repairs.strict:
        return robot, scene or scene_of(robot, strict=False)
    robot, found = without_empty_shapes(robot)
    scene, missing = with_substitutes(scene_of(robot, strict=False) if scene is None or found else scene)
    pairs = [possible(link) for link in robot.links]
    found += missing + [repair for _, repair in pairs if repair is not None]
    if any(repair is not None for _, repair in pairs):
        robot = replace(robot, links=tuple([link for link, _ in pairs]))
    robot, estimated = with_estimates(robot, scene, floating=floating, density=repairs.density)
    robot, least = with_least_masses(robot, floating=floating)
    for repair in [*found, *estimated, *least]:
        repairs.add(repair)
    return robot, scene
