"""MuJoCo, on the same URDF: read by its own reader, with a free joint, a ground and the friction it does not read."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np

from fidelity.scene import Ground, Look, Pose, Run, Scene

SETTINGS: dict[str, dict[str, Any]] = {
    "default": {},
    "elliptic": {"cone": "elliptic", "integrator": "implicitfast", "impratio": 10.0},
    "elliptic, noslip": {"cone": "elliptic", "integrator": "implicitfast", "impratio": 10.0, "noslip_iterations": 20},
    "RK4": {"cone": "elliptic", "integrator": "RK4", "impratio": 10.0},
    "stiff": {
        "cone": "elliptic",
        "integrator": "implicitfast",
        "impratio": 100.0,
        "noslip_iterations": 20,
        "hard": True,
    },
}
"""Name → options. Stiff: contacts, limits and dry friction as hard as the step allows (time constant of two steps).

Wheels have velocity actuators of gain 100, and of gain 1 where the integrator would take more to infinity.
"""


def version() -> str:
    """Return MuJoCo's version."""
    return str(mujoco.__version__)


def runner(dt: float, setting: str) -> Run:
    """Return MuJoCo at a step [s] and a setting."""

    def run(scene: Scene) -> list[Look]:
        model = _compile(scene, dt, SETTINGS[setting])
        state = mujoco.MjData(model)
        _start(scene, model, state)
        looks = [_look(scene, model, state)]
        every = scene.every or (0.005 if scene.wheels else scene.seconds)
        steps, total = round(every / dt), [0.0] * len(scene.servos)
        single = bool(scene.servos) or bool(scene.wheels)
        for _ in range(round(scene.seconds / every)):
            for _ in range(steps if single else 1):
                _drive(scene, model, state, total)
                mujoco.mj_step(model, state, nstep=1 if single else steps)
            looks.append(_look(scene, model, state))
        if scene.weighed:
            looks[-1] = replace(looks[-1], ground=Ground.of(_contacts(model, state)))
        return looks

    return run


def _compile(scene: Scene, dt: float, options: dict[str, Any]) -> Any:
    root = ET.fromstring(scene.file.read_text(encoding="utf-8"))
    mu = {block.get("reference"): float(block.findtext("mu1") or 1.0) for block in root.findall("gazebo[mu1]")}
    compiler = ET.SubElement(ET.SubElement(root, "mujoco"), "compiler")
    compiler.attrib.update(fusestatic="false", discardvisual="true", boundmass="0", boundinertia="0")
    for plugin in root.findall("gazebo"):
        root.remove(plugin)
    spec = mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
    hard = {"solref": [2.0 * dt, 1.0], "solimp": [0.999, 0.9999, 0.001, 0.5, 2.0]} if options.get("hard") else {}
    for body in spec.bodies:
        for geom in body.geoms:
            slide = mu.get(body.name, 1.0)
            geom.friction = [max(slide, 1e-5), 0.0, 0.0]  # a coefficient has to be positive
            geom.condim = 1 if slide == 0.0 else 3
            # The robot meets the ground and things, and not itself.
            geom.contype, geom.conaffinity = 2, 1
            geom.priority = 1  # its friction counts, also against things that have more
            _set(geom, hard)
    if not scene.bolted:
        spec.worldbody.first_body().add_freejoint()
    if scene.ground:
        ground = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[100.0, 100.0, 1.0])
        ground.friction, ground.condim = [0.0, 0.0, 0.0], 1  # a pair meets with the larger friction
        ground.contype, ground.conaffinity = 1, 3
        _set(ground, hard)
    for thing in scene.things:
        body = spec.worldbody.add_body(name=thing.name, pos=thing.position)
        body.add_freejoint()
        body.mass, body.inertia, body.ipos, body.explicitinertial = thing.mass, thing.inertia, [0.0] * 3, True
        kind = mujoco.mjtGeom.mjGEOM_BOX if len(thing.size) == 3 else mujoco.mjtGeom.mjGEOM_SPHERE
        size = [s / 2 for s in thing.size] if len(thing.size) == 3 else [thing.size[0], 0.0, 0.0]
        geom = body.add_geom(type=kind, size=size, friction=[thing.mu, 0.0, 0.0], contype=3, conaffinity=3)
        _set(geom, hard)
    for joint in spec.joints:
        if hard and joint.type != mujoco.mjtJoint.mjJNT_FREE:
            joint.solref_limit = joint.solref_friction = hard["solref"]
            joint.solimp_limit = joint.solimp_friction = hard["solimp"]
        joint.actfrclimited = False
    for mimic in root.findall("joint/mimic"):
        name = next(j.get("name") for j in root.findall("joint") if j.find("mimic") is mimic)
        data = [float(mimic.get("offset", 0)), float(mimic.get("multiplier", 1)), *[0.0] * 10]
        equal = spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=name, name2=mimic.get("joint"), data=data)
        equal.objtype = mujoco.mjtObj.mjOBJ_JOINT
        if hard:
            equal.solref, equal.solimp = hard["solref"], hard["solimp"]
    for joint in scene.wheels:
        actuator = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.set_to_velocity(kv=100.0 if options.get("integrator") == "implicitfast" else 1.0)
    option = spec.option
    option.timestep, option.gravity = dt, scene.gravity
    if "cone" in options:
        option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    if "integrator" in options:
        option.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{options['integrator'].upper()}")
    option.impratio = options.get("impratio", 1.0)
    option.noslip_iterations = options.get("noslip_iterations", 0)
    return spec.compile()


def _contacts(model: Any, state: Any) -> Iterator[tuple[Any, Any]]:
    """Yield position and force on the robot of each contact with the ground."""
    for k in range(state.ncon):
        contact, wrench = state.contact[k], np.zeros(6)
        mujoco.mj_contactForce(model, state, k, wrench)
        force = contact.frame.reshape(3, 3).T @ wrench[:3]
        yield contact.pos.copy(), force if model.geom_bodyid[contact.geom2] != 0 else -force


def _set(geom: Any, hard: dict[str, Any]) -> None:
    if hard:
        geom.solref, geom.solimp = hard["solref"], hard["solimp"]


def _start(scene: Scene, model: Any, state: Any) -> None:
    if not scene.bolted:
        state.qpos[:3], state.qpos[3:7] = scene.spawn[:3], _quaternion(scene.spawn[3:])
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, state.qpos[3:7])
        state.qvel[:3], state.qvel[3:6] = scene.twist[:3], rotation.reshape(3, 3).T @ scene.twist[3:]
    for name, (position, velocity) in scene.joints.items():
        joint = model.joint(name)
        state.qpos[joint.qposadr[0]], state.qvel[joint.dofadr[0]] = position, velocity
    mujoco.mj_forward(model, state)


def _quaternion(rpy: Any) -> Any:
    """Return w x y z of fixed-axis angles."""
    quaternion = np.zeros(4)
    mujoco.mju_euler2Quat(quaternion, np.asarray(rpy, dtype=float), "XYZ")
    return quaternion


def _drive(scene: Scene, model: Any, state: Any, total: list[float]) -> None:
    if scene.wheels:
        share = min(1.0, (state.time + 0.5 * model.opt.timestep) / scene.ramp) if scene.ramp else 1.0
        for name, speed in scene.wheels.items():
            state.actuator(name).ctrl[0] = share * speed
    for name, effort in scene.efforts.items():
        state.joint(name).qfrc_applied[0] = effort
    for k, (name, (p, i, d, target)) in enumerate(scene.servos.items()):
        joint = state.joint(name)
        error = target - joint.qpos[0]
        total[k] += error * model.opt.timestep
        joint.qfrc_applied[0] = p * error + i * total[k] - d * joint.qvel[0]
    if scene.push is not None:
        state.body(scene.push[0]).xfrc_applied[0] = scene.push[1]


def _look(scene: Scene, model: Any, state: Any) -> Look:
    mujoco.mj_kinematics(model, state)
    root = model.body(1).name
    joints = {}
    for k in range(model.njnt):
        if model.jnt_type[k] != mujoco.mjtJoint.mjJNT_FREE:
            joint = model.joint(k)
            joints[joint.name] = (float(state.qpos[joint.qposadr[0]]), float(state.qvel[joint.dofadr[0]]))
    things = {thing.name: _pose(model, state, thing.name) for thing in scene.things}
    return Look(state.time, _pose(model, state, root), joints, things)


def _pose(model: Any, state: Any, name: str) -> Pose:
    body = model.body(name)
    quaternion = state.body(name).xquat
    if body.dofnum[0] != 6:
        return Pose(state.body(name).xpos.copy(), (*quaternion[1:], quaternion[0]))
    first = body.dofadr[0]
    rotation = state.body(name).xmat.reshape(3, 3)
    linear, angular = state.qvel[first : first + 3].copy(), rotation @ state.qvel[first + 3 : first + 6]
    return Pose(state.body(name).xpos.copy(), (*quaternion[1:].tolist(), float(quaternion[0])), linear, angular)
