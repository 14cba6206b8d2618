"""Rows of robots in contact: grasping, carrying, standing, falling, and a heap."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pinocchio as pin

from fidelity.row import Row, distance
from fidelity.scene import G, Look, Run, Scene, Thing

PAD_MU, FINGERS, PALM = 0.5, 0.4, 1.0
HELD = Thing("held", (0.05, 0.05, 0.05), (0.0, 0.0, 1.0), 0.5)
LOAD = Thing("load", (0.1, 0.1, 0.1), (0.0, 0.0, 0.56), 1.0)
TRAY, TRAY_MU = 2.0, 0.5
LEGS = ("front_left", "front_right", "rear_left", "rear_right")
STANCE = {f"{leg}_{joint}": q for leg in LEGS for joint, q in (("hip", 0.5), ("knee", -1.0))}
FOOT = 0.02
"""Radius of a foot [m]."""
HEIGHT = 0.5 * math.cos(0.5) + FOOT
"""Height of the hips with the joints of `STANCE` [m]."""


def grasp(seconds: float, grip: float, lift: float) -> Scene:
    """Return the scene of a hand: each finger presses on a box with `grip`, and `lift` pulls up [N]."""
    efforts = {"left_slide": grip, "right_slide": -grip, "lift": lift}
    return Scene("hand", seconds, ground=False, things=(HELD,), efforts=efforts)


def _slip(end: Look) -> float:
    return distance(end.things["held"].position, (end.joints["left_slide"][0], 0.0, 1.0 + end.joints["lift"][0]))


def held(run: Run) -> float:
    """Return how far a box slips in 5 s between two fingers that hold it [m]."""
    return _slip(run(grasp(5.0, 20.0, (PALM + FINGERS + HELD.mass) * G))[-1])


def slipping(run: Run) -> float:
    """Return the relative error of the way of a box that slides out of a weak grasp, in 0.1 s."""
    grip = 3.0
    friction = 2 * PAD_MU * grip
    end = run(grasp(0.1, grip, (PALM + FINGERS) * G + friction))[-1]
    return abs((1.0 - end.things["held"].position[2]) / (0.5 * (G - friction / HELD.mass) * 0.01) - 1.0)


def lifted(run: Run) -> float:
    """Return how far a box slips that is lifted with 3 m/s² in half a second [m]."""
    return _slip(run(grasp(0.5, 20.0, (PALM + FINGERS + HELD.mass) * (G + 3.0)))[-1])


def carried(run: Run) -> float:
    """Return how far a box slips on a tray that moves off with 3 m/s², in 1 s [m]."""
    efforts = {"rail": 3.0 * (TRAY + LOAD.mass)}
    end = run(Scene("tray", 1.0, ground=False, things=(LOAD,), efforts=efforts))[-1]
    return distance(end.things["load"].position, (end.joints["rail"][0], 0.0, 0.56))


def dragged(run: Run) -> float:
    """Return the larger relative error of the ways of a tray and of a box that slides on it, in 0.25 s."""
    friction = TRAY_MU * LOAD.mass * G
    end = run(Scene("tray", 0.25, ground=False, things=(LOAD,), efforts={"rail": 20.0}))[-1]
    half = 0.5 * 0.25**2
    ways = (
        (end.joints["rail"][0], half * (20.0 - friction) / TRAY),
        (end.things["load"].position[0], half * TRAY_MU * G),
    )
    return max(abs(way / right - 1.0) for way, right in ways)


def standing(seconds: float, every: float | None = None, *, weighed: bool = False) -> Scene:
    """Return the scene of a robot that stands on four legs under PD control."""
    servos = {name: (300.0, 0.0, 5.0, target) for name, target in STANCE.items()}
    joints = {name: (target, 0.0) for name, target in STANCE.items()}
    spawn = (0.0, 0.0, HEIGHT, 0.0, 0.0, 0.0)
    return Scene("stander", seconds, spawn=spawn, joints=joints, servos=servos, every=every, weighed=weighed)


def creep(run: Run) -> float:
    """Return how far a standing robot moves from 6 s to 12 s after the start [m]."""
    looks = run(standing(12.0, 6.0))
    return distance(looks[2].base.position, looks[1].base.position)


def sinking(run: Run) -> float:
    """Return how deep a foot of a standing robot is in the ground after 6 s [m]."""
    robot = Oracle("stander")
    robot.put(run(standing(6.0))[-1])
    sole = pin.SE3(np.eye(3), np.array([0.0, 0.0, -0.25]))
    feet = [robot.data.oMi[robot.model.getJointId(f"{leg}_knee")] * sole for leg in LEGS]
    return max(0.0, *(FOOT - float(foot.translation[2]) for foot in feet))


def weight(run: Run) -> float:
    """Return how far the force of the ground on a standing robot is from its weight, as a share of it, after 6 s."""
    robot, end = Oracle("stander"), run(standing(6.0, weighed=True))[-1]
    right = robot.mass * G
    assert end.ground is not None
    return distance(end.ground.force, (0.0, 0.0, right)) / right


def pressure(run: Run) -> float:
    """Return how far the centre of pressure of a standing robot is from below its centre of mass, after 6 s [m]."""
    robot, end = Oracle("stander"), run(standing(6.0, weighed=True))[-1]
    robot.put(end)
    assert end.ground is not None
    return distance(end.ground.centre, robot.data.com[0][:2])


def falling(seconds: float, every: float, height: float) -> Scene:
    """Return the scene of a robot with limp arms that is thrown up, spinning, with its arms in motion."""
    joints = {"left_shoulder": (0.3, 4.0), "left_elbow": (0.5, -3.0), "right_shoulder": (-0.4, 2.0)}
    joints["right_elbow"] = (0.2, 5.0)
    twist = (0.5, 0.0, 2.0, 1.0, 3.0, -2.0)
    return Scene("limp", seconds, spawn=(0.0, 0.0, height, 0.1, 0.0, 0.0), twist=twist, joints=joints, every=every)


def flight(run: Run) -> float:
    """Return the largest change of the energy of a robot with limp arms in 0.8 s of flight [J]."""
    robot = Oracle("limp")
    energies = [robot.energy(look) for look in run(falling(0.8, 0.05, 3.0))]
    return max(abs(energy - energies[0]) for energy in energies)


def landing(run: Run) -> float:
    """Return the largest increase of its energy that a look finds from the fall to lying on the ground [J]."""
    robot = Oracle("limp")
    energies = [robot.energy(look) for look in run(falling(3.0, 0.005, 1.0))]
    return max(0.0, *(after - before for before, after in itertools.pairwise(energies)))


def _heap(run: Run, seconds: float, every: float) -> list[Look]:
    random = np.random.default_rng(5)
    places = [(*map(float, random.uniform(-0.12, 0.12, 2)), 0.15 + 0.25 * k) for k in range(10)]
    things = tuple(Thing(f"box{k}", (0.2, 0.2, 0.2), place, 1.0, mu=0.5) for k, place in enumerate(places))
    return run(Scene("post", seconds, spawn=(0,) * 6, things=things, every=every))


def heap_speed(run: Run) -> float:
    """Return the speed of the fastest of ten boxes, 8 s after they were dropped onto each other [m/s]."""
    return max(math.hypot(*thing.linear) for thing in _heap(run, 8.0, 4.0)[-1].things.values())


def heap_creep(run: Run) -> float:
    """Return how far a box of the heap moves from 8 s to 12 s [m]."""
    looks = _heap(run, 12.0, 4.0)
    return max(distance(pose.position, looks[2].things[name].position) for name, pose in looks[3].things.items())


class Oracle:
    """Pinocchio's model of a robot that moves freely: poses, centre of mass and energy of what an engine shows."""

    def __init__(self, name: str) -> None:
        file = Scene(name, 0.0).file
        self.model = pin.buildModelFromUrdf(str(file), pin.JointModelFreeFlyer())
        self.data = self.model.createData()
        self.mass = pin.computeTotalMass(self.model)

    def put(self, look: Look) -> Any:
        """Compute the poses of joints and the centre of mass; return the velocities."""
        q, v = pin.neutral(self.model), np.zeros(self.model.nv)
        base = look.base
        q[:7] = (*base.position, *base.quaternion)
        turn = pin.Quaternion(np.asarray(base.quaternion, dtype=float)).toRotationMatrix().T
        v[:6] = (*turn @ np.asarray(base.linear), *turn @ np.asarray(base.angular))
        for name, (position, velocity) in look.joints.items():
            joint = self.model.joints[self.model.getJointId(name)]
            turning = joint.nq == 2  # a continuous joint
            q[joint.idx_q : joint.idx_q + joint.nq] = (
                (math.cos(position), math.sin(position)) if turning else (position,)
            )
            v[joint.idx_v] = velocity
        pin.forwardKinematics(self.model, self.data, q, v)
        pin.centerOfMass(self.model, self.data, q)
        return q, v

    def energy(self, look: Look) -> float:
        """Return the sum of kinetic and potential energy [J]."""
        q, v = self.put(look)
        return float(
            pin.computeKineticEnergy(self.model, self.data, q, v) + pin.computePotentialEnergy(self.model, self.data, q)
        )


ROWS = (
    Row("box held by two fingers, 5 s: slip", "0", "m", held, 1e-9, 1e-9),
    Row("box sliding out of a weak grasp", "½·(g − 2μF/m)·t²", "", slipping, 1e-9, 1e-9),
    Row("box lifted with 3 m/s²: slip", "0", "m", lifted, 1e-9, 1e-9),
    Row("box carried by a tray with 3 m/s²: slip", "0", "m", carried, 1e-9, 1e-9),
    Row("box dragged by a faster tray: both ways", "½·μg·t², ½·(F − μmg)/M·t²", "", dragged, 1e-9, 1e-9),
    Row("robot on four legs, 6 s: creep", "0", "m", creep, 1e-9, 1e-9),
    Row("robot on four legs: penetration of a foot", "0", "m", sinking, 1e-9, 1e-9),
    Row("robot on four legs: force of the ground", "m·g = 113.8 N", "", weight, 1e-9, 1e-9),
    Row("robot on four legs: centre of pressure", "below the centre of mass", "m", pressure, 1e-9, 1e-9),
    Row("flight of a robot with limp arms: energy", "constant", "J", flight, 1e-9, 1e-6),
    Row("landing of that robot: gain of energy in 5 ms", "0", "J", landing, 1e-6, 1e-4),
    Row("heap of ten boxes, 8 s: fastest", "0", "m/s", heap_speed, 1e-9, 1e-9),
    Row("heap of ten boxes, 8 to 12 s: creep", "0", "m", heap_creep, 1e-9, 1e-9),
)
