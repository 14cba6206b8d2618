"""What `urdfkit sim run` cannot do: one line that states why and where, exit 2, no traceback."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.processes import running
from tests.time_limit import PATIENCE
from urdfkit.cli import main

Capture = pytest.CaptureFixture[str]

BODY = """<inertial><mass value="{mass}"/>
    <inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/></inertial>"""
LIMIT = '<limit lower="-1" upper="1" effort="10" velocity="5"/>'


def body(mass: str = "1", ixx: str = "0.01", iyy: str = "0.01", izz: str = "0.01") -> str:
    return BODY.format(mass=mass, ixx=ixx, iyy=iyy, izz=izz)


def box(size: str = "0.2 0.2 0.2") -> str:
    return f'<collision><geometry><box size="{size}"/></geometry></collision>'


def link(name: str, *parts: str) -> str:
    return f'  <link name="{name}">{"".join(parts) or body() + box()}</link>\n'


def joint(name: str, parent: str, child: str, more: str = LIMIT, *, type: str = "revolute") -> str:
    return (
        f'  <joint name="{name}" type="{type}"><origin xyz="0 0 0.3"/>\n    <parent link="{parent}"/>\n'
        f'    <child link="{child}"/>\n    <axis xyz="0 1 0"/>\n    {more}</joint>\n'
    )


def robot(*parts: str) -> str:
    return f'<robot name="probe">\n{"".join(parts)}</robot>\n'


def arm(*inside: str, limit: str = LIMIT) -> str:
    """A body with another one on a joint."""
    return robot(link("base"), joint("elbow", "base", "arm", limit), link("arm", *inside))


def wheels(filename: str, parameters: str = "", *, name: str = "drive") -> str:
    turning = [
        joint(side, "base", f"{side}_wheel", "", type="continuous") + link(f"{side}_wheel")
        for side in ("left", "right")
    ]
    block = f'  <gazebo>\n    <plugin name="{name}" filename="{filename}">\n{parameters}</plugin></gazebo>\n'
    return robot(link("base"), *turning, block)


REFUSED = {
    "massless": (arm(box()), ":9:9: link `arm` has no <inertial>, but joint `elbow` moves it (rejected: strict)"),
    "no mass": (arm(body("0")), ":9:36: link `arm` has no mass, but joint `elbow` moves it"),
    "no inertia": (arm(body(ixx="0", iyy="0", izz="0")), ":10:5: link `arm` has no moment of inertia"),
    "negative mass": (arm(body("-1")), ":9:30: link `arm` has a mass of -1 kg; it must be positive"),
    "mass that is no number": (arm(body("nan")), ':9:30: link `arm`: value="nan" of <mass> is not finite'),
    "negative inertia": (
        arm(body(ixx="-0.01")),
        " impossible: of its principal moments -0.01, 0.01 and 0.01 kg·m² one is negative",
    ),
    "inertia of no body": (
        arm(body(izz="1")),
        ":10:5: the inertia of link `arm` is impossible: of its principal moments 0.01, 0.01 and 1 kg·m² the largest",
    ),
    "inertia of no body at the root": (robot(link("base", body(izz="5"))), ":3:5: the inertia of link `base` is"),
    "inertia that is no number": (arm(body(ixx="inf")), ':10:5: link `arm`: ixx="inf" of <inertia> is not finite'),
    "loop": (
        robot(*map(link, "abc"), joint("ab", "a", "b"), joint("bc", "b", "c"), joint("ca", "c", "a")),
        ": the joints form a loop: b → c → a → b",
    ),
    "two parents": (
        robot(*map(link, "abc"), joint("ab", "a", "b"), joint("bc", "b", "c"), joint("ac", "a", "c")),
        ": link `c` is the child of two joints",
    ),
    "two roots": (robot(*map(link, "abc"), joint("ab", "a", "b")), ": 2 root links: `c` has no parent joint"),
    "no collision left, for want of its mesh": (
        robot(link("base", body(), '<collision><geometry><mesh filename="arm.stl"/></geometry></collision>')),
        ": no file arm.stl",
    ),
    "mimics in a circle": (
        robot(
            link("base"),
            joint("one", "base", "a", LIMIT + '<mimic joint="two"/>'),
            joint("two", "base", "b", LIMIT + '<mimic joint="one"/>'),
            link("a"),
            link("b"),
        ),
        ": mimic joints form a cycle: `one` → `two` → `one`",
    ),
    "limits the wrong way round": (
        arm(limit='<limit lower="1.5" upper="-1" effort="1" velocity="1"/>'),
        ":8:12: joint `elbow`: its lower limit 1.5 rad is above its upper limit -1 rad",
    ),
    "negative effort": (
        arm(limit='<limit lower="-1" upper="1" effort="-5" velocity="1"/>'),
        ":8:33: joint `elbow`: effort limit -5 N·m; it must not be negative",
    ),
    "negative velocity": (
        arm(limit='<limit lower="-1" upper="1" effort="5" velocity="-1"/>'),
        ":8:44: joint `elbow`: velocity limit -1 rad/s; it must not be negative",
    ),
    "damping that drives": (
        arm(limit=LIMIT + '<dynamics damping="-100"/>'),
        ":8:69: joint `elbow`: damping -100 N·m·s/rad; it must not be negative",
    ),
    "friction that drives": (
        arm(limit=LIMIT + '<dynamics friction="-1"/>'),
        ":8:69: joint `elbow`: friction -1 N·m; it must not be negative",
    ),
    "size below zero": (
        arm(body(), box("0.1 -0.1 0.1")),
        ":10:104: link `arm`: the <box> of a collision shape has the size -0.1 m",
    ),
    "unknown type": (
        robot(link("base"), joint("elbow", "base", "arm", type="revolut"), link("arm")),
        ": joint `elbow`: unknown type `revolut`; did you mean `revolute`?",
    ),
    "friction in words": (
        robot(link("base"), '<gazebo reference="base"><mu1>slippery</mu1></gazebo>'),
        ": <mu1>: `slippery` is not a number, zero or greater",
    ),
    "joint of a plugin": (
        wheels("libgazebo_ros_diff_drive.so", "<leftJoint>lef</leftJoint><rightJoint>right</rightJoint>"),
        ": no joint `lef` in robot `probe`; did you mean `left`?",
    ),
    "value of a plugin": (
        wheels(
            "libgazebo_ros_diff_drive.so",
            "<leftJoint>left</leftJoint><rightJoint>right</rightJoint><wheelSeparation>wide</wheelSeparation>",
        ),
        ": <wheelSeparation> is `wide`; it must be a number greater than zero",
    ),
    "empty file": ("", ":1:1: the file is empty"),
    "no XML": ("hello", ":1:1: this is not XML"),
    "no end": ('<robot name="probe"><link name="a">', ": the file ends too early"),
}


@pytest.mark.parametrize("what", REFUSED)
def test_models_that_cannot_be_simulated_are_refused_with_place_and_value(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture, what: str
) -> None:
    text, reported = REFUSED[what]
    monkeypatch.chdir(tmp_path)
    Path("probe.urdf").write_text(text)
    assert main(["sim", "run", "probe.urdf", "--for", "0.1", "--strict"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("urdfkit: probe.urdf:")
    assert err.count("\n") == 1, err
    assert reported in err


REPAIRED = {
    "massless": ("mass", "I511", ":9:9: link `arm` has no <inertial>, but joint `elbow` moves it; simulated with 8 kg"),
    "no mass": ("mass", "I501", ":9:36: link `arm` has no mass, but joint `elbow` moves it; simulated with "),
    "no inertia": ("mass", "I504", ":10:5: link `arm` has no moment of inertia, but joint `elbow` moves it; simulated"),
    "negative inertia": ("inertia", "I502", "and 0.01 kg·m² one is negative; simulated with"),
    "inertia of no body": ("inertia", "I503", ":10:5: the inertia of link `arm` is impossible: "),
    "inertia of no body at the root": ("inertia", "I503", ":3:5: the inertia of link `base` is"),
    "no collision left, for want of its mesh": ("mesh", "G601", ": no file arm.stl; shape `base/collision/0` is"),
    "size below zero": ("shape", "G611", ":10:109: the box of link `arm` has a size of -0.1 m; it must be positive; "),
}
"""Defect → kind of its repair, code of the lint rule, and part of the message."""


@pytest.mark.parametrize("what", REPAIRED)
def test_models_that_can_be_repaired_run_with_one_warning(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture, what: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("probe.urdf").write_text(REFUSED[what][0])
    assert main(["sim", "run", "probe.urdf", "--for", "0.1", "--json"]) == 0
    out, err = capsys.readouterr()
    kind, code, reported = REPAIRED[what]
    (repair,) = json.loads(out)["repairs"]
    assert (repair["kind"], repair["code"]) == (kind, code)
    assert f"urdfkit: warning: {repair['file']}:{repair['line']}:{repair['column']}: {repair['message']}\n" in err
    assert reported in err


def test_a_negative_mass_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture) -> None:
    monkeypatch.chdir(tmp_path)
    text, reported = REFUSED["negative mass"]
    Path("probe.urdf").write_text(text)
    assert main(["sim", "run", "probe.urdf", "--for", "0.1"]) == 2
    assert reported in capsys.readouterr().err


PLUGINS = {
    ("libgazebo_ros_dif_drive.so", "drive"): "libgazebo_ros_diff_drive.so",
    ("gz-sim-dif-drive-system", "gz::sim::systems::DiffDrive"): "gz-sim-diff-drive-system",
    ("libgazebo_ros_skid_stear_drive.so", "drive"): "libgazebo_ros_skid_steer_drive.so",
}


@pytest.mark.parametrize(("filename", "name"), PLUGINS)
def test_unknown_plugins_are_noted_with_the_nearest_and_the_rest_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture, filename: str, name: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("probe.urdf").write_text(wheels(filename, name=name))
    assert main(["sim", "run", "probe.urdf", "--for", "0.1"]) == 0
    out, err = capsys.readouterr()
    near = PLUGINS[filename, name]
    column = Path("probe.urdf").read_text().splitlines()[18].index("filename=") + 1
    assert f"probe.urdf:19:{column}: no plugin `{filename}`; did you mean `{near}`?\n" in err
    assert "0.1 s in 100 steps" in out


def test_plugins_without_a_file_name_are_noted(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "probe.urdf"
    path.write_text(robot(link("base"), '<gazebo><plugin name="lost"/></gazebo>'))
    assert main(["sim", "run", str(path), "--for", "0.1"]) == 0
    assert "plugin `lost` has no filename and is ignored" in capsys.readouterr().err


def test_unknown_plugins_of_models_are_reported_once(tmp_path: Path, capsys: Capture) -> None:
    link = '<link name="{}"><inertial><mass>1</mass></inertial></link>'
    path = tmp_path / "w.sdf"
    path.write_text(
        '<sdf version="1.9"><world name="w"><model name="door">\n'
        '<plugin filename="libgazebo_ros_doorr.so" name="d"/>\n'
        '<plugin filename="libgazebo_ros_diff_drve.so" name="e"/>\n'
        '<plugin filename="libmy_stuff.so" name="f"/>\n'
        f"{link.format('a')}{link.format('b')}"
        '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint>'
        '<joint name="f" type="fixed"><parent>world</parent><child>a</child></joint></model></world></sdf>'
    )
    assert main(["sim", "run", "simpleton", "--for", "0.1", "--world", str(path)]) == 0
    lines = capsys.readouterr().err.splitlines()
    for filename, reported in (
        ("doorr", "w.sdf:2:1: unknown plugin `libgazebo_ros_doorr.so` in model `door` is ignored"),
        (
            "diff_drve",
            "`libgazebo_ros_diff_drve.so` in model `door` is ignored; did you mean `gazebo_ros_diff_drive`?",
        ),
        ("my_stuff", "w.sdf:4:1: unknown plugin `libmy_stuff.so` in model `door` is ignored"),
    ):
        (line,) = [line for line in lines if filename in line]
        assert line.endswith(reported)


def test_unknown_plugins_of_a_world_are_noted_and_the_rest_runs(tmp_path: Path, capsys: Capture) -> None:
    path = tmp_path / "w.sdf"
    path.write_text(
        '<sdf version="1.9"><world name="w"><include><uri>model://ground_plane</uri></include>\n'
        '<plugin filename="gz-sim-phisics-system" name="gz::sim::systems::Physics"/></world></sdf>'
    )
    assert main(["sim", "run", "simpleton", "--for", "0.1", "--world", str(path)]) == 0
    out, err = capsys.readouterr()
    assert "w.sdf:2:1: unknown plugin `gz-sim-phisics-system` in the world is ignored" in err
    assert "did you mean" in err
    assert "in world w: 0.1 s" in out


@pytest.mark.parametrize(
    ("options", "body_or_joint"),
    [
        (["--initial-twist", "1e300,0,0,0,0,0"], "root link `base_footprint`"),
        (["--initial-twist", "0,0,0,0,1e200,0"], "root link `base_footprint`"),
        (["--initial-joints", "left_wheel_joint=0:1e200"], "root link `base_footprint`"),
    ],
)
def test_divergence_is_reported_with_time_and_joint(capsys: Capture, options: list[str], body_or_joint: str) -> None:
    assert main(["sim", "run", "simpleton", "-q", "--for", "0.1", *options]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1
    assert "the simulation diverged at t = 0.00" in err
    assert body_or_joint in err
    assert "no longer has a finite velocity; use a smaller step" in err


OPTIONS = {
    ("--for", "-1"): "argument --for: `-1` is negative; it must be seconds, zero or more",
    ("--for", "soon"): "argument --for: `soon` is not a number",
    ("--for", "10m"): "argument --for: `10m` is not a number; write it without a unit",
    ("--dt", "0"): "argument --dt: `0` must be greater than zero",
    ("--dt", "1"): "the time step is 1 s; it must be from 1e-6 to 0.1 s, such as 0.001",
    ("--seed", "-1"): "argument --seed: `-1` is not a seed; it must be a whole number, zero or more",
    ("--seed", "0.5"): "argument --seed: `0.5` is not a seed; it must be a whole number, zero or more",
    ("--gravity", "0,0"): "argument --gravity: `0,0` has 2 values, expected 3: GX,GY,GZ",
    ("--gravity", "0,0,nan"): "argument --gravity: `nan` is not a finite number",
    ("--gravity", "0,0,-1e300"): "gravity is -1e+300 m/s²; it must be at most 10000 m/s² (Earth: 0,0,-9.81)",
    ("--spawn", "0,0"): "argument --spawn: `0,0` has 2 values, expected X,Y,Z,YAW or X,Y,Z,ROLL,PITCH,YAW",
    ("--spawn", "0,0,up,0"): "argument --spawn: `up` is not a number",
    ("--initial-twist", "1,0,0"): "argument --initial-twist: `1,0,0` has 3 values, expected 6: VX,VY,VZ,WX,WY,WZ",
    ("--initial-joints", "left_wheel_joint"): "argument --initial-joints: `left_wheel_joint` is not NAME=VALUE",
    ("--initial-joints", "left_wheel=1"): "no movable joint `left_wheel` in robot `simpleton`; did you mean "
    "`left_wheel_joint`?",
    ("--initial-joints", "a=1,b=2,a=0:1"): "argument --initial-joints: `a=1,b=2,a=0:1` names `a` twice",
    ("--joint-target", "a=1,a=1"): "argument --joint-target: `a=1,a=1` names `a` twice",
    ("--joint-target", "left_wheel=1"): "did you mean `left_wheel_joint`?",
    ("--world", "hous"): "no world `hous`; did you mean `house`?",
    ("--wrld", "house"): "unrecognized arguments: --wrld house; did you mean `--world`?",
    ("--until", "height > 1"): "unknown name `height` (available: t, x, y,",
    (
        "--controllers",
        "arm.yaml",
    ): "argument --controllers: no such file: arm.yaml; did you mean `arms.yaml`?",
    ("--topic-pub", "/cmd_vel"): 'argument --topic-pub: `/cmd_vel` is incomplete; expected "TOPIC TYPE YAML@T"',
    ("--topic-pub", "/a geometry_msgs/Twist {linea: {x: 1}}"): "no field `linea` in geometry_msgs/msg/Twist; did you "
    "mean `linear`?",
}


@pytest.mark.parametrize(("option", "value"), OPTIONS)
def test_options_that_make_no_sense(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Capture, option: str, value: str
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("arms.yaml").write_text("")
    words = [] if option == "--for" else ["--for", "0.01"]
    assert main(["sim", "run", "simpleton", "-q", *words, option, value]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.count("\n") == 1, err
    assert OPTIONS[option, value] in err


def command(*words: str) -> list[str]:
    return [sys.executable, "-m", "urdfkit", "sim", "run", *words]


@pytest.mark.slow
@pytest.mark.parametrize("ignored", [[], [signal.SIGINT]], ids=["terminal", "background job"])
def test_sigint_ends_it_without_a_word(tmp_path: Path, ignored: list[signal.Signals]) -> None:
    brick = tmp_path / "brick.urdf"
    brick.write_text(
        '<robot name="brick"><link name="base"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" '
        'ixz="0" iyz="0"/></inertial></link><gazebo><plugin name="g" filename="libgazebo_ros_vacuum_gripper.so"/>'
        "</gazebo></robot>"
    )
    words = command(str(brick), "--world", "void", "--for", "1e6")
    with running(words, ignored=ignored, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        assert "`libgazebo_ros_vacuum_gripper.so` is not simulated yet" in process.stderr.readline()
        assert "--target urdfkit" in process.stderr.readline()  # the last line before it begins
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=PATIENCE)
    assert (process.returncode, out, err) == (130, "", "")


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGTERM, signal.SIGHUP])
def test_an_interrupted_run_keeps_its_recording(tmp_path: Path, until, how: signal.Signals) -> None:
    words = command("simpleton", "--for", "1e6", "--record", "ride.mcap")
    with running(words, cwd=tmp_path, stderr=subprocess.PIPE, text=True) as process:
        until(lambda: [path for path in tmp_path.glob(".urdfkit-*/*/*.mcap") if path.stat().st_size > 100_000])
        process.send_signal(how)
        reported = process.communicate(timeout=PATIENCE)[1]
    assert process.returncode == 128 + how
    assert re.fullmatch(r"urdfkit: recorded \d+ messages of \d+ topics to ride.mcap\n", reported.splitlines(True)[-1])
    assert [path.name for path in tmp_path.iterdir()] == ["ride.mcap"]


@pytest.mark.slow
@pytest.mark.parametrize("arguments", [("sim", "run", "simpleton", "-q", "--for", "0.01", "--json"), ("rule",)])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_reader_that_goes_away_is_no_error(arguments: tuple[str, ...], unbuffered: str) -> None:
    read, write = os.pipe()
    os.close(read)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "urdfkit", *arguments],
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
            stdout=write,
            stderr=subprocess.PIPE,
            check=False,
        )
    finally:
        os.close(write)
    assert (done.returncode, done.stderr) == (141, b"")


@pytest.mark.slow
@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
@pytest.mark.parametrize("arguments", [("sim", "run", "simpleton", "-q", "--for", "0.01"), ("rule",)])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_an_output_that_takes_nothing_is_an_error(arguments: tuple[str, ...], unbuffered: str) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "urdfkit", *arguments],
            env=os.environ | {"PYTHONUNBUFFERED": unbuffered},
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )
    assert done.returncode == 2
    assert done.stderr == "urdfkit: No space left on device\n"


@pytest.mark.slow
@pytest.mark.parametrize("closed", ["1>&-", "2>&-"])
def test_closed_outputs_are_no_error(closed: str) -> None:
    shell = f"{sys.executable} -m urdfkit sim run simpleton --for 0.01 {closed}"
    done = subprocess.run(["/bin/sh", "-c", shell], capture_output=True, text=True, check=False)
    assert done.returncode == 0
    assert "Traceback" not in done.stderr


def test_a_joint_that_a_controller_commands_is_not_held_as_well(capsys: Capture) -> None:
    assert main(["sim", "run", "rrbot", "-q", "--for", "0.1", "--joint-target", "joint1=1.0"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert "--joint-target joint1: controller `joint1_position_controller` commands this joint" in err


@pytest.mark.parametrize("words", [["simpletn"], ["simpleton", "--world", "hose"]])
def test_nothing_is_compiled_for_a_typing_error(
    words: list[str], capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "urdfkit.app.simulation.kernel_compilation.prepare_kernel", lambda _: pytest.fail("it is compiled first")
    )
    assert main(["sim", "run", *words, "--for", "1"]) == 2
    assert "did you mean" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("missing", "named"),
    [(["numpy"], "numpy"), (["numba"], "numba"), (["numpy", "numba", "pinocchio"], "numpy, numba and pinocchio")],
)
def test_packages_of_the_extra_that_are_not_installed_are_named(
    missing: list[str], named: str, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in missing:
        monkeypatch.setitem(sys.modules, module, None)
    assert main(["sim", "run", "simpleton", "--for", "1"]) == 2
    assert capsys.readouterr().err == f"urdfkit: sim run needs {named}: pip install 'urdfkit[sim]'\n"
