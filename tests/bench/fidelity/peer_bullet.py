"""PyBullet, on the same URDF, with the default motors and dampings that it adds of its own taken away."""

from __future__ import annotations

import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pybullet as p

from fidelity.scene import Ground, Look, Pose, Run, Scene

SETTINGS: dict[str, dict[str, Any]] = {
    "default": {},
    "500 iterations": {"numSolverIterations": 500, "solverResidualThreshold": 0.0},
}
"""Name → parameters of its engine."""


def version() -> str:
    """Return PyBullet's version."""
    from importlib.metadata import version as of

    return of("pybullet")


def runner(dt: float, setting: str) -> Run:
    """Return PyBullet at a step [s] and a setting."""

    def run(scene: Scene) -> list[Look]:
        client = p.connect(p.DIRECT)
        try:
            return _Bullet(client, scene, dt, SETTINGS[setting]).run()
        finally:
            p.disconnect(client)

    return run


class _Bullet:
    def __init__(self, client: int, scene: Scene, dt: float, options: dict[str, Any]) -> None:
        self.scene, self.dt, self.client = scene, dt, {"physicsClientId": client}
        at = self.client
        p.setGravity(*scene.gravity, **at)
        p.setPhysicsEngineParameter(fixedTimeStep=dt, numSubSteps=0, **options, **at)
        root = ET.fromstring(scene.file.read_text(encoding="utf-8"))
        mu = {block.get("reference"): float(block.findtext("mu1") or 1.0) for block in root.findall("gazebo[mu1]")}
        self.body = self._load(root)
        self.joints: dict[str, int] = {}
        for index in range(-1, p.getNumJoints(self.body, **at)):
            name = root.findall("link")[0].get("name")
            if index >= 0:
                joint = p.getJointInfo(self.body, index, **at)
                name = joint[12].decode()
                if joint[2] != p.JOINT_FIXED:
                    self.joints[joint[1].decode()] = index
                    # Its default motor acts as dry friction; this one is the model's.
                    p.setJointMotorControl2(self.body, index, p.VELOCITY_CONTROL, force=joint[7], **at)
            p.changeDynamics(self.body, index, lateralFriction=mu.get(name, 1.0), **at)
            p.changeDynamics(self.body, index, linearDamping=0.0, angularDamping=0.0, **at)
            p.changeDynamics(self.body, index, maxJointVelocity=1e6, **at)
        if scene.ground:
            plane = p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE, **at), **at)
            p.changeDynamics(plane, -1, lateralFriction=1.0, **at)  # a pair meets with the product
        self.things = {thing.name: self._thing(thing) for thing in scene.things}
        self.total = [0.0] * len(scene.servos)
        self._start()

    def _load(self, root: ET.Element) -> int:
        with tempfile.TemporaryDirectory() as folder:
            for plugin in root.findall("gazebo"):
                root.remove(plugin)
            file = Path(folder) / "model.urdf"
            file.write_text(ET.tostring(root, encoding="unicode"), encoding="utf-8")
            flags = p.URDF_USE_INERTIA_FROM_FILE
            return int(p.loadURDF(str(file), useFixedBase=self.scene.bolted, flags=flags, **self.client))

    def _thing(self, thing: Any) -> int:
        at = self.client
        if len(thing.size) == 3:
            shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=[s / 2 for s in thing.size], **at)
        else:
            shape = p.createCollisionShape(p.GEOM_SPHERE, radius=thing.size[0], **at)
        body = int(p.createMultiBody(thing.mass, shape, basePosition=thing.position, **at))
        p.changeDynamics(body, -1, localInertiaDiagonal=thing.inertia, lateralFriction=thing.mu, **at)
        p.changeDynamics(body, -1, linearDamping=0.0, angularDamping=0.0, **at)
        return body

    def _start(self) -> None:
        scene, at = self.scene, self.client
        if not scene.bolted:
            rotation = p.getQuaternionFromEuler(scene.spawn[3:])
            centre = p.getDynamicsInfo(self.body, -1, **at)[3:5]
            position, rotation = p.multiplyTransforms(scene.spawn[:3], rotation, *centre)
            p.resetBasePositionAndOrientation(self.body, position, rotation, **at)
            p.resetBaseVelocity(self.body, scene.twist[:3], scene.twist[3:], **at)
        for name, (position, velocity) in scene.joints.items():
            p.resetJointState(self.body, self.joints[name], position, velocity, **at)

    def run(self) -> list[Look]:
        scene, looks = self.scene, [self._look(0.0)]
        every = scene.every or (0.005 if scene.wheels else scene.seconds)
        steps = round(every / self.dt)
        for k in range(round(scene.seconds / every)):
            for i in range(steps):
                self._drive((k * steps + i) * self.dt)
                p.stepSimulation(**self.client)
            looks.append(self._look((k + 1) * steps * self.dt))
        if scene.weighed:
            looks[-1] = replace(looks[-1], ground=Ground.of(self._contacts()))
        return looks

    def _contacts(self) -> Iterator[tuple[Any, Any]]:
        """Yield position and force on the robot of each contact."""
        for contact in p.getContactPoints(self.body, **self.client):
            normal, size, first, along, second, across = contact[7], *contact[9:14]
            yield contact[5], [size * n + first * a + second * b for n, a, b in zip(normal, along, across, strict=True)]

    def _drive(self, t: float) -> None:
        scene, at = self.scene, self.client
        for name, speed in scene.wheels.items():
            share = min(1.0, (t + 0.5 * self.dt) / scene.ramp) if scene.ramp else 1.0
            joint, target = self.joints[name], share * speed
            p.setJointMotorControl2(self.body, joint, p.VELOCITY_CONTROL, targetVelocity=target, force=1e3, **at)
        for name, effort in scene.efforts.items():
            p.setJointMotorControl2(self.body, self.joints[name], p.TORQUE_CONTROL, force=effort, **at)
        for k, (name, (stiffness, i, d, target)) in enumerate(scene.servos.items()):
            position, velocity = p.getJointState(self.body, self.joints[name], **at)[:2]
            self.total[k] += (target - position) * self.dt
            effort = stiffness * (target - position) + i * self.total[k] - d * velocity
            p.setJointMotorControl2(self.body, self.joints[name], p.TORQUE_CONTROL, force=effort, **at)
        if scene.push is not None:
            body = self.things[scene.push[0]]
            position = p.getBasePositionAndOrientation(body, **at)[0]
            p.applyExternalForce(body, -1, (scene.push[1], 0.0, 0.0), position, p.WORLD_FRAME, **at)

    def _look(self, t: float) -> Look:
        joints = {name: tuple(p.getJointState(self.body, k, **self.client)[:2]) for name, k in self.joints.items()}
        things = {name: self._pose(body) for name, body in self.things.items()}
        return Look(t, self._pose(self.body), joints, things)

    def _pose(self, body: int) -> Pose:
        at = self.client
        position, rotation = p.getBasePositionAndOrientation(body, **at)
        linear, angular = p.getBaseVelocity(body, **at)
        centre = p.invertTransform(*p.getDynamicsInfo(body, -1, **at)[3:5])
        position, rotation = p.multiplyTransforms(position, rotation, *centre)
        return Pose(position, rotation, linear, angular)
