"""A running world as one that can be written: everything where it is now.

SDF has no joint positions: a model's links are saved where they are, which is where its joints are at zero when the
file is read, so their limits are shifted by as much. A robot, which has plugins that count on its zero, is saved with
its joints at zero. Velocities are lost.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from urdfkit.description.sdf import World, WorldJoint, WorldModel, WorldRobot
from urdfkit.description.urdf.geometry import IDENTITY, between, compose, inverse
from urdfkit.description.urdf.robot import Pose
from urdfkit.sim.construction.rigid_bodies import parts_of, trees_of
from urdfkit.sim.state.poses import pose_from
from urdfkit.sim.world.entity_poses import pose_of

if TYPE_CHECKING:
    from urdfkit.sim.world.world_builder import WorldBuilder
    from urdfkit.sim.world.world_entity import WorldEntity

SMALL = 1e-12
"""A pose that differs less from the written one is the written one [m, rad]."""


def current_description(builder: WorldBuilder, note: Callable[[str], None]) -> World:
    """Return the world as it is now, without the robot that the simulation is about.

    Args:
        builder: what is in it.
        note: told about what cannot be saved.
    """
    world = builder.description
    models = [_model(builder, builder.entity(model.name), model, note) for model in world.models]
    robots = [saved for robot in world.robots if (saved := _robot(builder, robot, note)) is not None]
    return replace(world, models=tuple(models), robots=tuple(robots))


def _robot(builder: WorldBuilder, robot: WorldRobot, note: Callable[[str], None]) -> WorldRobot | None:
    if not robot.file.endswith(".urdf"):
        why = "it was spawned from text" if not robot.file else "SDF includes .urdf files, not xacro"
        note(f"robot `{robot.name}` is not saved: {why}")
        return None
    return replace(robot, pose=_unless_near(pose_of(builder, robot.name), robot.pose))


def _model(builder: WorldBuilder, entity: WorldEntity, model: WorldModel, note: Callable[[str], None]) -> WorldModel:
    if not entity.robots and not any(name in builder.free_bodies for name in entity.offsets):
        return model
    whole = pose_of(builder, model.name)
    where: dict[str, Pose] = {}
    turned: dict[str, float] = {}
    for name, static, links in parts_of(model):
        if not static:
            shift = compose(between(whole, pose_from(builder.free_bodies[name].pose)), inverse(links[0][1]))
            where |= {link: compose(shift, pose) for link, pose, _ in links}
    for tree, robot in zip(trees_of(model), entity.robots, strict=True):
        root = between(whole, pose_from(robot.state.base_pose))
        if robot.has_plugins:
            shift = compose(root, inverse(tree.root))
            where |= {tree.prefix + name: compose(shift, pose) for name, pose in tree.poses.items()}
            if any(abs(robot.state.position(joint)) > SMALL for joint in robot.kinematics.joint_names):
                note(f"robot `{robot.name}` is saved with its joints at zero: SDF has no joint positions")
            continue
        poses = dict(zip(robot.kinematics.link_names, robot.state.link_poses(), strict=True))
        where |= {tree.prefix + name: between(whole, pose_from(poses[name])) for name in tree.links}
        joints = (*robot.kinematics.joint_names, *robot.kinematics.mimic_names)
        turned |= {tree.prefix + joint: robot.state.position(joint) for joint in joints}
    return replace(_moved(model, "", IDENTITY, where, turned), pose=_unless_near(whole, model.pose))


def _moved(
    model: WorldModel, prefix: str, around: Pose, where: dict[str, Pose], turned: dict[str, float]
) -> WorldModel:
    """Return a model with its links where they are; `around` is the pose of its frame in the whole model."""
    links = [
        replace(link, pose=_unless_near(between(around, where[prefix + link.name]), link.pose))
        if prefix + link.name in where
        else link
        for link in model.links
    ]
    joints = [_shifted(joint, prefix, turned) for joint in model.joints]
    nested = [
        _moved(inner, f"{prefix}{inner.name}::", compose(around, inner.pose), where, turned) for inner in model.models
    ]
    return replace(model, links=tuple(links), joints=tuple(joints), models=tuple(nested))


def _shifted(joint: WorldJoint, prefix: str, turned: Mapping[str, float]) -> WorldJoint:
    """Return a joint whose zero is where it stands now, as is that of a joint that it follows."""
    if not joint.axes:
        return joint
    by, first = turned.get(prefix + joint.name, 0.0), joint.axes[0]
    if by:
        first = replace(first, lower=first.lower - by, upper=first.upper - by)
    if (mimic := first.mimic) is not None:
        reference = mimic.reference - turned.get(prefix + mimic.joint, 0.0)
        first = replace(first, mimic=replace(mimic, offset=mimic.offset - by, reference=reference))
    return replace(joint, axes=(first, *joint.axes[1:]))


def _unless_near(found: Pose, written: Pose) -> Pose:
    near = all(abs(a - b) < SMALL for a, b in zip((*found.xyz, *found.rpy), (*written.xyz, *written.rpy), strict=True))
    return written if near else found
