"""Filters and parameters of navigation that contradict the motion of the base: each has one finding."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

MANIFEST = """<package format="3"><name>barge</name><version>1.0.0</version><description>A barge.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license><exec_depend>xacro</exec_depend>
  <exec_depend>nav2_amcl</exec_depend><exec_depend>nav2_controller</exec_depend><exec_depend>CONTROLLER</exec_depend>
  <exec_depend>nav2_velocity_smoother</exec_depend><exec_depend>robot_localization</exec_depend>
  <export><build_type>ament_cmake</build_type></export></package>"""
ROBOT = """<robot name="barge"><link name="base_link"/></robot>"""
MECANUM = """controller_manager:
  ros__parameters:
    drive: {type: mecanum_drive_controller/MecanumDriveController}
drive:
  ros__parameters: {enable_odom_tf: false}
"""
DIFFERENTIAL = MECANUM.replace("mecanum_drive", "diff_drive").replace("Mecanum", "Diff")
FILTER = """ekf_filter_node:
  ros__parameters:
    odom_frame: odom
    world_frame: odom
    map_frame: map
    base_link_frame: base_link
    two_d_mode: true
    odom0: drive/odom
    odom0_config: [false, false, false,
                   false, false, false,
                   true, true, false,
                   false, false, true,
                   false, false, false]
    frequency: 30.0
    process_noise_covariance: [0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1, 0.1]
"""
NAVIGATION = """amcl:
  ros__parameters:
    transform_tolerance: 0.3
    robot_model_type: nav2_amcl::OmniMotionModel
controller_server:
  ros__parameters:
    FollowPath:
      plugin: nav2_mppi_controller::MPPIController
      motion_model: Omni
      vy_max: 0.4
velocity_smoother:
  ros__parameters:
    smoothing_frequency: 20.0
    max_velocity: [0.5, 0.4, 1.0]
    min_velocity: [-0.5, -0.4, -1.0]
"""
SIDEWAYS = {"control.yaml": MECANUM, "ekf.yaml": FILTER, "nav2.yaml": NAVIGATION}
FORWARDS = SIDEWAYS | {
    "control.yaml": DIFFERENTIAL,
    "nav2.yaml": NAVIGATION.replace("OmniM", "DifferentialM").replace("model: Omni", "model: DiffDrive"),
}
UNUSED = SIDEWAYS | {
    "nav2.yaml": FORWARDS["nav2.yaml"].replace("[0.5, 0.4", "[0.5, 0.0").replace("[-0.5, -0.4", "[-0.5, 0.0")
}
MISTAKES = [
    (SIDEWAYS, "ekf.yaml", "true, true,", "true, false,", "K983", 11, "`odom0_config` does not fuse vy"),
    (SIDEWAYS, "nav2.yaml", "OmniM", "DifferentialM", "K982", 4, "but the base can move sideways"),
    (SIDEWAYS, "nav2.yaml", "model: Omni", "model: DiffDrive", "K982", 9, "`motion_model` is DiffDrive"),
    (SIDEWAYS, "nav2.yaml", "vy_max: 0.4", "vy_max: 0.0", "K982", 10, "`vy_max` is 0.0, but the base can"),
    (SIDEWAYS, "nav2.yaml", "[-0.5, -0.4", "[-0.5, 0.0", "K982", 15, "y of `min_velocity` is 0.0, but the base can"),
    (FORWARDS, "ekf.yaml", "true, true,", "false, true,", "K983", 11, "`odom0_config` does not fuse vx; x drifts"),
    (FORWARDS, "ekf.yaml", "false, false, true,", "false, false, false,", "K983", 12, "does not fuse vyaw; yaw drifts"),
    (FORWARDS, "ekf.yaml", "mode: true", "mode: false", "K983", 7, "no input fuses z or vz"),
    (FORWARDS, "ekf.yaml", "config: [false, false", "config: [true, true", "K983", 9, "fuse the velocities only"),
    (FORWARDS, "ekf.yaml", "[0.1, 0.1, ", "[0.1, ", "K971", 15, "has 14 values; it must have 15 or 225"),
    (FORWARDS, "nav2.yaml", "DifferentialM", "OmniM", "K982", 4, "but the base cannot move sideways"),
    (FORWARDS, "nav2.yaml", "model: DiffDrive", "model: Omni", "K982", 9, "but the base cannot move sideways"),
]
"""Files, file, text, its replacement, code, line and a part of the message."""


def findings(folder, files, name="", old="", new=""):
    kind = "mecanum_drive_controller" if files["control.yaml"] is MECANUM else "diff_drive_controller"
    for file, text in ({"barge.urdf": ROBOT, "package.xml": MANIFEST.replace("CONTROLLER", kind)} | files).items():
        assert file != name or old in text, old
        (folder / file).write_text(text.replace(old, new, 1) if file == name else text)
    return [one for one in lint(folder) if one.code in ("K971", "K982", "K983")]


@pytest.mark.parametrize("files", [SIDEWAYS, FORWARDS, UNUSED], ids=["sideways", "forwards", "unused"])
def test_consistent_settings_are_silent(tmp_path, files):
    assert findings(tmp_path, files) == []


@pytest.mark.parametrize(("files", "name", "old", "new", "code", "line", "message"), MISTAKES)
def test_each_contradiction_has_one_finding(tmp_path, files, name, old, new, code, line, message):
    [found] = findings(tmp_path, files, name, old, new)
    assert (found.code, found.line) == (code, line)
    assert message in found.message


SLOW = FORWARDS | {"ekf.yaml": FILTER.replace("frequency: 30.0", "frequency: 2.0")}
TOLERANCE = "{}:\n  ros__parameters:\n    {{{}}}\n"
COSTMAP = "global_frame: map\nrobot_base_frame: base_link\nfootprint_padding: 0.0\ntransform_tolerance: 0.3\n"


@pytest.mark.parametrize(
    ("text", "is_reported"),
    [
        (TOLERANCE.format("amcl", "transform_tolerance: 0.3"), False),
        (TOLERANCE.format("bridge", "transform_tolerance: 0.3"), False),
        (TOLERANCE.format("local_costmap", "transform_tolerance: 0.3"), True),
        (TOLERANCE.format("local_costmap", "transform_tolerance: 0.6"), False),
        (TOLERANCE.format("controller_server", "FollowPath: {transform_tolerance: 0.3}"), True),
        (TOLERANCE.format("behavior_server", "transform_tolerance: 0.3"), True),
        (TOLERANCE.format("collision_monitor", "transform_tolerance: 0.3"), True),
        (COSTMAP, True),
        ("transform_tolerance: 0.3\n", False),
    ],
)
def test_the_rate_of_a_filter_suits_the_transforms_that_navigation_accepts(tmp_path, text, is_reported):
    found = [one for one in findings(tmp_path, SLOW | {"tolerance.yaml": text}) if one.code == "K983"]
    assert [one.line for one in found] == ([14] if is_reported else [])
    assert all("in tolerance.yaml is 0.3 s: transforms are older than that" in one.message for one in found)


def test_transforms_with_a_time_in_the_future_are_not_too_old(tmp_path):
    offset = {"ekf.yaml": SLOW["ekf.yaml"].replace("frequency", "transform_time_offset: 0.3\n    frequency")}
    tolerance = {"tolerance.yaml": TOLERANCE.format("local_costmap", "transform_tolerance: 0.3")}
    assert [one.code for one in findings(tmp_path, SLOW | offset | tolerance) if one.code == "K983"] == []


def test_a_rate_suits_the_files_of_its_own_robot(tmp_path):
    tolerance = {"tolerance.yaml": TOLERANCE.format("local_costmap", "transform_tolerance: 0.3")}
    loads = '<gazebo><plugin name="c" filename="libgazebo_ros2_control.so"><parameters>$(find barge)/{}</parameters>'
    end = "</plugin></gazebo></robot>"
    raft = {"raft.urdf": ROBOT.replace("</robot>", loads.format("tolerance.yaml") + end)}
    findings(tmp_path, SLOW | tolerance | raft)
    (tmp_path / "barge.urdf").write_text(ROBOT.replace("</robot>", loads.format("control.yaml") + end))
    assert [one.code for one in lint(tmp_path / "barge.urdf") if one.code == "K983"] == []


def test_a_row_of_a_covariance_in_ros1(tmp_path):
    rows = "\n".join(f"  {', '.join(['0.0'] * (14 if row == 3 else 15))}," for row in range(15))
    frames = "world_frame: odom\nodom_frame: odom\nbase_link_frame: base_link\n"
    files = {"package.xml": MANIFEST, "barge.urdf": ROBOT, "ekf.yaml": f"{frames}process_noise_covariance: [\n{rows}]"}
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    [found] = [one for one in lint(tmp_path) if one.file.endswith(".yaml")]
    assert (found.code, found.line) == ("K971", 8)
    assert "has 224 values; it must have 225" in found.message


@pytest.mark.parametrize(("count", "is_complete"), [(15, False), (225, True)])
def test_a_covariance_in_ros1_is_a_full_matrix(tmp_path, count, is_complete):
    frames = "world_frame: odom\nodom_frame: odom\nbase_link_frame: base_link\n"
    values = f"initial_estimate_covariance: [{', '.join(['0.0'] * count)}]\n"
    for name, text in {"package.xml": MANIFEST, "barge.urdf": ROBOT, "ekf.yaml": frames + values}.items():
        (tmp_path / name).write_text(text)
    found = [(one.code, one.line) for one in lint(tmp_path) if one.file.endswith(".yaml")]
    assert found == ([] if is_complete else [("K971", 4)])


def test_two_drives_of_different_kinds_decide_nothing(tmp_path):
    second = {"other.yaml": DIFFERENTIAL.replace("drive:", "wheels:")}
    assert findings(tmp_path, SIDEWAYS | second, "nav2.yaml", "model: Omni", "model: DiffDrive") == []


@pytest.mark.parametrize(("library", "count"), [("gazebo_ros_planar_move", 0), ("gazebo_ros_diff_drive", 2)])
def test_another_robot_of_the_package_with_the_other_kind_of_drive(tmp_path, library, count):
    plugin = f'<gazebo><plugin name="move" filename="lib{library}.so"/></gazebo></robot>'
    other = {"raft.urdf": ROBOT.replace("barge", "raft").replace("</robot>", plugin)}
    found = findings(tmp_path, FORWARDS | other | {"nav2.yaml": NAVIGATION})
    assert [one.code for one in found] == ["K982"] * count


@pytest.mark.parametrize(("file", "codes"), [("nav2.yaml", []), ("none.yaml", ["K982"])])
def test_parameters_that_only_another_robot_loads_contradict_nothing(tmp_path, file, codes):
    loads = '<gazebo><plugin name="c" filename="libgazebo_ros2_control.so"><parameters>$(find barge)/{}</parameters>'
    plugins = {name: f"{loads.format(name)}</plugin></gazebo></robot>" for name in ("control.yaml", file)}
    raft = {"raft.urdf": ROBOT.replace("barge", "raft").replace("</robot>", plugins[file])}
    findings(tmp_path, FORWARDS | raft, "nav2.yaml", "model: DiffDrive", "model: Omni")
    (tmp_path / "barge.urdf").write_text(ROBOT.replace("</robot>", plugins["control.yaml"]))
    assert [one.code for one in lint(tmp_path / "barge.urdf") if one.code == "K982"] == codes


WHEEL = """<link name="{name}"/><joint name="{name}_joint" type="continuous"><parent link="base_link"/>
  <child link="{name}"/><origin xyz="{xyz}"/><axis xyz="0 1 0"/></joint>
  <gazebo reference="{name}"><collision><surface><friction><ode><mu>{mu}</mu><mu2>{mu2}</mu2>
  <fdir1 gz:expressed_in="base_link">{along}</fdir1></ode></friction></surface></collision></gazebo>
"""
ROLLERS = {"0.3 0.2 0": "1 -1 0", "0.3 -0.2 0": "1 1 0", "-0.3 0.2 0": "1 1 0", "-0.3 -0.2 0": "1 -1 0"}
ACROSS = {"1 1 0": "1 -1 0", "1 -1 0": "1 1 0"}


@pytest.mark.parametrize(
    ("mu", "mu2", "across", "count", "message"),
    [
        (1, 0, (), 0, ""),
        (0, 1, (0, 1, 2, 3), 0, ""),
        (1, 0, (2,), 1, "<fdir1> of mecanum wheel `w2` points across its rollers"),
        (0, 1, (), 4, "<mu> along <fdir1> is less than <mu2>"),
        (1, 0, (0, 1, 2, 3), 4, "points across its rollers"),
    ],
)
def test_mecanum_wheels_pull_along_their_rollers(tmp_path, mu, mu2, across, count, message):
    wheels = "".join(
        WHEEL.format(name=f"w{at}", xyz=xyz, mu=mu, mu2=mu2, along=ACROSS[along] if at in across else along)
        for at, (xyz, along) in enumerate(ROLLERS.items())
    )
    robot = f'<robot name="barge" xmlns:gz="http://gazebosim.org/schema"><link name="base_link"/>{wheels}</robot>'
    (tmp_path / "barge.urdf").write_text(robot)
    messages = [one.message for one in lint(tmp_path / "barge.urdf", select=("S914",))]
    assert len(messages) == count
    assert all(message in each for each in messages)


DOCKING = """docking_server:
  ros__parameters:
    enable_stamped_cmd_vel: true
    dock_plugins: [charger]
    docks: [home]
    home: {type: charger, frame: map, pose: [0.0, 0.0, 0.0]}
    charger: {plugin: opennav_docking::SimpleChargingDock}
controller_server:
  ros__parameters: {enable_stamped_cmd_vel: true}
behavior_server:
  ros__parameters: {enable_stamped_cmd_vel: true}
"""


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("type: charger", "type: chargers", 6, "`dock_plugins` has no `chargers`; did you mean `charger`?"),
        (
            "server:\n  ros__parameters: {enable_stamped_cmd_vel: true",
            "server:\n  ros__parameters: {enable_stamped_cmd_vel: false",
            9,
            "is false, but true for the other nodes",
        ),
    ],
)
def test_docks_and_stamps_of_a_file_agree(tmp_path, old, new, line, message):
    (tmp_path / "right").mkdir()
    assert findings(tmp_path / "right", FORWARDS | {"docking.yaml": DOCKING}) == []
    [found] = findings(tmp_path, FORWARDS | {"docking.yaml": DOCKING}, "docking.yaml", old, new)
    assert (found.code, found.line) == ("K971", line)
    assert message in found.message


def test_limits_of_an_axis_along_which_a_differential_drive_does_not_move(tmp_path):
    limits = FORWARDS | {"control.yaml": DIFFERENTIAL.replace("false}", "false, linear: {x: {max_velocity: 1.0}}}")}
    [found] = findings(tmp_path, limits, "control.yaml", "{x: {max", "{y: {max")
    assert (found.code, found.line) == ("K971", 5)
    assert "does not read `y` of `linear`; write `x`" in found.message


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("linear.x", "linear.y", "does not read `linear.y.max_velocity`; write `linear.x.max_velocity`"),
        ("angular.z", "angular.x", "does not read `angular.x.max_velocity`; write `angular.z.max_velocity`"),
        ("linear.x.max_velocity: 1.0", "linear: {'': 1.0}", None),
    ],
)
def test_limits_of_an_axis_in_names_with_dots(tmp_path, old, new, message):
    values = "false, linear.x.max_velocity: 1.0, angular.z.max_velocity: 1.0}"
    limits = FORWARDS | {"control.yaml": DIFFERENTIAL.replace("false}", values)}
    found = [
        one.message for one in findings(tmp_path, limits, "control.yaml", old, new) if "does not read" in one.message
    ]
    assert [message in one if message else one for one in found] == ([True] if message else [])


SCANNER = """<robot name="barge"><link name="base_link"/><gazebo reference="base_link"><sensor name="lidar" type="ray">
  <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so"><ros><remapping>~/out:=scan</remapping></ros>
  <output_type>sensor_msgs/LaserScan</output_type></plugin></sensor></gazebo></robot>"""
MONITOR = """collision_monitor:
  ros__parameters:
    observation_sources: [bow]
    bow:
      topic: scan
      type: scan
      min_height: 0.1
"""


@pytest.mark.parametrize(("kind", "lines"), [("scan", []), ("pointcloud", [6])])
def test_the_type_of_a_source_is_compared_with_its_topic(tmp_path, kind, lines):
    files = {
        "barge.urdf": SCANNER,
        "package.xml": MANIFEST,
        "nav2.yaml": MONITOR.replace("type: scan", f"type: {kind}"),
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text)
    assert [one.line for one in lint(tmp_path) if one.code == "K985"] == lines
