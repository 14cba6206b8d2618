"""Steps per CPU second of the engine beside MuJoCo and PyBullet on the same scenes.

Run it: ``python tests/bench/bench_sim.py [--seconds 2] [--rounds 3] [--json]``. Every engine gets the same model, step
and targets; the engines take turns, and the best round of each counts, because other programs only ever take time away.
MuJoCo runs at its fastest settings for these scenes (implicitfast, Newton, pyramidal cone), with many steps a call too;
PyBullet has no such call.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.scene import scene_of
from urdfkit.sim.engine import Engine, Surface, warmup

Run = Callable[[int], None]

WHEEL = """<link name="{side}"><inertial><mass value="0.4"/><inertia ixx="0.0005" iyy="0.0005" izz="0.0009" ixy="0"
ixz="0" iyz="0"/></inertial><collision><geometry><cylinder radius="0.06" length="0.03"/></geometry></collision></link>
<joint name="{side}_wheel" type="continuous"><origin xyz="0 {y} 0" rpy="-1.5707963267948966 0 0"/><parent link="base"/>
<child link="{side}"/><axis xyz="0 0 1"/></joint>"""

DIFF_DRIVE = f"""<robot name="diff_drive"><link name="base"><inertial><origin xyz="0.04 0 0.01"/><mass value="5"/>
<inertia ixx="0.05" iyy="0.07" izz="0.09" ixy="0" ixz="0" iyz="0"/></inertial><collision><origin xyz="0 0 0.03"/>
<geometry><box size="0.3 0.2 0.05"/></geometry></collision><collision><origin xyz="0.12 0 -0.03"/><geometry><sphere
radius="0.03"/></geometry></collision></link>{WHEEL.format(side="left", y=0.15)}{WHEEL.format(side="right", y=-0.15)}
</robot>"""

LINK = """<link name="l{k}"><inertial><origin xyz="0.01 0.02 0.1"/><mass value="1"/><inertia ixx="0.004" iyy="0.0045"
izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link><joint name="j{k}" type="revolute"><origin xyz="0 0 {z}"/>
<parent link="{parent}"/><child link="l{k}"/><axis xyz="{axis}"/><limit lower="-2.9" upper="2.9" effort="200"
velocity="10"/></joint>"""

ARM = (
    '<robot name="arm"><link name="base"/>'
    + "".join(
        LINK.format(k=k, z=0.2 if k else 0, parent=f"l{k - 1}" if k else "base", axis="0 1 0" if k % 2 else "0 0 1")
        for k in range(7)
    )
    + "</robot>"
)

BOX = """<robot name="box"><link name="base"><inertial><mass value="2"/><inertia ixx="0.0166667" iyy="0.00833333"
izz="0.0216667" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry><box size="0.2 0.3 0.1"/></geometry>
</collision></link></robot>"""

TARGET = np.array([0.3, 0.8, -0.4, 1.0, 0.2, -0.7, 0.5])
KP, KD = 2000.0, 60.0
SPEEDS = (7.0, 9.0)


def ours(scene: str, text: str, folder: Path, *, chunk: int) -> Run:
    """Return a runner of the engine."""
    path = folder / f"{scene}.urdf"
    path.write_text(text)
    robot = load(path)
    kinematics = Kinematics(robot, floating_base=scene != "arm")
    engine = Engine(
        kinematics, scene_of(robot).shapes, surfaces={"base": Surface(0, 0)} if scene == "diff_drive" else {}
    )
    q = kinematics.neutral()
    if scene != "arm":
        q[2] = {"diff_drive": 0.06, "box": 0.05}[scene]
    engine.reset(q)
    if scene == "diff_drive":
        engine.motor_velocity[6:], engine.motor_effort[6:] = SPEEDS, 1.0
    if scene == "arm":
        engine.kp[:], engine.kd[:], engine.position_target[:] = KP, KD, TARGET

    def run(steps: int) -> None:
        for _ in range(steps // chunk):
            engine.step(chunk)

    return run


def mujoco_model(scene: str) -> tuple[Any, Any]:
    """Return MuJoCo's model and state of a scene."""
    import mujoco

    head = (
        '<mujoco><option timestep="0.001" integrator="implicitfast" solver="Newton" cone="pyramidal"/>'
        '<default><geom density="0"/></default><worldbody>'
    )
    plane = '<geom type="plane" size="50 50 1" friction="1 0.005 0.0001"/>'
    wheel = (
        '<body pos="0 {y} 0" euler="-90 0 0"><joint name="{n}" axis="0 0 1"/><inertial pos="0 0 0" mass="0.4" '
        'diaginertia="0.0005 0.0005 0.0009"/>'
        '<geom type="cylinder" size="0.06 0.015" contype="2" conaffinity="1"/></body>'
    )
    if scene == "diff_drive":
        text = (
            head + plane + '<body pos="0 0 0.06"><freejoint/><inertial pos="0.04 0 0.01" mass="5" '
            'diaginertia="0.05 0.07 0.09"/><geom type="box" size="0.15 0.1 0.025" pos="0 0 0.03" contype="2"/>'
            '<geom type="sphere" size="0.03" pos="0.12 0 -0.03" contype="2" condim="1" priority="1"/>'
            + wheel.format(y=0.15, n="left")
            + wheel.format(y=-0.15, n="right")
            + "</body></worldbody><actuator>"
            + "".join(f'<velocity joint="{n}" kv="1" forcerange="-1 1"/>' for n in ("left", "right"))
            + "</actuator></mujoco>"
        )
    elif scene == "arm":
        text = head
        for k in range(7):
            axis = "0 1 0" if k % 2 else "0 0 1"
            text += (
                f'<body pos="0 0 {0.2 if k else 0}"><joint name="j{k}" axis="{axis}" limited="true" range="-166 166"/>'
                '<inertial pos="0.01 0.02 0.1" mass="1" diaginertia="0.004 0.0045 0.001"/>'
            )
        text += "</body>" * 7 + "</worldbody><actuator>"
        text += "".join(f'<position joint="j{k}" kp="{KP}" kv="{KD}"/>' for k in range(7)) + "</actuator></mujoco>"
    else:
        text = (
            head + plane + '<body pos="0 0 0.05"><freejoint/><inertial pos="0 0 0" mass="2" '
            'diaginertia="0.0166667 0.00833333 0.0216667"/><geom type="box" size="0.1 0.15 0.05"/></body>'
            "</worldbody></mujoco>"
        )
    model = mujoco.MjModel.from_xml_string(text)
    state = mujoco.MjData(model)
    if scene == "diff_drive":
        state.ctrl[:] = SPEEDS
    if scene == "arm":
        state.ctrl[:] = TARGET
    return model, state


def mujoco_runner(scene: str, *, chunk: int) -> Run:
    """Return a runner of MuJoCo."""
    import mujoco

    model, state = mujoco_model(scene)

    def run(steps: int) -> None:
        for _ in range(steps // chunk):
            mujoco.mj_step(model, state, nstep=chunk)

    return run


def pybullet_runner(scene: str, text: str, folder: Path) -> Run:
    """Return a runner of PyBullet."""
    import pybullet as p

    client = p.connect(p.DIRECT)
    p.setGravity(0, 0, -9.81, physicsClientId=client)
    p.setTimeStep(0.001, physicsClientId=client)
    path = folder / f"{scene}_bullet.urdf"
    path.write_text(text)
    if scene != "arm":
        p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client), physicsClientId=client)
    height = {"diff_drive": 0.06, "box": 0.05}.get(scene, 0.0)
    flags = p.URDF_USE_INERTIA_FROM_FILE
    body = p.loadURDF(str(path), [0, 0, height], useFixedBase=scene == "arm", flags=flags, physicsClientId=client)
    if scene == "diff_drive":
        for joint, speed in enumerate(SPEEDS):
            p.setJointMotorControl2(
                body, joint, p.VELOCITY_CONTROL, targetVelocity=speed, force=1.0, physicsClientId=client
            )
        p.changeDynamics(body, -1, lateralFriction=0.0, physicsClientId=client)
    if scene == "arm":
        for joint, position in enumerate(TARGET):
            p.setJointMotorControl2(
                body, joint, p.POSITION_CONTROL, targetPosition=position, force=1e4, physicsClientId=client
            )

    def run(steps: int) -> None:
        for _ in range(steps):
            p.stepSimulation(physicsClientId=client)

    return run


def rate(run: Run, seconds: float) -> float:
    """Return steps per CPU second over about `seconds`."""
    steps, start = 0, time.process_time()
    while (spent := time.process_time() - start) < seconds:
        run(1000)
        steps += 1000
    return steps / spent


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--seconds", type=float, default=1.0, help="CPU seconds per engine and round")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    warmup()
    table: dict[str, dict[str, float]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for scene, text in (("diff_drive", DIFF_DRIVE), ("arm", ARM), ("box", BOX)):
            runners: dict[str, Run] = {
                "urdfkit, 1000 steps a call": ours(scene, text, folder, chunk=1000),
                "urdfkit, 10 steps a call": ours(scene, text, folder, chunk=10),
                "urdfkit, 1 step a call": ours(scene, text, folder, chunk=1),
            }
            try:
                runners["mujoco, 1000 steps a call"] = mujoco_runner(scene, chunk=1000)
                runners["mujoco, 1 step a call"] = mujoco_runner(scene, chunk=1)
            except ImportError:
                print("mujoco is not installed", file=sys.stderr)
            try:
                runners["pybullet"] = pybullet_runner(scene, text, folder)
            except ImportError:
                print("pybullet is not installed", file=sys.stderr)
            best = dict.fromkeys(runners, 0.0)
            for _ in range(options.rounds):
                for engine, run in runners.items():
                    best[engine] = max(best[engine], rate(run, options.seconds))
            table[scene] = best
            base = best.get("mujoco, 1000 steps a call", math.nan)
            if not options.json:
                for engine, value in best.items():
                    print(
                        f"{scene:12s} {engine:28s} {value / 1000:8.0f}k steps/s  {value / base:6.2f} × mujoco",
                        flush=True,
                    )
    if options.json:
        print(json.dumps(table, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main())
