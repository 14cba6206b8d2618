"""The files of the two generations, read as their programs would: launch files, bridge, worlds, manifests."""

import re
import subprocess
import sys
import types
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import ClassVar

import pytest
import yaml

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.description.sdf import load_world
from urdfkit.resources import robots_dir
from urdfkit.scaffold import create

ARMED = {"arm": "5", "gripper": "yes", "drive": "omni"}
ROBOTS = {
    "jazzy": {"ros": "jazzy"},
    "jazzy with an arm": {"ros": "jazzy", **ARMED},
    "humble": {"ros": "humble"},
    "humble in Gazebo Classic": {"ros": "humble", "sim": "classic"},
    "humble in Gazebo Classic with an arm": {"ros": "humble", "sim": "classic", **ARMED},
    "lyrical, still": {"ros": "lyrical", "drive": "none"},
    "noetic": {"ros": "noetic"},
    "noetic with an arm": {"ros": "noetic", **ARMED},
    "a car of noetic": {"ros": "noetic", "drive": "ackermann"},
}
OF_ROS_1 = [name for name in ROBOTS if "noetic" in name]
OF_ROS_2 = [name for name in ROBOTS if "noetic" not in name]


@pytest.fixture(scope="module")
def robots(robot_template, tmp_path_factory):
    """Robots of all generations, by what they are."""
    found = {}
    for name, given in ROBOTS.items():
        folder = tmp_path_factory.mktemp("robot")
        answers = robot_template.answers({"name": "scout", **given}) | {"year": "2026", "into": "."}
        create(robot_template, answers, folder)
        found[name] = folder
    return found


def depends(package):
    root = ET.parse(package / "package.xml").getroot()
    assert root.get("format") == "3"
    return {element.text for element in root if element.tag.endswith("depend")} | {root.findtext("name")}


@pytest.mark.slow
@pytest.mark.parametrize("what", OF_ROS_2[:2])
def test_tests_of_packages_pass_without_ros(robots, what):
    """A package whose only test has nothing to do is skipped: pytest states 5, which fails, of one without tests."""
    for folder in sorted(robots[what].glob("scout_*")):
        command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test"]
        ran = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=60)
        assert ran.returncode == 0, f"{folder.name}: {ran.stdout}"


class Recorder:
    """Stands for every class of `launch` and `launch_ros`: keeps what it is made of."""

    made: ClassVar[list["Recorder"]] = []

    def __init__(self, *args, **kwargs):
        self.args, self.kwargs = args, kwargs
        self.made.append(self)


@pytest.fixture
def launch_modules(monkeypatch):
    Recorder.made = []
    kinds = {}

    def look_up(name):
        return kinds.setdefault(name, type(name, (Recorder,), {}))

    for name in (
        "launch",
        "launch.actions",
        "launch.conditions",
        "launch.launch_description_sources",
        "launch.substitutions",
        "launch_ros",
        "launch_ros.actions",
        "launch_ros.parameter_descriptions",
        "launch_ros.substitutions",
    ):
        module = types.ModuleType(name)
        module.__getattr__ = look_up
        monkeypatch.setitem(sys.modules, name, module)
    return kinds


def launch_files(folder, pattern):
    """Return the launch files of a robot's packages; each package but the bringup of a robot that stands has one."""
    found = [path.relative_to(folder).as_posix() for path in sorted(folder.glob(f"*/launch/{pattern}"))]
    assert {path.split("/")[0] for path in found} == {path.parent.name for path in folder.glob("*/package.xml")}
    return found


def test_speeds_of_a_joystick_are_floats_however_they_are_typed(robots, launch_modules):
    """`speed:=1` is an integer to a node that declares a double, and ends it."""
    launched(robots["jazzy"], "scout_bringup/launch/teleop.launch.py", launch_modules)
    (told,) = (
        each.kwargs["parameters"][0] for each in Recorder.made if each.kwargs.get("package") == "teleop_twist_joy"
    )
    kinds = {name: getattr(reported, "kwargs", {}).get("value_type") for name, reported in told.items()}
    assert {name: kind for name, kind in kinds.items() if kind} == {
        "scale_linear.x": float,
        "scale_angular.yaw": float,
        "enable_button": int,
    }


@pytest.mark.parametrize("robot", OF_ROS_2)
def test_what_is_published_stands_in_one_table(robots, robot):
    """Lines of a table that come after something else are text."""
    for path in robots[robot].rglob("README.md"):
        blocks = re.split(r"\n\s*\n", path.read_text())
        for block in (block for block in blocks if re.search(r"(?m)^\|", block)):
            lines = block.strip().splitlines()
            assert lines[1].startswith("|---"), f"{path}: {block}"
            assert all(line.startswith("|") for line in lines), f"{path}: {block}"


@pytest.mark.parametrize("robot", OF_ROS_2)
def test_ros2_launch_files(robots, launch_modules, robot):
    for path in launch_files(robots[robot], "*.launch.py"):
        Recorder.made.clear()
        launched(robots[robot], path, launch_modules)


@pytest.mark.parametrize(
    "path",
    sorted(path.relative_to(robots_dir()) for path in robots_dir().glob("*/*/launch/*.launch.py")),
    ids=lambda path: path.name,
)
def test_ros2_launch_files_of_the_robots_we_ship(launch_modules, path):
    launched(robots_dir() / path.parts[0], "/".join(path.parts[1:]), launch_modules)


@pytest.mark.parametrize("ros", ["humble", "jazzy"])
def test_ros2_launch_files_of_single_packages(tmp_path, launch_modules, ros):
    for kind in ("description", "gazebo", "control", "bringup"):
        words = ["new", "package", f"scout_{kind}", "--kind", kind, "--ros", ros, "--into", str(tmp_path), "--yes"]
        assert main(words) == 0
    for path in launch_files(tmp_path, "*.launch.py"):
        Recorder.made.clear()
        launched(tmp_path, path, launch_modules)


def launched(folder, path, launch_modules):
    """Run a launch file of a robot's folder; see that what it names is there and declared."""
    source = (folder / path).read_text()
    scope = {}
    exec(compile(source, path, "exec"), scope)
    description = scope["generate_launch_description"]()
    assert isinstance(description, launch_modules["LaunchDescription"])
    package = folder / path.split("/")[0]
    known = depends(package)
    assert {"launch_ros", "ros2launch"} <= known
    for made in Recorder.made:
        if type(made).__name__ == "Node":
            assert made.kwargs["package"] in known
            assert made in description.args[0]
        elif type(made).__name__ == "FindPackageShare":
            assert made.args[0] in known
        elif type(made).__name__ == "PathJoinSubstitution":
            share, *parts = made.args[0]
            if Path(folder, share.args[0]).is_dir():
                assert Path(folder, share.args[0], *parts).is_file()
        elif type(made).__name__ == "LaunchConfiguration":
            declared = [m.args[0] for m in Recorder.made if type(m).__name__ == "DeclareLaunchArgument"]
            assert made.args[0] in declared


@pytest.mark.parametrize("robot", OF_ROS_1)
def test_ros1_launch_files(robots, robot):
    folder = robots[robot]
    for path in launch_files(folder, "*.launch"):
        root = ET.parse(folder / path).getroot()
        known = depends(folder / path.split("/")[0])
        declared = {arg.get("name") for arg in root.findall("arg")}
        text = ET.tostring(root, encoding="unicode")
        assert {node.get("pkg") for node in root.iter("node")} <= known
        assert set(re.findall(r"\$\(arg (\w+)\)", text)) <= declared
        for package, rest in re.findall(r"\$\(find (\w+)\)/([\w./]+)", text):
            assert package in known
            if package.startswith("scout_"):
                assert (folder / package / rest).is_file()


@pytest.mark.parametrize("robot", ["jazzy", "humble", "lyrical, still"])
def test_bridge_carries_what_the_plugins_publish(robots, robot):
    folder = robots[robot]
    bridge = yaml.safe_load((folder / "scout_gazebo/config/bridge.yaml").read_text())
    robot = load(folder / "scout_description/urdf/scout.urdf.xacro")
    topics = {"topic", "odom_topic", "tf_topic"}
    spoken = {
        child.text
        for block in robot.gazebo
        for plugin in block.plugins
        for child in plugin.element.children
        if child.tag in topics
    }
    assert {entry["gz_topic_name"] for entry in bridge} == spoken | {"clock"}
    for entry in bridge:
        assert set(entry) == {"ros_topic_name", "gz_topic_name", "ros_type_name", "gz_type_name", "direction"}
        assert entry["direction"] == ("ROS_TO_GZ" if entry["ros_topic_name"] == "cmd_vel" else "GZ_TO_ROS")


@pytest.mark.parametrize(
    ("ros", "path"),
    [("jazzy", "empty.sdf"), ("noetic", "empty.world"), ("humble in Gazebo Classic", "empty.world")],
)
def test_worlds_load(robots, ros, path):
    assert load_world(robots[ros] / "scout_gazebo/worlds" / path).name == "empty"


@pytest.mark.parametrize("ros", ["jazzy", "noetic"])
def test_rviz_configuration(robots, ros):
    config = yaml.safe_load((robots[ros] / "scout_description/rviz/scout.rviz").read_text())
    classes = [display["Class"] for display in config["Visualization Manager"]["Displays"]]
    prefix = "rviz_default_plugins/" if ros == "jazzy" else "rviz/"
    assert classes == [f"{prefix}{name}" for name in ("Grid", "RobotModel", "TF")]
    assert config["Visualization Manager"]["Global Options"]["Fixed Frame"] == "base_footprint"


@pytest.mark.parametrize("ros", ROBOTS)
def test_everything_is_installed(robots, ros):
    for package in robots[ros].iterdir():
        rule = re.search(r"install\(DIRECTORY ([\w ]+)\n", (package / "CMakeLists.txt").read_text())
        folders = {path.name for path in package.iterdir() if path.is_dir()} - {"hooks", "test"}
        assert set(rule[1].split()) == folders
        assert all(any((package / folder).iterdir()) for folder in folders)


def test_humble_has_the_names_of_fortress(robots):
    texts = {
        path: path.read_text()
        for path in robots["humble"].rglob("*")
        if path.is_file() and path.suffix in (".xacro", ".sdf", ".yaml", ".dsv")
    }
    whole = "\n".join(texts.values())
    assert "gz-sim" not in whole
    assert "gz::sim" not in whole
    assert "gz.msgs" not in whole
    assert 'filename="ignition-gazebo-diff-drive-system" name="ignition::gazebo::systems::DiffDrive"' in whole
    assert "gz_type_name: ignition.msgs.Twist" in whole
    assert "prepend-non-duplicate;IGN_GAZEBO_RESOURCE_PATH;share" in whole
