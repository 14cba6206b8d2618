"""`urdfkit new sensor`: the sensor is there and publishes, and every byte that a person wrote is still there."""

import math
import shutil

import pytest
import yaml

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.errors import ResourceError
from urdfkit.lint import lint
from urdfkit.resources import find_model, robots_dir
from urdfkit.scaffold.additions.free_placement import Part, spot
from urdfkit.scaffold.additions.link_boxes import Boxes
from urdfkit.scaffold.additions.package_manifest import with_installed
from urdfkit.scaffold.additions.sensor_macro import GENERATIONS, KINDS, sensor_macro
from urdfkit.scaffold.additions.xml_insertion import insert_before_end
from urdfkit.sim import Simulator

URDF = """<?xml version="1.0"?>
<!-- a robot -->
<robot name="cart">
  <link name="base">
    <inertial><mass value="2"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
    <visual><origin rpy="${lying} 0 0"/><geometry><cylinder radius="0.1" length="0.4"/></geometry></visual>
    <collision><origin rpy="${lying} 0 0"/><geometry><cylinder radius="0.1" length="0.4"/></geometry></collision>
  </link>
</robot>
""".replace("${lying}", str(math.pi / 2))


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def new(kind, into, *options):
    return main(["new", "sensor", kind, "--into", str(into), *options])


def everything(folder):
    return {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def robot(place, ros):
    """Copy a new robot, made once for all tests."""
    made = place.parent / f"robot_of_{ros}"
    if not made.is_dir():
        assert main(["new", "robot", "scout", "--ros", ros, "--into", str(made), "--no-picture", "--yes"]) == 0
    shutil.copytree(made, place, dirs_exist_ok=True)
    return place / "scout_description"


def published(simulator, topics, seconds):
    """Return how many messages come on each topic."""
    heard = {}
    for topic in simulator.bus.topics:
        if topic.name in topics:
            simulator.bus.subscribe(topic.name, topic.type, heard.setdefault(topic.name, []).append)
    simulator.run(seconds)
    return {name: len(messages) for name, messages in heard.items()}


@pytest.mark.slow
@pytest.mark.parametrize("ros", ["jazzy", "humble", "noetic"])
def test_every_sensor_is_added_and_lints_clean(place, ros):
    folder = robot(place, ros)
    for kind in KINDS:
        assert new(kind, folder) == 0
    assert [str(finding) for finding in lint([folder]) if finding.severity != "note"] == []
    found = load(find_model([str(folder)]).path)
    assert {sensor.name for block in found.gazebo for sensor in block.sensors} >= {"lidar", "camera", "imu"}
    assert {f"{kind}_link" for kind in KINDS} <= set(found.link_by_name)


@pytest.mark.parametrize("generation", GENERATIONS)
@pytest.mark.parametrize("kind", list(KINDS))
def test_a_macro_has_everything_as_parameters(kind, generation):
    text = sensor_macro(kind, generation)
    for leftover in (
        f"{kind}_link",
        f"{kind}_joint",
        "base_link",
        "base_length",
        "@",
        "box_inertial",
    ):
        assert leftover not in text.replace("${name}", "")
    assert text.count("${topic}") >= 1
    assert "${update_rate}" in text


@pytest.mark.parametrize(
    ("ros", "kind", "topics"),
    [
        ("jazzy", "lidar", {"/front/scan": 5}),
        ("noetic", "lidar", {"/front/scan": 5}),
        ("jazzy", "depth", {"/front/image": 7, "/front/points": 7}),
        ("noetic", "imu", {"/front/imu": 50}),
    ],
)
def test_it_publishes(place, ros, kind, topics):
    folder = robot(place, ros)
    assert new(kind, folder, "--name", "front") == 0
    simulator = Simulator(load(find_model([str(folder)]).path), note=lambda _: None)
    heard = published(simulator, topics, 0.5)
    assert heard == {topic: pytest.approx(count, abs=1) for topic, count in topics.items()}


def test_rate_topic_and_place_are_as_told(place):
    folder = robot(place, "jazzy")
    options = ["--topic", "a/b", "--update-rate", "25", "--xyz", "0.1", "-0.02", "0.3", "--rpy", "0", "-0.5", "0"]
    assert new("lidar", folder, "--name", "x", *options) == 0
    found = load(find_model([str(folder)]).path)
    assert (found.joint_by_name["x_joint"].origin.xyz, found.joint_by_name["x_joint"].origin.rpy) == (
        (0.1, -0.02, 0.3),
        (0, -0.5, 0),
    )
    simulator = Simulator(found, note=lambda _: None)
    assert published(simulator, ["/a/b"], 0.4) == {"/a/b": pytest.approx(10, abs=1)}


def test_a_namespace_is_kept(place):
    folder = robot(place, "noetic")
    drive = folder / "urdf/gazebo.xacro"
    drive.write_text(
        drive.read_text().replace("<commandTopic>", "<robotNamespace>/fleet</robotNamespace>\n<commandTopic>")
    )
    assert "/fleet" in drive.read_text()
    for name in ("front", "rear"):
        assert new("lidar", folder, "--name", name, "--xyz", "0", "0", "0.2" if name == "front" else "0.3") == 0
    text = (folder / "urdf/scout.urdf.xacro").read_text()
    assert 'topic="fleet/front/scan"' in text
    assert 'topic="fleet/rear/scan"' in text


def test_two_of_a_kind_share_a_macro(place):
    folder = robot(place, "jazzy")
    assert new("lidar", folder, "--name", "front", "--xyz", "0.1", "0", "0.2") == 0
    assert new("lidar", folder, "--name", "rear", "--xyz", "-0.1", "0", "0.3") == 0
    text = (folder / "urdf/scout.urdf.xacro").read_text()
    assert text.count("lidar_sensor.xacro") == 1
    assert text.count("<xacro:lidar_sensor ") == 2


@pytest.mark.parametrize("name", ["mybot", "seven_dof_arm", "diff_wheeled_robot", "bot", "rrbot", "simpleton"])
def test_the_robots_of_tutorials_keep_every_byte(place, name):
    shutil.copytree(robots_dir() / name, place / name)
    folder = place / name / f"{name}_description"
    path = folder / f"urdf/{name}.urdf.xacro"
    before = everything(place)
    assert new("imu", path, "--name", "extra_imu") == 0
    after = everything(place)
    changed = {file for file in after if before.get(file) != after[file]}
    assert path.relative_to(place) in changed
    for file in changed:
        if file in before:
            kept = iter(after[file].splitlines(keepends=True))
            assert all(line in kept for line in before[file].splitlines(keepends=True))  # in order, nothing lost
    assert "extra_imu_link" in load(path).link_by_name


@pytest.mark.parametrize(("newline", "indent"), [("\r\n", "\t"), ("\n", "    ")])
def test_line_ends_indentation_and_encoding_stay(newline, indent):
    head = f'\ufeff<?xml version="1.0"?>{newline}<robot name="é">{newline}{indent}<link name="a"/>{newline}'
    tail = f"</robot> <!-- </robot> -->{newline}<!-- end -->"
    content = head.encode() + b"<!-- \xe9 -->" + newline.encode() + tail.encode()
    found = insert_before_end(content, '<a>\n  <b c="1"/>\n</a>', path=None)
    added = newline.join([f"{indent}<a>", f'{indent}{indent}<b c="1"/>', f"{indent}</a>", ""]).encode()
    at = content.index(b"</robot> <!--")
    assert found == content[:at] + added + content[at:]


def test_an_end_tag_in_a_line_with_others():
    assert insert_before_end(b'<robot><link name="a"/></robot>', "<b/>", path=None) == (
        b'<robot><link name="a"/>\n  <b/>\n</robot>'
    )
    with pytest.raises(ResourceError, match="has no </robot>"):
        insert_before_end(b'<robot name="a"/>', "<b/>", path="x.urdf")


def test_a_urdf_without_xacro_gets_plain_elements(place):
    path = place / "cart.urdf"
    path.write_text(URDF)
    assert new("camera", path) == 0
    text = path.read_text()
    assert text.startswith(URDF.removesuffix("</robot>\n"))
    assert text.endswith("  </gazebo>\n</robot>\n")
    assert "xacro" not in text
    assert list(place.iterdir()) == [path]
    assert load(path).joint_by_name["camera_joint"].origin.xyz == (0.12, 0, 0.085)


def test_the_default_place_is_on_what_is_seen(place):
    path = place / "cart.urdf"
    path.write_text(URDF)
    cart = load(path)
    (base,) = cart.links
    own = Boxes(cart).of(base)
    box = ((-0.02, -0.01, -0.05), (0.01, 0.01, 0.015))
    assert spot(own, Part((box,), box, "top")) == (0, 0, 0.15)  # the cylinder lies
    assert spot(own, Part((box,), box, "front")) == (0.12, 0, 0.085)
    assert spot(own, Part((box,), box, "middle")) == (0, 0, 0)


def test_diff_changes_nothing(place, capsys):
    folder = robot(place, "jazzy")
    before = everything(place)
    capsys.readouterr()
    assert new("lidar", folder, "--diff") == 0
    reported = capsys.readouterr().out
    assert '+  <xacro:include filename="lidar_sensor.xacro"/>' in reported
    assert everything(place) == before


def test_the_bridge_is_reported(place):
    folder = robot(place, "jazzy")
    assert new("camera", folder, "--name", "eye") == 0
    topics = [
        entry["ros_topic_name"] for entry in yaml.safe_load((place / "scout_gazebo/config/bridge.yaml").read_text())
    ]
    assert {"eye/image_raw", "eye/camera_info"} <= set(topics)


def test_what_is_installed_by_name_gets_a_neighbour(place):
    folder = robot(place, "noetic")
    cmake = folder / "CMakeLists.txt"
    cmake.write_text(
        cmake.read_text().replace("DIRECTORY launch rviz urdf", "DIRECTORY launch rviz")
        + "\ninstall(FILES\n  urdf/scout.urdf.xacro\n  DESTINATION ${CATKIN_PACKAGE_SHARE_DESTINATION}/urdf)\n"
    )
    assert new("gps", folder) == 0
    assert "\n  urdf/gps_sensor.xacro\n  urdf/scout.urdf.xacro\n  DESTINATION" in cmake.read_text()  # in order
    assert "  <exec_depend>hector_gazebo_plugins</exec_depend>\n" in (folder / "package.xml").read_text()


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            "(FILES urdf/a.xacro urdf/z.xacro DESTINATION x)",
            "(FILES urdf/a.xacro urdf/m.xacro urdf/z.xacro DESTINATION x)",
        ),
        ("(FILES urdf/a.xacro\n  DESTINATION x)", "(FILES urdf/a.xacro urdf/m.xacro\n  DESTINATION x)"),
        (
            "(files\r\n\turdf/a.xacro\r\n\tDESTINATION x)",
            "(files\r\n\turdf/a.xacro\r\n\turdf/m.xacro\r\n\tDESTINATION x)",
        ),
        (
            "(FILES\n  urdf/z.xacro  # first\n  urdf/a.xacro\n  urdf/b.xacro\n  DESTINATION x)",
            "(FILES\n  urdf/z.xacro  # first\n  urdf/a.xacro\n  urdf/m.xacro\n  urdf/b.xacro\n  DESTINATION x)",
        ),
        ('(PROGRAMS "urdf/a.xacro" DESTINATION x)', '(PROGRAMS "urdf/a.xacro" urdf/m.xacro DESTINATION x)'),
        ("(FILES urdf/a.xacro urdf/m.xacro DESTINATION x)", None),
        ("(FILES urdf/aa.xacro DESTINATION urdf/a.xacro)", None),
        ("(DIRECTORY urdf DESTINATION x)", None),
    ],
)
def test_where_a_new_file_goes_among_those_that_are_installed(tmp_path, before, after):
    (tmp_path / "CMakeLists.txt").write_bytes(f"project(x)\ninstall{before}\n".encode())
    change = with_installed(tmp_path, tmp_path / "urdf/a.xacro", tmp_path / "urdf/m.xacro")
    assert (change and change.after) == (after and f"project(x)\ninstall{after}\n".encode())


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["lidar", "--parent", "base_lnk"], "did you mean `base_link`?"),
        (["lidr"], "did you mean `lidar`?"),
        (["laser"], "unknown sensor `laser`; did you mean `lidar`?"),
        ([], "pass a sensor: lidar, "),
        (["--kind", "lidar"], "unrecognized arguments: --kind; it is a positional argument: urdfkit new sensor SENSOR"),
        (["lidar", "--rate", "5"], "did you mean `--update-rate`?"),
        (["lidar", "--xyz", "0,0,1"], "expected 3 arguments: three numbers separated by spaces"),
        (["lidar", "scout_description"], "did you mean `--into scout_description`?"),
        (["lidar", "--into", "scout"], "did you mean `scout_description`?"),
        (["lidar", "--name", "left_wheel"], "already has a `left_wheel_joint`"),
        (["lidar", "--name", "a b"], "letters, digits and underscores"),
        (["lidar", "--topic", "a//b"], "is not a valid topic"),
        (["lidar", "--xyz", "a", "0", "0"], "--xyz: `a` is not a number"),
        (["lidar", "--update-rate", "0"], "out of range"),
        (["lidar", "--updaterate", "5"], "did you mean `--update-rate`?"),
        (["lidar", "--into", "scout_descripton"], "did you mean `scout_description`?"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_changed(place, capsys, options, says):
    robot(place, "jazzy")
    before = everything(place)
    capsys.readouterr()
    into = [] if "--into" in options else ["--into", "scout_description"]
    assert main(["new", "sensor", *options, *into]) == 2
    reported = capsys.readouterr().err
    assert says in reported
    assert reported.count("\n") == 1
    assert everything(place) == before


def test_where_there_is_no_robot_it_says_which_option(place, capsys):
    assert main(["new", "sensor", "lidar"]) == 2
    assert capsys.readouterr().err.startswith("urdfkit: no robot is named, and there is no robot description")


def test_the_same_name_twice_is_refused(place, capsys):
    folder = robot(place, "jazzy")
    assert new("lidar", folder, "--name", "eye") == 0
    before = everything(place)
    assert new("lidar", folder, "--name", "eye") == 2
    assert "nothing was changed; choose another --name" in capsys.readouterr().err
    assert everything(place) == before


def test_somebody_elses_file_is_left_alone(place, capsys):
    folder = robot(place, "jazzy")
    (folder / "urdf/lidar_sensor.xacro").write_text("<robot/>")
    assert new("lidar", folder) == 2
    assert "already exists and has no macro `lidar_sensor`" in capsys.readouterr().err


def test_a_topic_that_is_taken_is_refused(place, capsys):
    folder = robot(place, "jazzy")
    assert new("lidar", folder, "--name", "a") == 0
    before = everything(place)
    assert new("lidar", folder, "--name", "b", "--topic", "a/scan") == 2
    assert "already publishes `a/scan`" in capsys.readouterr().err
    assert everything(place) == before


def test_numbers_arrive_as_typed(place):
    (place / "cart.urdf").write_text(URDF)
    assert new("imu", "cart.urdf", "--xyz", "-0.25123456", "0", "0.3", "--rpy", "0", "0", "3.141592653589793") == 0
    assert '<origin rpy="0 0 3.141592653589793" xyz="-0.25123456 0 0.3"/>' in (place / "cart.urdf").read_text()
