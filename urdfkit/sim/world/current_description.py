"""Description of a running world that can be saved: all entities at their present poses.

SDF has no joint positions: the links of a model are saved at their present poses, where its joints are zero when the
file is loaded, and joint limits are shifted accordingly. A robot, whose plugins depend on its zero position, is saved
with its joints at zero. Velocities are not saved.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

from urdfkit.description.sdf import World, WorldJoint, WorldModel, WorldRobot
from urdfkit.description.urdf.geometry import IDENTITY, between, compose, inverse
from urdfkit.description.urdf.robot import Pose
from urdfkit.sim.construction.rigid_bodies import parts_of, trees_of
from urdfkit.sim.state.poses import pose_from
from urdfkit.sim.world.entity_poses import pose_of
from urdfkit.sim.world.world_builder import WorldBuilder
from urdfkit.sim.world.world_entity import WorldEntity

SMALL = 1e-12
"""Difference below which a pose is saved as in the original description [m, rad]."""


def current_description(builder: WorldBuilder, note: Callable[[str], None]) -> World:
    """Return a description of the present world, without the simulation's own robot.

    Args:
        builder: builder of the world.
        note: reports entities that cannot be saved.
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
    """Return a model with its links at their present poses; `around` is the pose of its frame in the outer model."""
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
    """Return a joint whose zero is its present position; the offset of a mimic joint is shifted accordingly."""
    if not joint.axes:
        return joint
    by, first = turned.get(prefix + joint.name, 0.0), joint.axes[0]
    if by:
        first = replace(first, lower=first.lower - by, upper=first.upper - by)
    if (mimic := first.mimic) is not None:
        reference = mimic.reference - turned.get(prefix + mimic.joint, 0.0)
        first = replace(first, mimic=replace(mimic, offset=mimic.offset - by, reference=reference))
    return replace(joint, axes=(first, *joint.axes[1:]))


def _unless_near(pose: Pose, original: Pose) -> Pose:
    pairs = zip((*pose.xyz, *pose.rpy), (*original.xyz, *original.rpy), strict=True)
    return original if all(abs(a - b) < SMALL for a, b in pairs) else pose
