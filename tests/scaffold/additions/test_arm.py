"""`urdfkit new arm`: an arm on a robot that was there, which lints clean and goes where it is told."""

import shutil

import pytest

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.messages import TRAJECTORY, from_fields
from urdfkit.resources import robots_dir
from urdfkit.sim import Simulator


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def new(*options, into="simpleton_description"):
    return main(["new", "arm", "--into", into, *options])


@pytest.fixture
def simpleton(place):
    """A robot that drives, as a person wrote it."""
    shutil.copytree(robots_dir() / "simpleton/simpleton_description", place / "simpleton_description")
    return place / "simpleton_description/urdf/simpleton.urdf.xacro"


def findings(folder):
    return [str(finding) for finding in lint([folder]) if finding.severity != "note"]


@pytest.mark.parametrize("dof", ["3", "4", "5", "6", "7"])
def test_every_arm_is_clean(simpleton, dof):
    before = simpleton.read_text()
    assert new("--dof", dof, "--gripper") == 0
    after = simpleton.read_text()
    added = after.replace(before.split("</robot>")[0], "").removesuffix("</robot>\n").strip().splitlines()
    assert added[0].strip() == '<xacro:include filename="arm_macro.xacro"/>'
    assert len(added) == 4
    assert findings(simpleton.parents[1]) == []
    robot = load(simpleton)
    turning = [joint for joint in robot.joints if joint.type == "revolute"]
    assert len(turning) == int(dof)
    assert {"tool0", "left_finger", "right_finger"} <= {link.name.removesuffix("_link") for link in robot.links}


def test_numbers_arrive_as_typed(simpleton):
    assert new("--xyz", "-0.25123456", "0", "0.3", "--rpy", "0", "0", "3.141592653589793") == 0
    assert '<origin xyz="-0.25123456 0 0.3" rpy="0 0 3.141592653589793"/>' in simpleton.read_text()


@pytest.mark.slow
def test_it_moves_as_its_controllers_say(place, simpleton):
    assert new("--dof", "5") == 0
    assert main(["new", "controllers", "--into", "simpleton_description"]) == 0
    assert findings(place) == []
    robot = load(simpleton, package_path=[place])
    simulator = Simulator(robot, note=lambda _: None, fixed_base=True)
    joints = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint"]
    topics = ("/simpleton/arm_controller/command", "/arm_controller/joint_trajectory")
    topic = next(topic.name for topic in simulator.bus.topics if topic.name in topics)
    point = {"positions": [0.6, 0.3, -0.4], "time_from_start": {"sec": 1, "nanosec": 0}}
    simulator.bus.publish(topic, TRAJECTORY, from_fields(TRAJECTORY, {"joint_names": joints, "points": [point]}))
    simulator.run(2.0)
    assert [simulator.state.position(joint) for joint in joints] == pytest.approx([0.6, 0.3, -0.4], abs=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize("ros", ["noetic", "jazzy", "humble"])
def test_both_fingers_move(place, ros):
    assert main(["new", "robot", "scout", "--ros", ros, "--no-picture", "--yes", "-q"]) == 0
    assert new("--dof", "4", "--gripper", into="scout_description") == 0
    assert ("<mimic" in (place / "scout_description/urdf/arm_macro.xacro").read_text()) == (ros != "noetic")
    assert main(["new", "controllers", "--into", "scout_description"]) == 0
    assert findings(place) == []
    fingers = ["left_finger_joint", "right_finger_joint"]
    simulator = Simulator(
        load(place / "scout_description/urdf/scout.urdf.xacro", package_path=[place]), note=lambda _: None
    )
    topic = "/scout/gripper_controller/command" if ros == "noetic" else "/gripper_controller/joint_trajectory"
    told = fingers if ros == "noetic" else fingers[:1]
    point = {"positions": [0.015] * len(told), "time_from_start": {"sec": 1, "nanosec": 0}}
    simulator.bus.publish(topic, TRAJECTORY, from_fields(TRAJECTORY, {"joint_names": told, "points": [point]}))
    simulator.run(2.0)
    assert [simulator.state.position(joint) for joint in fingers] == pytest.approx([0.015, 0.015], abs=1e-3)


@pytest.mark.slow
def test_two_arms_have_names_of_their_own(simpleton, capsys):
    assert new("--name", "left", "--reach", "0.3", "--xyz", "0", "0.1", "0.1") == 0
    assert new("--name", "right", "--reach", "0.3", "--xyz", "0", "-0.1", "0.1") == 0
    names = set(load(simpleton).link_by_name)
    assert {"left_tool0", "right_tool0", "left_arm_foot", "right_arm_foot"} <= names
    before = simpleton.read_bytes()
    assert new("--name", "left") == 2
    assert "nothing was changed; choose another --name" in capsys.readouterr().err
    assert simpleton.read_bytes() == before


def test_sizes_are_as_told(simpleton):
    assert new("--dof", "4", "--reach", "0.5", "--mass", "2", "--xyz", "0.05", "0", "0.1", "--parent", "chassis") == 0
    robot = load(simpleton)
    mount = robot.joint_by_name["arm_mount_joint"]
    assert (mount.parent, mount.origin.xyz) == ("chassis", (0.05, 0, 0.1))
    arm = ("arm_foot", "shoulder_link", "upper_arm_link", "forearm_link", "hand_link")
    assert sum(robot.link_by_name[name].inertial.mass for name in arm) == pytest.approx(2, rel=1e-6)


def test_a_urdf_without_xacro_gets_plain_elements(place):
    path = place / "base.urdf"
    path.write_text(
        '<robot name="base">\n  <link name="base_link">\n    <inertial><mass value="20"/><inertia ixx="0.483" ixy="0" '
        'ixz="0" iyy="0.483" iyz="0" izz="0.833"/></inertial>\n    '
        '<collision><geometry><box size="0.5 0.5 0.2"/></geometry></collision>\n  </link>\n</robot>\n'
    )
    assert new(into="base.urdf") == 0
    assert list(place.iterdir()) == [path]
    assert "xacro" not in path.read_text()
    assert load(path).joint_by_name["arm_mount_joint"].origin.xyz == (0, 0, 0.1)


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--dof", "8"], "`8` is not available; use 3, 4, 5, 6 or 7"),
        (["--parent", "chasis"], "did you mean `chassis`?"),
        (["--reach", "50"], "urdfkit: --reach 50 m is out of range"),
        (["--griper"], "did you mean `--gripper`?"),
        (["--name", "a b"], "letters, digits and underscores"),
        (["--finger-travel", "0.01"], "--finger-travel requires --gripper"),
        (["6"], "did you mean `--dof 6`?"),
        (["--joints", "6"], "did you mean `--dof`?"),
        (["--arm", "6"], "did you mean `--dof`?"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_changed(simpleton, capsys, options, says):
    before = {path: path.read_bytes() for path in simpleton.parents[1].rglob("*") if path.is_file()}
    assert new(*options) == 2
    reported = capsys.readouterr().err
    assert says in reported
    assert reported.count("\n") == 1
    assert {path: path.read_bytes() for path in simpleton.parents[1].rglob("*") if path.is_file()} == before
