"""Speed of `urdfkit sim run`, with plugins and topics, compared with MuJoCo: `python -m tests.bench.peers.sim_run`.

Each command drives a scene of the benchmark by the drive plugins and options that a user types. The engines run
alternately in one process, MuJoCo at its best correct settings. Time is CPU seconds without loading.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median

from tests.bench.peers.mujoco_scene import Mujoco
from tests.bench.peers.peer_engines import choose
from tests.bench.peers.scene import DT, Pose, Running, Scene
from tests.bench.peers.scenes import (
    ARM_ENDS,
    ARM_JOINTS,
    CAR_RADIUS,
    CAR_SPEED,
    DIFF_MOTION,
    MANIPULATOR_MOTION,
    SCENES,
)
from tests.bench.peers.simulator_scene import SLIPPERY
from tests.bench.peers.urdf_models import joint, link, robot
from urdfkit.cli.sim import run_command
from urdfkit.cli.sim.run_options import run_options_of

HOLD = ",".join(f"{name}={angle}" for name, angle in zip(ARM_JOINTS, ARM_ENDS[0], strict=True))
JOINT_STATES = '<plugin filename="gz-sim-joint-state-publisher-system" name="gz::sim::systems::JointStatePublisher"/>'


def diff_drive(separation: float, radius: float, torque: float) -> str:
    """Return the plugin of a differential drive as robots of ROS 1 have it: 100 Hz, encoders, joint states."""
    return (
        '<plugin name="drive" filename="libgazebo_ros_diff_drive.so"><leftJoint>left_wheel_joint</leftJoint>'
        f"<rightJoint>right_wheel_joint</rightJoint><wheelSeparation>{separation}</wheelSeparation>"
        f"<wheelDiameter>{2 * radius}</wheelDiameter><wheelTorque>{torque}</wheelTorque><updateRate>100</updateRate>"
        "<odometrySource>encoder</odometrySource><publishWheelJointState>true</publishWheelJointState></plugin>"
    )


def gz_drive(system: str, *parameters: str) -> str:
    """Return a drive of gz sim, and the joint state publisher, which publishes in every step."""
    name = f"gz-sim-{system}-system"
    kind = "".join(word.capitalize() for word in system.split("-"))
    return f'<plugin filename="{name}" name="gz::sim::systems::{kind}">{"".join(parameters)}</plugin>{JOINT_STATES}'


def tags(**values: object) -> str:
    """Return one element per value, several for a tuple."""
    pairs = ((tag, each) for tag, value in values.items() for each in (value if isinstance(value, tuple) else (value,)))
    return "".join(f"<{tag}>{value}</{tag}>" for tag, value in pairs)


@dataclass(frozen=True, slots=True)
class Typed:
    """A command line and the scene that it runs.

    Attributes:
        scene: name of the benchmark's scene.
        words: options of `sim run`.
        plugins: Gazebo plugins of the robot.
        target: how many times the speed of MuJoCo it should have.
    """

    scene: str
    words: tuple[str, ...]
    plugins: str
    target: float


COMMANDS = {
    "diff drive": Typed(
        "diff-drive", ("--cmd-vel", f"{DIFF_MOTION[0]},0,{DIFF_MOTION[1]}"), diff_drive(0.3, 0.06, 1.0), 3.0
    ),
    "skid": Typed(
        "skid-steer",
        ("--cmd-vel", "0,0,1.2"),
        gz_drive(
            "diff-drive",
            tags(
                left_joint=("front_left_wheel_joint", "rear_left_wheel_joint"),
                right_joint=("front_right_wheel_joint", "rear_right_wheel_joint"),
                wheel_separation=0.4,
                wheel_radius=0.08,
            ),
        ),
        2.0,
    ),
    "car": Typed(
        "ackermann",
        ("--cmd-vel", f"{CAR_SPEED},0,{CAR_SPEED / CAR_RADIUS}"),
        gz_drive(
            "ackermann-steering",
            tags(
                left_joint="rear_left_wheel_joint",
                right_joint="rear_right_wheel_joint",
                left_steering_joint="left_steering",
                right_steering_joint="right_steering",
                wheel_separation=0.5,
                kingpin_width=0.5,
                wheel_base=0.6,
                wheel_radius=0.1,
                steering_limit=0.6,
                steer_p_gain=5,
            ),
        ),
        2.0,
    ),
    "mobile manipulator": Typed(
        "mobile-manipulator",
        ("--cmd-vel", f"{MANIPULATOR_MOTION[0]},0,{MANIPULATOR_MOTION[1]}", "--joint-target", HOLD),
        diff_drive(0.5, 0.1, 10.0),
        2.2,
    ),
    "arm": Typed("arm", ("--joint-target", HOLD, "--fixed-base"), "", 3.5),
}
"""Name → what is typed."""


def standing(typed: Typed) -> Scene:
    """Return the scene of a command: as in the benchmark, but arms go to one pose and stay there."""
    scene = next(each for each in SCENES if each.name == typed.scene)
    things = tuple(replace(thing, poses=thing.poses[:1]) for thing in scene.things)
    return replace(scene, things=things, turn=0.0)


class InSimRun(Running):
    """A scene as `urdfkit sim run` simulates it.

    Args:
        typed: the command.
    """

    servo_yields = False

    def __init__(self, typed: Typed) -> None:
        super().__init__(standing(typed))
        (thing,) = self.scene.things
        parser = argparse.ArgumentParser()
        parser.add_argument("--quiet", action="store_true")
        run_command.configure(parser)
        blocks = f"<gazebo>{typed.plugins}</gazebo>" + "".join(SLIPPERY.format(name) for name in thing.slippery)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "model.urdf"
            path.write_text(thing.urdf.replace("</robot>", f"{blocks}</robot>"), encoding="utf-8")
            spawn = ",".join(map(str, (*thing.at, 0.0)))
            arguments = parser.parse_args([str(path), "--quiet", "--for", "1", "--spawn", spawn, *typed.words])
            options = run_options_of(arguments)
            self.simulator = run_command.load(arguments, options)
            options.schedule(self.simulator)
        # Both engines stay awake, also where the arm rests at its goal.
        self.simulator.world.builder.engine.arrays["sleeps"][:] = 0

    def many(self, steps: int) -> None:
        """Advance by `steps` in one call."""
        self.simulator.step(steps)

    def one_by_one(self, steps: int) -> None:
        """Advance by `steps`, each a call."""
        for _ in range(steps):
            self.simulator.step()

    def base(self, k: int) -> Pose:
        """Return where the robot's root link is."""
        return self.simulator.state.base_pose

    def position(self, k: int, joint: str) -> float:
        """Return a joint's position [rad]."""
        return self.simulator.state.position(joint)

    def set_targets(self, k: int, number: int) -> None:
        """Set no targets: they are options of the command."""

    def knock(self, k: int, speed: float) -> None:
        """Knock nothing: only boxes are knocked."""

    def asleep(self) -> int | None:
        """Return None: the robot is kept awake."""
        return None


def speed(running: Running, seconds: float) -> float:
    """Return steps per CPU second, with as many steps a call as `sim run` makes."""
    chunk, start, steps = round(run_command.CHUNK / DT), time.process_time(), 0
    while time.process_time() - start < seconds:
        running.many(chunk)
        steps += chunk
    return steps / (time.process_time() - start)


def ratios(typed: Typed, *, seconds: float, rounds: int) -> tuple[float, float, float, str]:
    """Return steps per CPU second of both engines, the median of the ratios, and remarks."""
    scene, peer = standing(typed), Mujoco()
    settings = choose(peer, scene).best.settings
    ours, theirs = InSimRun(typed), peer.build(scene)(settings)
    wrong = [f"{check.what} {check.value:.4g}" for run in (ours, theirs) for check in scene.check(run) if not check.ok]
    pairs = []
    for k in range(rounds):
        turn = [ours, theirs] if k % 2 else [theirs, ours]
        found = {running: speed(running, seconds) for running in turn}
        pairs.append((found[ours], found[theirs]))
    remarks = f"{settings}{'; WRONG: ' * bool(wrong)}{', '.join(wrong)}"
    return *(median(column) for column in zip(*pairs, strict=True)), median(a / b for a, b in pairs), remarks


def chain(joints: int) -> str:
    """Return an arm of so many joints about the vertical axis, each with a link of 0.1 m."""
    parts = [link("base", 1.0, "0.01 0.01 0.01")]
    for k in range(joints):
        parts.append(link(f"link{k}", 0.5, "0.001 0.001 0.001", at="0 0 0.05"))
        parent, place = (f"link{k - 1}", "0 0 0.1") if k else ("base", "0 0 0")
        parts.append(joint(f"joint{k}", parent, f"link{k}", place, axis="0 0 1" if k % 2 else "0 1 0"))
    return robot("chain", *parts)


def reading(*, rounds: int) -> dict[str, float]:
    """Return CPU time [µs] of ten steps and all poses of 12 joints, and of all poses of 20 links."""
    from tests.bench.peers.parsed_urdf import read
    from urdfkit.sim.simulator import Simulator

    def measured(simulator: Simulator, call: Callable[[], object]) -> float:
        found = []
        for _ in range(rounds):
            start = time.process_time()
            for _ in range(2000):
                call()
            found.append((time.process_time() - start) / 2000 * 1e6)
        return median(found)

    twelve, twenty = (Simulator(read(chain(joints)), fixed_base=True) for joints in (12, 19))
    for simulator in (twelve, twenty):
        for name in simulator.kinematics.joint_names:
            simulator.motors.servo(name, stiffness=50.0, damping=2.0)

    def steps_and_reads() -> None:
        twelve.step(10)
        _ = twelve.state.q, twelve.state.v, twelve.link_poses()

    def moved_poses() -> None:
        twenty.state.advance(0)  # discards the stored poses
        twenty.link_poses()

    steps_and_reads(), moved_poses()
    return {
        "10 steps, q, v and all poses of 12 joints": measured(twelve, steps_and_reads),
        "all link poses of 20 links": measured(twenty, moved_poses),
    }


def main() -> int:
    """Measure and print."""
    parser = argparse.ArgumentParser(prog="python -m tests.bench.peers.sim_run", description=__doc__)
    parser.add_argument("--only", choices=COMMANDS, action="append", default=[], help="measure only this command")
    parser.add_argument("--seconds", type=float, default=0.5, help="CPU seconds of each measurement (default: 0.5)")
    parser.add_argument("--rounds", type=int, default=7, help="rounds of all measurements (default: 7)")
    arguments = parser.parse_args()
    for name in arguments.only or COMMANDS:
        ours, theirs, ratio, remarks = ratios(COMMANDS[name], seconds=arguments.seconds, rounds=arguments.rounds)
        target = COMMANDS[name].target
        print(f"{name:20}{ours / 1e3:8.0f}k{theirs / 1e3:8.0f}k{ratio:8.2f}  target {target:g}; {remarks}", flush=True)
    if not arguments.only:
        for what, spent in reading(rounds=arguments.rounds).items():
            print(f"{what:45}{spent:8.1f} µs")
    return 0


if __name__ == "__main__":
    sys.exit(main())
