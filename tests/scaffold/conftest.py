import subprocess

import pytest

from urdfkit.messages import FLOAT, TRAJECTORY, from_fields
from urdfkit.resources import templates_dir
from urdfkit.scaffold import load_template


@pytest.fixture(scope="session")
def robot_template():
    return load_template(templates_dir() / "robot")


@pytest.fixture
def small_template(tmp_path):
    """A template of three questions and two layers, in a folder of its own."""
    folder = tmp_path / "template"
    (folder / "all/@name@/src").mkdir(parents=True)
    (folder / "all/@name@/src/@name@.txt").write_text(
        "@name@ is @size@ m: ${x} $(find @name@) user@example.com @ year @year@\n"
    )
    (folder / "blue").mkdir()
    (folder / "blue/COLOUR").write_text("blue")
    (folder / "template.toml").write_text(
        """
        summary = "a thing"
        # Keys of the template come before its questions.
        [[question]]
        name = "name"
        prompt = "Name"
        kind = "package"
        [[question]]
        name = "size"
        prompt = "Size"
        kind = "number"
        unit = "m"
        range = [0.1, 10]
        default = "1"
        [[question]]
        name = "twice"
        prompt = "Twice"
        kind = "number"
        default = "= 2*size"
        [[question]]
        name = "colour"
        prompt = "Colour"
        kind = "choice"
        choices = ["red", "blue"]
        default = "red"
        [[check]]
        holds = "twice >= size"
        otherwise = "{twice} must be at least {size}"
        [[layer]]
        folder = "all"
        [[layer]]
        folder = "blue"
        into = ["@name@", "paint"]
        when = { colour = ["blue"] }
        [[next]]
        commands = ["look @into@/@name@"]
        [[next]]
        title = "in @colour@"
        commands = ["paint"]
        when = { colour = ["blue"] }
        """
    )
    return folder


@pytest.fixture
def debian(tmp_path):
    """Return what runs a shell command in `tmp_path` with Debian's tools and returns what it prints."""
    system = "/usr/sbin:/usr/bin:/sbin:/bin"  # a Python of the user's own breaks them

    def run(command):
        env = {"PATH": system, "HOME": str(tmp_path), "ROS_HOME": str(tmp_path / "ros"), "LANG": "C.UTF-8"}
        done = subprocess.run(
            ["/bin/bash", "-c", command], cwd=tmp_path, env=env, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
        return done.stdout + done.stderr

    return run


@pytest.fixture(scope="session")
def arm_joints():
    """The joints of an arm from its foot, by how many there are."""
    seven = ["shoulder_pan", "shoulder_lift", "upper_arm_roll", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll"]
    left_out = {"3": (2, 4, 5, 6), "4": (2, 4, 6), "5": (2, 4), "6": (2,), "7": ()}
    return {
        count: [f"{joint}_joint" for i, joint in enumerate(seven) if i not in without]
        for count, without in left_out.items()
    }


@pytest.fixture(scope="session")
def tell():
    """What tells the joints of a new robot's arm, or of its gripper, where to be in so many seconds."""

    def send(simulator, ros, targets, seconds):
        if ros == "none":
            for joint, position in targets.items():
                topic = "gripper" if "finger" in joint else f"arm/{joint.removesuffix('_joint')}"
                simulator.bus.publish(f"/{topic}", FLOAT, from_fields(FLOAT, {"data": position}))
            return
        gripping = any("finger" in joint for joint in targets)
        if gripping and ros != "noetic":
            (position,) = targets.values()
            name, told = ("GripperCommand", position) if ros == "humble" else ("ParallelGripperCommand", [position])
            kind = f"control_msgs/action/{name}_SendGoal_Request"
            goal = from_fields(kind, {"goal": {"command": {"position": told}}})
            simulator.bus.publish("/gripper_controller/gripper_cmd/_action/send_goal", kind, goal)
            return
        controller = "gripper_controller" if gripping else "arm_controller"
        topic = f"/scout/{controller}/command" if ros == "noetic" else f"/{controller}/joint_trajectory"
        point = {"positions": list(targets.values()), "time_from_start": {"sec": seconds, "nanosec": 0}}
        simulator.bus.publish(
            topic, TRAJECTORY, from_fields(TRAJECTORY, {"joint_names": list(targets), "points": [point]})
        )

    return send
