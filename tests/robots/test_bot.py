"""The robot of a course on ROS 2: a prefix before every name, topics below it, plugins for both Gazebos."""

import pytest

from urdfkit.description import load
from urdfkit.description.xacro.expand import expand
from urdfkit.lint import lint
from urdfkit.resources import find_model
from urdfkit.teleop import MOVES

SPEED, TURN = 0.5, 1.0  # [m/s], [rad/s]: those of teleop_twist_keyboard


@pytest.fixture(scope="module", params=["classic", "gz"])
def robot(request):
    return load(find_model(["bot"]).path, arguments={"gazebo": request.param})


def parameters(robot, meaning):
    plugin = next(p for block in robot.gazebo for p in block.plugins if "diff" in p.filename)
    return [child.text for child in plugin.element.children if child.tag == meaning]


def test_every_name_has_the_prefix():
    robot = load(find_model(["bot"]).path, arguments={"robot_name": "robot_7"})
    for named in (*robot.links, *robot.joints):
        assert named.name.startswith("robot_7_")
    assert parameters(robot, "robot_base_frame") == ["robot_7_base_footprint"]


def test_both_spellings_lint_clean(tmp_path):
    for spelling in ("classic", "gz"):
        path = tmp_path / f"{spelling}.urdf"
        path.write_text(expand(find_model(["bot"]).path, arguments={"gazebo": spelling}).xml)
        assert [str(finding) for finding in lint([path])] == []


def test_the_drive_knows_its_wheels(robot):
    (left,), (right,) = parameters(robot, "left_joint"), parameters(robot, "right_joint")
    separation = robot.joint_by_name[left].origin.xyz[1] - robot.joint_by_name[right].origin.xyz[1]
    radius = robot.link_by_name["robot_0_left_wheel"].collisions[0].geometry.radius
    assert [float(text) for text in parameters(robot, "wheel_separation")] == [separation] == [0.35]
    assert [float(text) / 2 for text in parameters(robot, "wheel_diameter")] in ([], [radius])
    assert [float(text) for text in parameters(robot, "wheel_radius")] in ([], [radius])


@pytest.mark.parametrize("key", ["i", "u", "o", "j", "l", ","])
def test_it_goes_where_the_keys_say(robot, driven, key):
    run = driven(robot).drive(MOVES[key][0] * SPEED, MOVES[key][3] * TURN, seconds=10, ramp=0.5)
    distance, angle = run.off()
    assert distance < 0.03 * SPEED  # the drive of Gazebo Classic looks at commands 50 times a second
    assert angle < 0.02 * TURN
    assert abs(run.pose[3]) < 1e-6
    assert run.pose[4] < 1e-6


def test_neither_slips_nor_tips_when_it_starts_and_stops_at_once(robot, driven):
    run = driven(robot)
    worst = 0.0
    for v, w in ((0.5, 0.0), (-0.5, 0.0), (0.5, 1.0), (0.0, 0.0)):
        run.simulator.command((v, 0, 0), (0, 0, w))
        for _ in range(100):
            run.simulator.step(10)
            worst = max(worst, run.pose[4])
    distance, angle = run.off(run.odometry)
    assert worst < 1e-6
    assert distance < 1e-3
    assert angle < 1e-3


def test_topics_are_below_its_name(robot, driven):
    run = driven(robot).drive(0.5, 0.0, seconds=0.1)
    assert run.simulator.command_topics == ("/robot_0/cmd_vel",)
    assert {"/robot_0/odom", "/robot_0/joint_states", "/tf"} <= {topic.name for topic in run.simulator.bus.topics}
