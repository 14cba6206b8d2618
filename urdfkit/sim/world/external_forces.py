"""External forces and torques on bodies and on links of robots, in world axes.

They correspond to Gazebo's ``apply_body_wrench`` and gz's ``ApplyLinkWrench``: a force in world axes acts at a point
that moves with the link, by default its origin; several forces add up. A force is evaluated at the middle of a step,
like all other quantities of the engine, so that a constant force on a rotating body is constant in the world.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError, UnknownNameError
from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.sim.construction.rigid_bodies import parts_of
from urdfkit.sim.engine import Engine, FreeBody
from urdfkit.sim.state.arguments import nearest, vector
from urdfkit.sim.state.quaternion import product, rotate
from urdfkit.sim.world.simulated_robot import SimulatedRobot
from urdfkit.sim.world.world_builder import WorldBuilder
from urdfkit.sim.world.world_entity import WorldEntity

Target = tuple["SimulatedRobot | None", str]
"""A robot and the name of its link, or None and the name of a free body."""

NO_WRENCH = (0.0,) * 6
ZERO = (0.0, 0.0, 0.0)


@dataclass(frozen=True, eq=False)
class Push:
    """A force and a torque that act on a body or link.

    Attributes:
        target: the body or link.
        force: force in world axes [N].
        torque: torque in world axes [N·m].
        at: point of attack in the link's frame [m].
        until: step before which the force ends; infinite without an end.
    """

    target: Target
    force: tuple[float, ...]
    torque: tuple[float, ...]
    at: tuple[float, ...]
    until: float


class ExternalForces:
    """Forces and torques that act on the bodies and links of a world.

    Args:
        builder: builder of the world.
    """

    def __init__(self, builder: WorldBuilder) -> None:
        self._builder = builder
        self.acting: list[Push] = []

    def push(
        self,
        name: str,
        force: Sequence[float] = ZERO,
        torque: Sequence[float] = ZERO,
        *,
        at: Sequence[float] = ZERO,
        for_seconds: float | None = None,
    ) -> None:
        """Push a body or a link from now on; pushes add up. See `LiveWorld.push`."""
        engine = self._builder.engine
        target, steps = target_of(self._builder, name), _steps(for_seconds, engine.dt)
        force = vector(force, 3, "the force of a push", "N")
        torque = vector(torque, 3, "the torque of a push", "N·m")
        at = vector(at, 3, "the point of attack of a push", "m")
        self.acting.append(Push(target, force, torque, at, engine.steps + steps))

    def release(self, name: str) -> None:
        """End all pushes on a body or link.

        Raises:
            UnknownNameError: unknown name.
        """
        robot, link = target_of(self._builder, name)
        self.acting = [push for push in self.acting if push.target[0] is not robot or push.target[1] != link]

    def forget(self, entity: WorldEntity) -> None:
        """End all pushes on an entity that is removed."""
        removed = {id(robot) for robot in entity.robots}
        self.acting = [
            push
            for push in self.acting
            if not ((id(push.target[0]) in removed) if push.target[0] else push.target[1] in entity.offsets)
        ]

    def on(self, robot: SimulatedRobot, links: Sequence[str]) -> tuple[tuple[Array, Array, Array], ...]:
        """Return force [N], torque [N·m] and point of attack [m], in world axes, of each push on links of a robot."""
        pushes = []
        for push in self.acting:
            if push.target[0] is robot and push.target[1] in links:
                pose = robot.state.link_poses()[robot.kinematics.link_names.index(push.target[1])]
                at = pose[:3] + np.array(rotate(pose[3:], push.at))
                pushes.append((np.array(push.force), np.array(push.torque), at))
        return tuple(pushes)

    def step(self, engine: Engine) -> None:
        """Advance an engine by one step with the acting forces.

        Raises:
            SimulationError: the simulation diverged.
        """
        self.acting = [push for push in self.acting if push.until > engine.steps]
        efforts: list[tuple[Any, Array]] = []
        wrenches: dict[str, Array] = {}
        for push in self.acting:
            robot, name = push.target
            if robot is None:
                wrenches[name] = wrenches.get(name, np.zeros(6)) + _on_body(engine.bodies[name], push, engine.dt)
            else:
                efforts.append((robot, _on_link(robot, name, push, engine.dt)))
        before = [(robot.articulation.applied, robot.articulation.applied.copy()) for robot, _ in efforts]
        for robot, effort in efforts:
            robot.articulation.applied += effort
        for name, wrench in wrenches.items():
            engine.bodies[name].push(wrench.tolist())
        try:
            engine.step(1)
        finally:
            for applied, values in reversed(before):
                applied[:] = values
            for name in wrenches:
                engine.bodies[name].push(NO_WRENCH)


def target_of(builder: WorldBuilder, name: str) -> Target:
    """Return the free body or the link that a name denotes.

    Raises:
        SimulationError: unknown name, or the body does not move.
    """
    if name in builder.free_bodies:
        return None, name
    robots = builder.robots
    first = builder.robot_list[0]
    if name in first.kinematics.link_names:
        return first, name
    if name in robots:
        return robots[name], robots[name].kinematics.root
    for robot in robots.values():
        link = name.removeprefix(f"{robot.name}::")
        if link != name and link in robot.kinematics.link_names:
            return robot, link
    body = _body_of(builder, name)
    if body in builder.free_bodies:
        return None, body
    if name in builder.static_poses or body in builder.static_poses:
        raise SimulationError(f"body `{name}` is static; it cannot be pushed")
    names = [*builder.free_bodies, *first.kinematics.link_names]
    names += [f"{each.name}::{link}" for each in robots.values() for link in each.kinematics.link_names]
    raise UnknownNameError(f"no body or link `{name}` in the simulation{nearest(name, names)}")


def _body_of(builder: WorldBuilder, scoped: str) -> str:
    """Return the body that contains a link of a model, ``MODEL::LINK``; empty if there is no such link."""
    name, _, link = scoped.partition("::")
    for model in builder.description.models:
        if link and model.name == name:
            for body, _, links in parts_of(model):
                if any(link == each[0] for each in links):
                    return body
    return ""


def _steps(seconds: float | None, dt: float) -> float:
    """Return the number of steps that a push lasts: infinite for None, and at least one step if not zero.

    Raises:
        SimulationError: the duration is negative or not finite.
    """
    if seconds is None:
        return inf
    if not (isfinite(seconds) and seconds >= 0):
        raise SimulationError(f"a push cannot last {seconds:g} s; omit the duration to push until released")
    return max(1, round(seconds / dt)) if seconds > 0 else 0


def _on_body(body: FreeBody, push: Push, dt: float) -> Array:
    """Return the wrench at the origin of a free body, in its own axes at the middle of the step."""
    pose, twist = body.pose, body.twist
    turned = _half_a_step_later(pose[3:], twist[3:], dt)
    inverse = (-turned[0], -turned[1], -turned[2], turned[3])
    force = np.array(rotate(inverse, push.force))
    return np.concatenate([force, np.array(rotate(inverse, push.torque)) + np.cross(push.at, force)])


def _half_a_step_later(quaternion: Sequence[float], rate: Sequence[float], dt: float) -> tuple[float, ...]:
    """Return an orientation after half a step with a constant angular velocity in world axes [rad/s]."""
    angle = vector_norm(rate) * dt / 2
    scale = 0.5 * dt / 2 * float(np.sinc(angle / 2 / np.pi))
    x, y, z = (scale * part for part in rate)
    return product((x, y, z, float(np.cos(angle / 2))), quaternion)


def _on_link(robot: SimulatedRobot, link: str, push: Push, dt: float) -> Array:
    """Return the generalised forces of a push on a robot at the middle of the step: Jᵀ·wrench; shape (nv,)."""
    import pinocchio

    pin: Any = pinocchio
    kinematics = robot.kinematics
    model, data = kinematics.model, kinematics.data
    force, torque = push.force, push.torque
    if not kinematics.floating_base:
        x, y, z, w = robot.base[3:]
        force, torque = rotate((-x, -y, -z, w), force), rotate((-x, -y, -z, w), torque)
    q = pin.integrate(model, robot.articulation.q, 0.5 * dt * robot.articulation.v)
    frame = kinematics.frame(link)
    jacobian = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL_WORLD_ALIGNED)
    arm = matmul(data.oMf[frame].rotation, np.array(push.at))
    efforts: Array = matmul(jacobian.T, np.concatenate([force, np.array(torque) + np.cross(arm, force)]))
    return efforts
