"""Our engine: through the command line where a scene can be said there and only the end counts, else `Simulator`."""

from __future__ import annotations

import contextlib
import io
import json
import tempfile
from dataclasses import replace
from pathlib import Path

from fidelity.scene import Ground, Look, Pose, Run, Scene
from urdfkit.cli import main
from urdfkit.sim import Simulator, Spawn


def runner(dt: float) -> Run:
    """Return our engine at a step [s]."""

    def run(scene: Scene) -> list[Look]:
        with tempfile.TemporaryDirectory() as folder:
            world = _world(scene, Path(folder))
            if (
                scene.every is None
                and not scene.weighed
                and not scene.efforts
                and scene.push is None
                and (command := arguments(scene, world))
            ):
                return [_report(command, dt)]
            return _watch(scene, world, dt)

    return run


def arguments(scene: Scene, world: str) -> list[str]:
    """Return what to type after ``urdfkit``, without step and output."""

    def row(numbers: object) -> str:
        return ",".join(repr(float(number)) for number in numbers)  # type: ignore[attr-defined]

    command = ["sim", "run", str(scene.file), "--world", world, "--for", repr(scene.seconds)]
    command += ["--gravity", row(scene.gravity)]
    if not scene.bolted:
        command += ["--spawn", row(scene.spawn)]
    if any(scene.twist):
        command += ["--initial-twist", row(scene.twist)]
    if scene.joints:
        command += ["--initial-joints", ",".join(f"{name}={q!r}:{v!r}" for name, (q, v) in scene.joints.items())]
    if scene.command is not None:
        command += ["--cmd-vel", row((scene.command[0], 0.0, scene.command[1]))]
        if scene.ramp:
            command += ["--cmd-ramp", repr(scene.ramp)]
    return command


def _report(command: list[str], dt: float) -> Look:
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        code = main([*command, "--dt", repr(dt), "--json", "--quiet"])
    if code != 0:
        raise RuntimeError(f"urdfkit {' '.join(command)} ended with {code}")
    report = json.loads(out.getvalue())
    base = report["base"]
    odometry = None
    for estimate in report["odometry"].values():
        odometry = (*estimate["position"][:2], Pose(estimate["position"], estimate["quaternion"]).yaw)
    return Look(
        report["duration"],
        Pose(base["position"], base["quaternion"], base["linear_velocity"], base["angular_velocity"]),
        {name: (joint["position"], joint["velocity"]) for name, joint in report["joints"].items()},
        {name: Pose(body["position"], body["quaternion"]) for name, body in report["bodies"].items()},
        odometry,
    )


def _watch(scene: Scene, world: str, dt: float) -> list[Look]:
    spawn = Spawn(
        *(() if scene.bolted else scene.spawn),
        **({"z": 0.0} if scene.bolted else {}),
        twist=tuple(scene.twist),
        joints={name: q for name, (q, _) in scene.joints.items()},
        velocities={name: v for name, (_, v) in scene.joints.items()},
    )
    simulator = Simulator(scene.file, world=world, dt=dt, gravity=scene.gravity, spawn=spawn, note=lambda text: None)
    for joint, effort in scene.efforts.items():
        simulator.motors.exert(joint, effort)
    if scene.push is not None:
        simulator.world.bodies[scene.push[0]].push((scene.push[1], 0.0, 0.0))
    if scene.command is not None:
        raise ValueError("a scene with a command is run from the command line")
    looks = [_look(simulator)]
    steps = round((scene.every or scene.seconds) / dt)
    for _ in range(round(scene.seconds / dt / steps)):
        simulator.step(steps)
        looks.append(_look(simulator))
    if scene.weighed:
        touching = [(contact.position, contact.force) for contact in simulator.state.contacts]
        looks[-1] = replace(looks[-1], ground=Ground.of(touching))
    return looks


def _look(simulator: Simulator) -> Look:
    state = simulator.state
    pose, twist = state.base_pose, state.base_velocity
    names = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
    things = {}
    for name, body in simulator.world.bodies.items():
        things[name] = Pose(body.pose[:3], body.pose[3:], body.twist[:3], body.twist[3:])
    return Look(
        state.t,
        Pose(pose[:3], pose[3:], twist[:3], twist[3:]),
        {name: (state.position(name), state.velocity(name)) for name in names},
        things,
    )


def _world(scene: Scene, folder: Path) -> str:
    """Return the world of a scene: one that we ship, or a file that is written."""
    if not scene.things:
        return "empty" if scene.ground else "void"
    text = '<sdf version="1.9"><world name="scene">'
    if scene.ground:
        text += "<include><uri>model://ground_plane</uri></include>"
    for thing in scene.things:
        size = " ".join(map(repr, thing.size))
        shape = (
            f"<box><size>{size}</size></box>" if len(thing.size) == 3 else f"<sphere><radius>{size}</radius></sphere>"
        )
        xx, yy, zz = thing.inertia
        text += (
            f'<model name="{thing.name}"><pose>{" ".join(map(repr, thing.position))} 0 0 0</pose><link name="link">'
            f"<inertial><mass>{thing.mass}</mass><inertia><ixx>{xx!r}</ixx><iyy>{yy!r}</iyy><izz>{zz!r}</izz>"
            "<ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>"
            f'<collision name="shape"><geometry>{shape}</geometry><surface><friction><ode><mu>{thing.mu}</mu>'
            f"<mu2>{thing.mu}</mu2></ode></friction></surface></collision></link></model>"
        )
    file = folder / "scene.world"
    file.write_text(text + "</world></sdf>", encoding="utf-8")
    return str(file)
