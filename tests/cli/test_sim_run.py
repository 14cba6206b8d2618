"""`urdfkit sim run` as a script sees it: results, JSON, errors."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.reference_engine import ReferenceEngine
from urdfkit.cli import main
from urdfkit.sim.world import world_builder

Capture = pytest.CaptureFixture[str]

RAMPED = ["simpleton", "--for", "10", "--cmd-vel", "0.5,0,0.5", "--cmd-ramp", "0.5", "--json"]
TIMES = ("cpu", "wall", "real_time_factor")


def run(capsys: Capture, *arguments: str) -> dict[str, Any]:
    assert main(["sim", "run", *arguments, *([] if "--json" in arguments else ["--json"])]) == 0
    report: dict[str, Any] = json.loads(capsys.readouterr().out)
    return report


def refused(capsys: Capture, *arguments: str) -> str:
    assert main(["sim", "run", *arguments]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    reported = [line for line in err.splitlines() if "not simulated yet" not in line]
    assert len(reported) == 1, err
    return reported[0]


def ramped_unicycle(v: float, w: float, ramp: float, seconds: float) -> tuple[float, float, float]:
    """Integrate the ideal unicycle by the midpoint rule, fine enough for 1e-9."""
    n = 200_000
    h = seconds / n
    part = np.minimum((np.arange(n) + 0.5) * h / ramp, 1.0)
    heading = np.cumsum(w * part * h) - w * part * h / 2
    return (
        float((v * part * np.cos(heading)).sum() * h),
        float((v * part * np.sin(heading)).sum() * h),
        w * (seconds - ramp / 2),
    )


def heading(quaternion: list[float]) -> float:
    return 2 * math.atan2(quaternion[2], quaternion[3])


def test_simpleton_drives_like_the_ideal_ramped_unicycle(capsys: Capture) -> None:
    report = run(capsys, *RAMPED)
    x, y, yaw = ramped_unicycle(0.5, 0.5, 0.5, 10.0)
    for pose in (report["base"], report["odometry"]["odom"]):
        assert math.hypot(pose["position"][0] - x, pose["position"][1] - y) < 5e-3
        assert abs(math.remainder(heading(pose["quaternion"]) - yaw, 2 * math.pi)) < 5e-3
    assert report["base"]["position"][2] == pytest.approx(0.0, abs=1e-9)


def test_with_a_step_five_times_as_long_it_stays_within_one_percent(capsys: Capture) -> None:
    fine, coarse = run(capsys, *RAMPED), run(capsys, *RAMPED, "--dt", "0.005")
    assert coarse["steps"] == 2000
    path = 0.5 * 9.75
    off = np.subtract(fine["base"]["position"], coarse["base"]["position"])
    assert np.linalg.norm(off) < 0.01 * path


def test_two_runs_are_identical_but_for_the_times(capsys: Capture) -> None:
    texts = []
    for _ in range(2):
        assert main(["sim", "run", *RAMPED]) == 0
        lines = capsys.readouterr().out.splitlines()
        texts.append([line for line in lines if not any(f'"{name}":' in line for name in TIMES)])
    assert texts[0] == texts[1]


@pytest.mark.slow  # in a fresh checkout: kernels of the tests are compiled first
def test_the_reference_engine_agrees(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    short = ["simpleton", "--for", "0.2", "--cmd-vel", "0.5,0,0.5", "--cmd-ramp", "0.1"]
    ours = run(capsys, *short)
    monkeypatch.setattr(world_builder, "Engine", ReferenceEngine)
    reference = run(capsys, *short)
    for key in ("position", "quaternion", "linear_velocity", "angular_velocity"):
        assert ours["base"][key] == pytest.approx(reference["base"][key], abs=1e-8)


def test_parked_for_100_seconds(capsys: Capture) -> None:
    report = run(capsys, "simpleton", "--for", "100")
    assert np.linalg.norm(report["base"]["position"]) < 1e-9


def test_the_factor_of_a_run_with_a_bridge_is_that_of_the_wall_clock(capsys: Capture) -> None:
    report = run(capsys, "simpleton", "--for", "0.3", "--rosbridge", "0")
    assert report["real_time_factor"] == pytest.approx(report["duration"] / report["wall"])


def test_json_has_the_contracts_keys_and_kinds(capsys: Capture) -> None:
    report = run(capsys, "simpleton", "--for", "0.5", "--cmd-vel", "0.2,0,0")
    assert set(report) == {
        *("robot", "world", "dt", "steps", "duration", *TIMES, "base", "joints", "odometry", "bodies", "contacts"),
        *("repairs", "energy", "topics"),
    }
    assert (report["robot"], report["world"], report["dt"], report["steps"]) == ("simpleton", "empty", 0.001, 500)
    assert report["duration"] == pytest.approx(0.5)
    assert report["real_time_factor"] == pytest.approx(report["duration"] / report["cpu"])
    lengths = {"position": 3, "quaternion": 4, "linear_velocity": 3, "angular_velocity": 3}
    assert report["base"].pop("frame") == "base_footprint"
    assert {key: len(value) for key, value in report["base"].items()} == lengths
    assert set(report["joints"]) == {"left_wheel_joint", "right_wheel_joint"}
    assert set(report["joints"]["left_wheel_joint"]) == {"position", "velocity", "effort"}
    assert set(report["odometry"]["odom"]) == {"position", "quaternion"}
    assert report["bodies"] == {}
    assert {contact["a"] for contact in report["contacts"]} == {"left_wheel", "right_wheel", "caster"}
    assert set(report["contacts"][0]) == {"a", "b", "position", "normal", "depth", "force"}
    weight = sum(contact["force"][2] for contact in report["contacts"])
    assert weight == pytest.approx(9.81 * (1.0 + 0.4 + 0.1 + 0.05), rel=1e-3)
    assert report["energy"]["kinetic"] == pytest.approx(0.5 * 1.55 * 0.2**2 + 2 * 0.5 * 1e-3 * 2.0**2, rel=1e-3)
    assert report["topics"]["/simpleton/odom"] == {"type": "nav_msgs/Odometry", "count": 50}
    assert report["topics"]["/simpleton/cmd_vel"] == {"type": "geometry_msgs/Twist", "count": 1}


SEVERAL = """<robot name="several"><link name="world"/>
<link name="a"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
<joint name="pl" type="planar"><parent link="world"/><child link="a"/><origin xyz="5 0 1"/></joint>
<joint name="fl" type="floating"><parent link="world"/><child link="b"/><origin xyz="0 2 1"/></joint></robot>"""


def test_planar_and_floating_joints_are_reported(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "several.urdf"
    path.write_text(SEVERAL)
    start = "pl/theta=1.5:0.2,pl/x=1:2,pl/y=0:-1,fl/trans_z=3:0.5"
    free = ("--world", "void", "--gravity", "0,0,0", "--for", "1")
    report = run(capsys, str(path), *free, "--initial-joints", start)
    planar, floating = report["joints"]["pl"], report["joints"]["fl"]
    # Free motion: straight and even along the joint's own axes, however the link turns.
    assert planar["position"] == pytest.approx([3, -1, 0], abs=1e-3)
    assert planar["linear_velocity"] == pytest.approx([2, -1, 0], abs=1e-3)
    assert planar["angular_velocity"] == pytest.approx([0, 0, 0.2])
    assert 2 * np.arctan2(planar["quaternion"][2], planar["quaternion"][3]) == pytest.approx(1.7)
    assert floating["position"] == pytest.approx([0, 0, 3.5])
    assert floating["linear_velocity"] == pytest.approx([0, 0, 0.5])
    assert main(["sim", "run", str(path), *free, "--initial-joints", start]) == 0
    out = capsys.readouterr().out
    assert "joint pl: x 3.0000 y -1.0000 z 0.0000 m, roll 0.0000 pitch 0.0000 yaw 1.7000 rad, moving at 2.0000" in out
    assert "joint fl: x 0.0000 y 0.0000 z 3.5000 m" in out


@pytest.mark.parametrize(
    ("start", "reported"),
    [
        ("pl=1", "joint `pl` is planar and has more than one position: `pl/x`, `pl/y`, `pl/theta`"),
        ("fl/x=1", "no movable joint `fl/x` in robot `several`; did you mean `fl/trans_x`?"),
        ("fl/rot_x=0:1", "`fl/rot_x` is one number of a quaternion: it has no separate velocity"),
        ("pl/thet=1", "did you mean `pl/theta`?"),
    ],
)
def test_starts_of_planar_and_floating_joints_that_make_no_sense(
    tmp_path: Path, capsys: Capture, start: str, reported: str
) -> None:
    path = tmp_path / "several.urdf"
    path.write_text(SEVERAL)
    assert main(["sim", "run", str(path), "--world", "void", "--for", "0.1", "--initial-joints", start]) == 2
    assert reported in capsys.readouterr().err


def test_the_summary_for_people(capsys: Capture) -> None:
    assert main(["sim", "run", "simpleton", "--for", "1"]) == 0
    out, err = capsys.readouterr()
    lines = out.splitlines()
    assert lines[0].startswith("simpleton in world empty: 1 s in 1000 steps")
    assert lines[1].startswith("base base_footprint: x ")
    assert lines[-1] == "on the ground: caster, left_wheel, right_wheel"
    assert err == ""
    assert main(["sim", "run", "simpleton", "--for", "0.1", "-q"]) == 0
    assert capsys.readouterr().err == ""


def test_spawn_gravity_and_twist(capsys: Capture) -> None:
    options = ["--spawn", "-1,2,5,0.5", "--gravity", "0,0,-2", "--initial-twist", "-1,0,3,0,0,0", "--world", "void"]
    report = run(capsys, "simpleton", "--for", "1", *options)
    assert report["base"]["position"] == pytest.approx([-2, 2, 5 + 3 - 1], abs=2e-3)
    assert heading(report["base"]["quaternion"]) == pytest.approx(0.5)
    report = run(capsys, "simpleton", "--for", "0", "--spawn", "1,2,,0.5")
    assert report["base"]["position"] == pytest.approx([1, 2, 0], abs=1e-12)
    assert report["steps"] == 0


def test_joints_at_the_start_and_targets(capsys: Capture) -> None:
    air = ["--fixed-base", "--spawn", "0,0,1,0"]
    report = run(capsys, "simpleton", "--for", "0", *air, "--initial-joints", "left_wheel_joint=0.5:2")
    assert report["joints"]["left_wheel_joint"] == {"position": 0.5, "velocity": 2.0, "effort": 0.0}
    model = str(Path(__file__).parents[1] / "sim" / "arm.urdf")
    report = run(capsys, model, "--for", "3", "--joint-target", "elbow=0.7")
    assert report["joints"]["elbow"]["position"] == pytest.approx(0.7, abs=1e-4)


def test_messages_at_their_time(capsys: Capture) -> None:
    topic = "/simpleton/cmd_vel geometry_msgs/Twist"
    go, halt = f"{topic} {{linear: {{x: 0.3}}}}@0.5", f"{topic} {{}}@1.5"
    report = run(capsys, "simpleton", "--for", "2", "--topic-pub", go, "--topic-pub", halt)
    assert report["base"]["position"][0] == pytest.approx(0.3, abs=0.03)
    assert report["topics"]["/simpleton/cmd_vel"]["count"] == 2


@pytest.mark.parametrize("topic", ["/simpleton/cmd_vle", "/cmd_vl"])
def test_a_message_for_a_misspelt_topic_is_an_error_unless_other_programs_may_subscribe(
    capsys: Capture, tmp_path: Path, topic: str
) -> None:
    command = ["sim", "run", "simpleton", "--for", "0", "--topic-pub", f"{topic} geometry_msgs/Twist {{}}"]
    message = f"{topic} has no subscribers; did you mean `/simpleton/cmd_vel`?"
    assert main(command) == 2
    assert capsys.readouterr().err.splitlines() == [f"urdfkit: --topic-pub: {message}"]
    assert main([*command, "--record", str(tmp_path / "run.mcap")]) == 0
    assert message in capsys.readouterr().err


def test_until(capsys: Capture) -> None:
    report = run(capsys, "simpleton", "--for", "9", "--cmd-vel", "0.5,0,0", "--until", "x > 0.25 and abs(yaw) < 0.1")
    assert report["base"]["position"][0] == pytest.approx(0.25, abs=1e-3)
    report = run(capsys, "simpleton", "--for", "9", "--until", "t >= 0.0995 or position('left_wheel_joint') > 1")
    assert report["steps"] == 100


def test_commands_that_are_not_finite_are_dropped_with_a_warning(capsys: Capture) -> None:
    assert main(["sim", "run", "simpleton", "--for", "1", "--cmd-vel", "nan,0,-inf", "--json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["base"]["position"] == pytest.approx([0, 0, 0], abs=1e-9)
    assert "dropped a command on /simpleton/cmd_vel: nan 0 0 m/s, 0 0 -inf rad/s is not finite" in err


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (["simpletn", "--for", "1"], "no robot, file or folder `simpletn`; did you mean `simpleton`?"),
        (["simpleton"], "the following arguments are required: --for"),
        (["simpleton", "--for", "-1"], "--for: `-1` is negative"),
        (["simpleton", "--for", "nan"], "--for: `nan` is not a finite number"),
        (["simpleton", "--for", "ten"], "--for: `ten` is not a number"),
        (["simpleton", "--for", "1", "--dt", "0"], "--dt: `0` must be greater than zero"),
        (["simpleton", "--for", "1", "--dt", "5"], "the time step is 5 s"),
        (["simpleton", "--for", "1", "--cmd-vel", "1,2"], "`1,2` has 2 values, expected 3: VX,VY,WZ"),
        (["simpleton", "--for", "1", "--cmd-vel", "1,2,x"], "`x` is not a number"),
        (["simpleton", "--for", "1", "--cmd-ramp", "1"], "--cmd-ramp requires --cmd-vel"),
        (["simpleton", "--for", "1", "--spawn", "1,2"], "has 2 values, expected X,Y,Z,YAW or"),
        (["simpleton", "--for", "1", "--gravity", "0,0,inf"], "`inf` is not a finite number"),
        (["simpleton", "--for", "1", "--world", "emty"], "no world `emty`; did you mean `empty`?"),
        (["simpleton", "--for", "1", "--joint-target", "left_wheel=1"], "no movable joint `left_wheel`"),
        (["simpleton", "--for", "1", "--joint-target", "left_wheel"], "`left_wheel` is not NAME=VALUE"),
        (["simpleton", "--for", "1", "--initial-joints", "camera_joint=1"], "joint `camera_joint` is fixed"),
        (["simpleton", "--for", "1", "--recrod", "x.mcap"], "unrecognized arguments: --recrod"),
        (["simpleton", "--for", "1", "--record", "x.bag"], "recordings are MCAP files; name the file x.mcap"),
        (["simpleton", "--for", "1", "--until", "x >"], "--until: `x >` is not an expression"),
        (["simpleton", "--for", "1", "--until", "heading > 1"], "unknown name `heading`"),
        (["simpleton", "--for", "1", "--until", "velocity('left') > 1"], "unknown joint `left`"),
        (["simpleton", "--for", "1", "--until", "x.real > 1"], "`x.real` is not allowed"),
        (["simpleton", "--for", "1", "--until", "__import__('os').abort()"], "is not allowed"),
        (["simpleton", "--for", "1", "--until", "2 ** 2 ** 99 > 1"], "is not allowed"),
        (["simpleton", "--for", "1", "--until", "1 / contacts > 1"], "division by zero"),
        (["simpleton", "--for", "1", "--topic-pub", "/x"], '`/x` is incomplete; expected "TOPIC TYPE YAML@T"'),
        (
            ["simpleton", "--for", "1", "--topic-pub", "/x geometry_msgs/Twst {}"],
            "did you mean `geometry_msgs/msg/Twist`?",
        ),
        (["simpleton", "--for", "1", "--topic-pub", "/x geometry_msgs/Twist {linaer: {}}"], "did you mean `linear`?"),
        (["simpleton", "--for", "1", "--topic-pub", "/x geometry_msgs/Twist {linear: 3}"], "write its fields, x, y, z"),
        (["simpleton", "--for", "1", "--topic-pub", "/x geometry_msgs/Twist {linear"], "is not YAML"),
        (
            ["simpleton", "--for", "1", "--topic-pub", "/simpleton/cmd_vel std_msgs/Bool {}"],
            "topic `/simpleton/cmd_vel` has type geometry_msgs/msg/Twist, not std_msgs/msg/Bool",
        ),
    ],
)
def test_what_makes_no_sense_is_one_line(capsys: Capture, arguments: list[str], reported: str) -> None:
    assert reported in refused(capsys, *arguments)


MASS = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>"


@pytest.mark.parametrize(
    ("content", "reported"),
    [
        ("<link name='a'/>", "2:7: link `a` has no <inertial>, but the robot is free to move"),
        ("<link", "2:5: `>` is missing before the `<` on line 3"),
        (
            f"<link name='a'><collision><geometry>\n<mesh filename='gone.stl'/></geometry></collision>{MASS}</link>",
            "3:1: ",
        ),
    ],
)
def test_models_that_cannot_be_simulated(capsys: Capture, tmp_path: Path, content: str, reported: str) -> None:
    path = tmp_path / "r.urdf"
    path.write_text(f"<robot name='r'>\n{content}\n</robot>")
    line = refused(capsys, str(path), "--for", "1", "--strict")
    assert f"r.urdf:{reported}" in line


def test_warmup_makes_the_kernel_ready(capsys: Capture) -> None:
    assert main(["sim", "warmup"]) == 0
    assert "kernel" in capsys.readouterr().out


def test_the_ramp_publishes_what_the_drive_will_hold() -> None:
    from urdfkit.app.simulation.runs.commands import ramp
    from urdfkit.messages import TWIST
    from urdfkit.sim import Simulator

    simulator = Simulator("simpleton", note=lambda text: None)
    held: list[tuple[float, float]] = []
    simulator.subscribe("/simpleton/cmd_vel", TWIST, lambda message: held.append((simulator.t, message.linear.x)))
    ramp(simulator, (1.0, 0.0, 0.0), 0.205)
    simulator.run(1.0)
    assert len(held) == 22
    assert held[-1] == (0.21, 1.0)
    distance = sum(v * 0.01 for _, v in held[:-1])
    assert distance == pytest.approx(0.205 / 2 + 0.005)


def test_help_shows_two_examples(capsys: Capture) -> None:
    for words in (["sim"], ["sim", "run"], ["sim", "sweep"], ["sim", "warmup"]):
        with pytest.raises(SystemExit) as caught:
            main([*words, "--help"])
        assert caught.value.code == 0
        assert capsys.readouterr().out.split("examples:")[1].count("urdfkit sim") >= 2


def test_ros_distributions_swap_sides_as_they_did(capsys: Capture) -> None:
    turned = {}
    for distro in ("indigo", "noetic"):
        command = ["sim", "run", "simpleton", "--for", "1", "--cmd-vel", "0,0,1", "--json", "--ros-distro", distro]
        assert main(command) == 0
        turned[distro] = json.loads(capsys.readouterr().out)["base"]["angular_velocity"][2]
    assert turned["noetic"] > 0.5
    assert turned["indigo"] == pytest.approx(-turned["noetic"], abs=0.05)


def test_ros_distributions_that_never_were(capsys: Capture) -> None:
    assert main(["sim", "run", "simpleton", "--for", "1", "--ros-distro", "kinetc"]) == 2
    assert "unknown ROS distribution `kinetc`; did you mean `kinetic`?" in capsys.readouterr().err
