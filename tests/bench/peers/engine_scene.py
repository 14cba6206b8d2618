"""The benchmark's scenes in our engine."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from tests.bench.peers.parsed_urdf import read
from tests.bench.peers.scene import DT, GRAVITY, Pose, Running, Scene, Thing
from urdfkit.kinematics import Kinematics
from urdfkit.scene import scene_of
from urdfkit.sim.engine import Body, Engine, Ground, Member, Piece, Surface

NOBODY = '<robot name="nobody"><link name="world"/></robot>'
"""A robot that is not there, for worlds that hold bodies only."""
SLIPPERY = Surface(0.0, 0.0)


class InUrdfkit(Running):
    """A scene in our engine: robots, and things without joints as bodies of the world.

    Args:
        scene: what to run.
        sleep: whether robots and bodies at rest may sleep.
    """

    def __init__(self, scene: Scene, *, sleep: bool = True) -> None:
        super().__init__(scene)
        self._servos: list[tuple[NDArray[np.int64], NDArray[np.float64]]] = []
        robots = [thing for thing in scene.things if "<joint" in thing.urdf and not scene.loose]
        bodies = {k: _body(f"box{k}", thing) for k, thing in enumerate(scene.things) if thing not in robots}
        if not robots:
            robots = [Thing(NOBODY, (0.0, 0.0, 0.0), bolted=True)]
        first, *others = [_member(f"robot{k}", thing) for k, thing in enumerate(robots)]
        self.engine = Engine(
            first.kinematics,
            first.shapes,
            dt=DT,
            gravity=GRAVITY,
            ground=Ground(),
            surfaces=first.surfaces,
            base=first.base,
            others=others,
            bodies=list(bodies.values()),
            sleep=sleep,
        )
        self._loose = {k: self.engine.bodies[body.name] for k, body in bodies.items() if not body.static}
        for part, thing in zip(self.engine.robots, robots, strict=True):
            part.put(_start(part.kinematics, thing))
            index = part.kinematics.velocity_index
            for joint, (speed, effort) in thing.motors.items():
                part.motor_velocity[index(joint)], part.motor_effort[index(joint)] = speed, effort
            for joint, (stiffness, damping, effort) in thing.servos.items():
                d = index(joint)
                part.kp[d], part.kd[d], part.servo_effort[d] = stiffness, damping, effort
            indices = [index(joint) for joint in thing.servos]
            poses = [[pose[joint] for joint in thing.servos] for pose in thing.poses]
            self._servos.append((np.array(indices, dtype=int), np.array(poses)))
        self.pose(0)

    def many(self, steps: int) -> None:
        """Advance by `steps` in one call."""
        self.engine.step(steps)

    def one_by_one(self, steps: int) -> None:
        """Advance by `steps`, each a call."""
        step = self.engine.step
        for _ in range(steps):
            step()

    def base(self, k: int) -> Pose:
        """Return where the root link of a thing is."""
        if k in self._loose:
            return self._loose[k].pose
        return tuple(self.engine.robots[k].q[:7].tolist())

    def position(self, k: int, joint: str) -> float:
        """Return a joint's position [rad]."""
        part = self.engine.robots[k]
        return float(part.positions[part.kinematics.velocity_index(joint)])

    def set_targets(self, k: int, number: int) -> None:
        """Set the targets of a thing's servos."""
        indices, poses = self._servos[k]
        self.engine.robots[k].position_target[indices] = poses[number]

    def knock(self, k: int, speed: float) -> None:
        """Give a box a speed along x."""
        box = self._loose[k]
        box.place(box.pose, (speed, 0.0, 0.0, 0.0, 0.0, 0.0))

    def asleep(self) -> int | None:
        """Return how many boxes sleep; robots whose motors run never do."""
        if not self.scene.loose:
            return None
        return sum(box.asleep for box in self._loose.values())


def _member(name: str, thing: Thing) -> Member:
    robot = read(thing.urdf)
    return Member(
        Kinematics(robot, floating_base=not thing.bolted),
        scene_of(robot).with_role("collision"),
        dict.fromkeys(thing.slippery, SLIPPERY),
        (*thing.at, 0.0, 0.0, 0.0, 1.0),
        name=name,
    )


def _start(kinematics: Kinematics, thing: Thing) -> NDArray[np.float64]:
    base = None if thing.bolted else np.array([*thing.at, 0.0, 0.0, 0.0, 1.0])
    return kinematics.configuration(dict(thing.poses[0]) if thing.poses else {}, base=base)


def _body(name: str, thing: Thing) -> Body:
    robot = read(thing.urdf)
    inertia = Kinematics(robot, floating_base=True).model.inertias[1]
    return Body(
        name,
        (*thing.at, 0.0, 0.0, 0.0, 1.0),
        [Piece(shape) for shape in scene_of(robot).with_role("collision")],
        static=thing.bolted,
        mass=inertia.mass,
        centre=inertia.lever.tolist(),
        inertia=inertia.inertia.tolist(),
    )
