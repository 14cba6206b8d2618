"""Stage: everything in a simulation as it runs: stepped, pushed, looked at, put elsewhere, begun anew."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import World
from urdfkit.description.sdf.poses import IDENTITY, compose, inverse
from urdfkit.description.urdf.robot import Pose
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import matmul
from urdfkit.sim.state.arguments import vector
from urdfkit.sim.state.poses import pose_from, seven
from urdfkit.sim.world.external_forces import Pushes
from urdfkit.sim.world.included_models import Entry
from urdfkit.sim.world.simulated_robot import SimulatedRobot
from urdfkit.sim.world.world_builder import Assembly

AT_REST = (0.0,) * 6


class Stage(Assembly):
    """The robots and bodies of a world at work; see `Assembly` for what they are made of.

    Attributes:
        pushes: what pushes at present.
    """

    def __init__(self, first: SimulatedRobot, world: World, **options: Any) -> None:
        self.pushes = Pushes()
        super().__init__(first, world, **options)

    # Time

    def advance(self, steps: int) -> None:
        """Advance by so many steps, and take note in every robot's state.

        Raises:
            SimulationError: the simulation diverged.
        """
        left = steps
        while left > 0 and self.pushes.acting:
            self.pushes.step(self.engine)
            left -= 1
        if left:
            self.engine.step(left)
        for robot in self._robots:
            robot.state.advance(steps)

    def reset(self) -> None:
        """Put everything where it started, at t = 0, with nothing that pushes it."""
        self.pushes = Pushes()
        first = self._robots[0]
        self.engine.reset(*first.spawn.configuration(first.kinematics, first.base))
        for robot in self._robots:
            robot.state.advance(-robot.state.step)
            robot.begin()

    # Coming and going

    def remove(self, name: str) -> None:
        """Take a model or robot out of the world, and with it what pushes it.

        Raises:
            SimulationError: there is none, or it is the robot that the simulation is about.
        """
        entry = self.entry(name)
        super().remove(name)
        gone = {id(robot) for robot in entry.robots}
        self.pushes.forget(lambda target: (id(target[0]) in gone) if target[0] else target[1] in entry.offsets)

    # Where things are, and are put

    def pose_of(self, name: str) -> Pose:
        """Return where the frame of a model, or the root link of a robot, is in the world."""
        entry = self.entry(name)
        if self._stands(entry):
            assert entry.thing is not None
            return entry.thing.pose
        part, offset = next(iter(entry.offsets.items()))
        return compose(self._part_pose(entry, part), inverse(offset))

    def twist_of(self, name: str) -> tuple[float, ...]:
        """Return velocity [m/s] of the origin of a model's frame, or a robot's root link, and angular velocity [rad/s].

        They are along the world's axes.
        """
        entry = self.entry(name)
        if self._stands(entry):
            return AT_REST
        part, offset = next(iter(entry.offsets.items()))
        robot = next((each for each in entry.robots if each.name == part), None)
        found = np.array(
            robot.state.base_velocity if robot else self.loose[part].twist if part in self.loose else AT_REST
        )
        if offset != IDENTITY:
            back = np.array(self.pose_of(name).xyz) - np.array(self._part_pose(entry, part).xyz)
            found[:3] += np.cross(found[3:], back)
        return tuple(found.tolist())

    def move(self, name: str, pose: Pose, twist: Sequence[float] = AT_REST) -> None:
        """Put a model or robot somewhere, its parts as they are to each other, moving as one.

        Args:
            name: of a model, robot or body.
            pose: of the model's frame, or of a robot's root link.
            twist: velocity of that frame's origin [m/s] and angular velocity [rad/s], along the world's axes.

        Raises:
            SimulationError: there is none, or a robot that is bolted down is to move.
        """
        speed = np.array(vector(twist, 6, "the velocity", "m/s, rad/s"))
        if name not in self._entries and name in self.body_names:
            self.move_body(name, pose, twist)
            return
        entry = self.entry(name)
        shift = compose(pose, inverse(self.pose_of(name)))
        if self._stands(entry):
            if speed.any():
                raise SimulationError(f"`{name}` is static: it can be put elsewhere, but not be given a velocity")
            self._move_still(name, entry, pose, shift)
            return
        for part in entry.offsets:
            self._put(entry, part, compose(shift, self._part_pose(entry, part)), pose, speed)

    def move_body(self, name: str, pose: Pose, twist: Sequence[float] = AT_REST) -> None:
        """Put one body somewhere.

        Args:
            name: of the body.
            pose: in the world.
            twist: see `move`.

        Raises:
            SimulationError: there is none, or it is part of a model that does not move.
        """
        self.body(name)
        if name in self.loose:
            self.loose[name].place(seven(pose), vector(twist, 6, "the velocity", "m/s, rad/s"))
        elif name in self._entries:
            self.move(name, compose(pose, inverse(self._entries[name].offsets[name])), twist)
        else:
            raise SimulationError(f"body `{name}` does not move; place the model that it belongs to")

    def _stands(self, entry: Entry) -> bool:
        """Whether a model is made of nothing but what does not move."""
        return not entry.robots and not any(part in self.loose for part in entry.offsets)

    def _part_pose(self, entry: Entry, part: str) -> Pose:
        robot = next((each for each in entry.robots if each.name == part), None)
        if robot is not None:
            return pose_from(robot.state.base_pose)
        return pose_from(self.loose[part].pose if part in self.loose else self.still[part])

    def _put(self, entry: Entry, part: str, pose: Pose, around: Pose, speed: NDArray[np.float64]) -> None:
        offset = np.array(pose.xyz) - np.array(around.xyz)
        moving = np.concatenate([speed[:3] + np.cross(speed[3:], offset), speed[3:]])
        robot = next((each for each in entry.robots if each.name == part), None)
        if robot is None:
            if part in self.loose:
                self.loose[part].place(seven(pose), moving.tolist())
            return
        if not robot.kinematics.floating_base:
            raise SimulationError(f"robot `{part}` is bolted down; it cannot be put elsewhere")
        q, v = robot.part.q, robot.part.v.copy()
        q[:7] = seven(pose)
        R = _matrix(q[3:7])
        v[:3], v[3:6] = matmul(R.T, moving[:3]), matmul(R.T, moving[3:])
        robot.part.put(q, v)
        robot.state.advance(0)

    def _move_still(self, name: str, entry: Entry, pose: Pose, shift: Pose) -> None:
        assert entry.thing is not None
        entry.thing = replace(entry.thing, pose=pose)
        entry.still = tuple(replace(body, pose=seven(compose(shift, pose_from(body.pose)))) for body in entry.still)
        world = self.world
        models = tuple(entry.thing if each.name == name else each for each in world.models)
        robots = tuple(entry.thing if each.name == name else each for each in world.robots)
        self.world = replace(world, models=models, robots=robots)  # type: ignore[arg-type]
        self._build()


def _matrix(quaternion: NDArray[np.float64]) -> NDArray[np.float64]:
    import pinocchio as pin

    return np.array(pin.Quaternion(np.array(quaternion)).matrix())
