"""The benchmark's scenes in PyBullet, by its own URDF importer."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from tests.bench.peers.scene import DT, GRAVITY, Pose, Running, Scene, Thing


@dataclass(frozen=True, slots=True)
class Settings:
    """How PyBullet is to compute.

    Attributes:
        iterations: of its solver; 50 is its own.
        cone: whether friction has a circular cone, its own, rather than a pyramid.
        sleep: whether what rests may sleep.
    """

    iterations: int = 50
    cone: bool = True
    sleep: bool = False

    def __str__(self) -> str:
        return f"{self.iterations} iterations" + " pyramid" * (not self.cone) + " sleep" * self.sleep


class Pybullet:
    """PyBullet, as a peer to compare with."""

    name, label = "pybullet", "PyBullet"

    def version(self) -> str:
        """Return which PyBullet is installed.

        Raises:
            ImportError: none is.
        """
        with _quiet():
            import pybullet  # noqa: F401 - its own version number is that of the interface
        return version("pybullet")

    def settings(self, scene: Scene) -> Iterator[Settings]:
        """Yield the settings to try."""
        for iterations in (50, 20, 10, 5):
            for cone in (True, False):
                yield Settings(iterations, cone, sleep=scene.sleeps)

    def refined(self, settings: Settings) -> Iterator[Settings]:
        """Yield variations of the fastest settings: there are none."""
        yield from ()

    def build(self, scene: Scene) -> Callable[[Settings], Running]:
        """Return what sets a scene up with given settings."""
        return lambda settings: InPybullet(scene, settings)


class InPybullet(Running):
    """A scene in PyBullet, in a world of its own.

    Its position servo closes a tenth of the gap each step whatever the load, so it does not yield. Many steps in a call
    are sub-steps of the same length.

    Args:
        scene: what to run.
        settings: how to compute.

    Raises:
        ImportError: PyBullet is not installed.
    """

    servo_yields = False

    def __init__(self, scene: Scene, settings: Settings) -> None:
        with _quiet():
            import pybullet
        super().__init__(scene)
        self._p: Any = pybullet
        p = self._p
        self._world = p.connect(p.DIRECT)
        p.setGravity(*GRAVITY, physicsClientId=self._world)
        p.setPhysicsEngineParameter(
            fixedTimeStep=DT,
            numSolverIterations=settings.iterations,
            numSubSteps=0,
            enableConeFriction=settings.cone,
            physicsClientId=self._world,
        )
        self._substeps = 1
        floor = p.createMultiBody(
            0, p.createCollisionShape(p.GEOM_PLANE, physicsClientId=self._world), physicsClientId=self._world
        )
        # Where shapes meet, PyBullet multiplies the frictions.
        p.changeDynamics(floor, -1, lateralFriction=1.0, restitution=0.0, physicsClientId=self._world)
        with tempfile.TemporaryDirectory() as folder:
            self._things = [self._add(thing, Path(folder), settings) for thing in scene.things]
        self._joints: list[dict[str, int]] = []
        self._frames: list[Any] = []
        for body, thing in zip(self._things, scene.things, strict=True):
            self._set_up(body, thing)
        self.pose(0)

    def _add(self, thing: Thing, folder: Path, settings: Settings) -> int:
        p = self._p
        file = folder / "model.urdf"
        file.write_text(thing.urdf, encoding="utf-8")
        flags = p.URDF_USE_INERTIA_FROM_FILE | (p.URDF_ENABLE_SLEEPING if settings.sleep else 0)
        return int(
            p.loadURDF(str(file), list(thing.at), useFixedBase=thing.bolted, flags=flags, physicsClientId=self._world)
        )

    def _set_up(self, body: int, thing: Thing) -> None:
        p, world = self._p, self._world
        joints: dict[str, int] = {}
        links = {p.getBodyInfo(body, physicsClientId=world)[0].decode(): -1}
        for index in range(p.getNumJoints(body, physicsClientId=world)):
            info = p.getJointInfo(body, index, physicsClientId=world)
            joints[info[1].decode()] = index
            links[info[12].decode()] = index
            # What PyBullet adds to what is written: a motor that brakes, and damping.
            p.setJointMotorControl2(body, index, p.VELOCITY_CONTROL, force=0.0, physicsClientId=world)
        for name, index in links.items():
            p.changeDynamics(
                body,
                index,
                lateralFriction=0.0 if name in thing.slippery else 1.0,
                restitution=0.0,
                linearDamping=0.0,
                angularDamping=0.0,
                jointDamping=0.0,
                physicsClientId=world,
            )
        local = p.getDynamicsInfo(body, -1, physicsClientId=world)[3:5]
        self._frames.append(p.invertTransform(*local))
        self._joints.append(joints)
        for joint, (speed, effort) in thing.motors.items():
            p.setJointMotorControl2(
                body, joints[joint], p.VELOCITY_CONTROL, targetVelocity=speed, force=effort, physicsClientId=world
            )
        for joint, angle in (thing.poses[0] if thing.poses else {}).items():
            p.resetJointState(body, joints[joint], angle, physicsClientId=world)

    def many(self, steps: int) -> None:
        """Advance by `steps` as sub-steps of one call."""
        self._divide(steps)
        self._p.stepSimulation(physicsClientId=self._world)

    def one_by_one(self, steps: int) -> None:
        """Advance by `steps`, each a call."""
        self._divide(1)
        step, world = self._p.stepSimulation, self._world
        for _ in range(steps):
            step(physicsClientId=world)

    def _divide(self, steps: int) -> None:
        if steps != self._substeps:
            self._substeps = steps
            self._p.setPhysicsEngineParameter(
                fixedTimeStep=steps * DT, numSubSteps=steps if steps > 1 else 0, physicsClientId=self._world
            )

    def base(self, k: int) -> Pose:
        """Return where the root link of a thing is."""
        p = self._p
        centre = p.getBasePositionAndOrientation(self._things[k], physicsClientId=self._world)
        position, orientation = p.multiplyTransforms(*centre, *self._frames[k])
        return (*position, *orientation)

    def position(self, k: int, joint: str) -> float:
        """Return a joint's position [rad]."""
        return float(self._p.getJointState(self._things[k], self._joints[k][joint], physicsClientId=self._world)[0])

    def set_targets(self, k: int, number: int) -> None:
        """Set the targets of a thing's servos."""
        p, thing, joints = self._p, self.scene.things[k], self._joints[k]
        p.setJointMotorControlArray(
            self._things[k],
            [joints[joint] for joint in thing.servos],
            p.POSITION_CONTROL,
            targetPositions=[thing.poses[number][joint] for joint in thing.servos],
            forces=[servo.effort for servo in thing.servos.values()],
            physicsClientId=self._world,
        )

    def knock(self, k: int, speed: float) -> None:
        """Give a thing a speed along x."""
        self._p.resetBaseVelocity(self._things[k], linearVelocity=[speed, 0.0, 0.0], physicsClientId=self._world)

    def asleep(self) -> int | None:
        """PyBullet does not tell who sleeps."""
        return None

    def close(self) -> None:
        """Let the world go."""
        self._p.disconnect(physicsClientId=self._world)


@contextlib.contextmanager
def _quiet() -> Iterator[None]:
    """Keep to ourselves when PyBullet was built, which it tells whoever imports it."""
    kept = os.dup(2)
    nowhere = os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 2)
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)
        os.close(nowhere)
