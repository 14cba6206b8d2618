"""Poses and velocities of the entities of a world: read and set, whether they are bodies, robots or static."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.geometry import IDENTITY, compose, inverse
from urdfkit.description.urdf.robot import Pose
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import matmul
from urdfkit.sim.state.arguments import check_size, vector
from urdfkit.sim.state.poses import pose_from, seven
from urdfkit.sim.world.world_builder import WorldBuilder
from urdfkit.sim.world.world_entity import WorldEntity

AT_REST = (0.0,) * 6


def pose_of(builder: WorldBuilder, name: str) -> Pose:
    """Return the pose of a model's frame, or of a robot's root link, in the world."""
    entity = builder.entity(name)
    if is_static(builder, entity):
        assert entity.source is not None
        return entity.source.pose
    part, offset = next(iter(entity.offsets.items()))
    return compose(_part_pose(builder, entity, part), inverse(offset))


def twist_of(builder: WorldBuilder, name: str) -> tuple[float, ...]:
    """Return the linear [m/s] and angular velocity [rad/s] of a model's frame or a robot's root link, in world axes."""
    entity = builder.entity(name)
    if is_static(builder, entity):
        return AT_REST
    part, offset = next(iter(entity.offsets.items()))
    robot = next((each for each in entity.robots if each.name == part), None)
    velocity = np.array(
        robot.state.base_velocity
        if robot
        else builder.free_bodies[part].twist
        if part in builder.free_bodies
        else AT_REST
    )
    if offset != IDENTITY:
        back = np.array(pose_of(builder, name).xyz) - np.array(_part_pose(builder, entity, part).xyz)
        velocity[:3] += np.cross(velocity[3:], back)
    return tuple(velocity.tolist())


def move(builder: WorldBuilder, name: str, pose: Pose, twist: Sequence[float] = AT_REST) -> None:
    """Place a model or robot, with the relative poses of its parts unchanged.

    Args:
        builder: builder of the world.
        name: name of the model, robot or body.
        pose: pose of the model's frame, or of the robot's root link.
        twist: linear [m/s] and angular velocity [rad/s] of that frame, in world axes.

    Raises:
        SimulationError: unknown name, or a robot with a fixed base is moved.
    """
    twist = vector(twist, 6, "the velocity", "m/s, rad/s")
    check_size(twist, "the velocity", "m/s, rad/s")
    speed = np.array(twist)
    if name not in builder.entities and name in builder.body_names:
        move_body(builder, name, pose, twist)
        return
    entity = builder.entity(name)
    shift = compose(pose, inverse(pose_of(builder, name)))
    if is_static(builder, entity):
        if speed.any():
            raise SimulationError(f"`{name}` is static: it can be placed, but it cannot have a velocity")
        _move_static(builder, name, entity, pose, shift)
        return
    for part in entity.offsets:
        _put(builder, entity, part, compose(shift, _part_pose(builder, entity, part)), pose, speed)


def move_body(builder: WorldBuilder, name: str, pose: Pose, twist: Sequence[float] = AT_REST) -> None:
    """Place one body.

    Args:
        builder: builder of the world.
        name: name of the body.
        pose: pose in the world.
        twist: see `move`.

    Raises:
        SimulationError: unknown name, or the body belongs to a static model.
    """
    builder.body(name)
    if name in builder.free_bodies:
        builder.free_bodies[name].place(seven(pose), vector(twist, 6, "the velocity", "m/s, rad/s"))
    elif name in builder.entities:
        move(builder, name, compose(pose, inverse(builder.entities[name].offsets[name])), twist)
    else:
        raise SimulationError(f"body `{name}` is static; place its model instead")


def is_static(builder: WorldBuilder, entity: WorldEntity) -> bool:
    """Return whether no part of a model can move."""
    return not entity.robots and not any(part in builder.free_bodies for part in entity.offsets)


def _part_pose(builder: WorldBuilder, entity: WorldEntity, part: str) -> Pose:
    robot = next((each for each in entity.robots if each.name == part), None)
    if robot is not None:
        return pose_from(robot.state.base_pose)
    return pose_from(builder.free_bodies[part].pose if part in builder.free_bodies else builder.static_poses[part])


def _put(
    builder: WorldBuilder, entity: WorldEntity, part: str, pose: Pose, around: Pose, speed: NDArray[np.float64]
) -> None:
    offset = np.array(pose.xyz) - np.array(around.xyz)
    moving = np.concatenate([speed[:3] + np.cross(speed[3:], offset), speed[3:]])
    robot = next((each for each in entity.robots if each.name == part), None)
    if robot is None:
        if part in builder.free_bodies:
            builder.free_bodies[part].place(seven(pose), moving.tolist())
        return
    if not robot.kinematics.floating_base:
        raise SimulationError(f"robot `{part}` has a fixed base and cannot be placed")
    q, v = robot.articulation.q, robot.articulation.v.copy()
    q[:7] = seven(pose)
    R = _matrix(q[3:7])
    v[:3], v[3:6] = matmul(R.T, moving[:3]), matmul(R.T, moving[3:])
    robot.articulation.put(q, v)
    robot.state.advance(0)


def _move_static(builder: WorldBuilder, name: str, entity: WorldEntity, pose: Pose, shift: Pose) -> None:
    assert entity.source is not None
    entity.source = replace(entity.source, pose=pose)
    entity.static_bodies = tuple(
        replace(body, pose=seven(compose(shift, pose_from(body.pose)))) for body in entity.static_bodies
    )
    world = builder.description
    models = tuple(entity.source if each.name == name else each for each in world.models)
    robots = tuple(entity.source if each.name == name else each for each in world.robots)
    builder.description = replace(world, models=models, robots=robots)  # type: ignore[arg-type]
    builder.build()


def _matrix(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    import pinocchio as pin

    return np.array(pin.Quaternion(np.array(quaternion)).matrix())
