"""Topics of a workspace after remapping: each wrong topic has one finding, and right topics have none."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="cart">
  <link name="base_link"/>
  <link name="laser"/>
  <joint name="laser_joint" type="fixed"><parent link="base_link"/><child link="laser"/></joint>
  <link name="imu_link"/>
  <joint name="imu_joint" type="fixed"><parent link="base_link"/><child link="imu_link"/></joint>
  <gazebo>
    <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
      <publish_odom>true</publish_odom>
    </plugin>
  </gazebo>
  <gazebo reference="laser">
    <sensor name="lidar" type="ray">
      <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so">
        <ros><remapping>~/out:=scan</remapping></ros>
        <output_type>sensor_msgs/LaserScan</output_type>
        <frame_name>laser</frame_name>
      </plugin>
    </sensor>
  </gazebo>
  <gazebo reference="imu_link">
    <sensor name="imu" type="imu">
      <plugin name="imu" filename="libgazebo_ros_imu_sensor.so">
        <ros><remapping>~/out:=imu/data</remapping></ros>
        <frame_name>imu_link</frame_name>
      </plugin>
    </sensor>
  </gazebo>
</robot>
"""

FILES = {
    "package.xml": """<package format="3">
  <name>cart</name>
  <version>0.0.1</version>
  <description>A robot for tests.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>MIT</license>
  <exec_depend>robot_localization</exec_depend>
  <exec_depend>slam_toolbox</exec_depend>
  <exec_depend>twist_mux</exec_depend>
  <exec_depend>teleop_twist_joy</exec_depend>
  <exec_depend>base_driver</exec_depend>
</package>
""",
    "ekf.yaml": """ekf_filter_node:
  ros__parameters:
    odom0: odom
    imu0: imu/data
""",
    "slam.yaml": """slam_toolbox:
  ros__parameters:
    scan_topic: /scan
    odom_frame: odom
""",
    "mux.yaml": """twist_mux:
  ros__parameters:
    topics:
      joystick: {topic: cmd_vel_joy, timeout: 0.5, priority: 100}
""",
    "cart.launch.xml": """<launch>
  <node pkg="robot_localization" exec="ekf_node" name="ekf_filter_node">
    <param from="$(find-pkg-share cart)/ekf.yaml"/>
  </node>
  <node pkg="slam_toolbox" exec="async_slam_toolbox_node" name="slam_toolbox">
    <param from="$(find-pkg-share cart)/slam.yaml"/>
  </node>
  <node pkg="twist_mux" exec="twist_mux" name="twist_mux">
    <param from="$(find-pkg-share cart)/mux.yaml"/>
    <remap from="cmd_vel_out" to="cmd_vel"/>
  </node>
  <node pkg="teleop_twist_joy" exec="teleop_node" name="teleop">
    <remap from="cmd_vel" to="cmd_vel_joy"/>
  </node>
</launch>
""",
}

LAUNCH = "cart.launch.xml"
OUTPUT = '\n    <remap from="cmd_vel_out" to="cmd_vel"/>'
BAD = [
    (
        "ekf.yaml",
        "odom0: odom",
        "odom0: wheel/odometry",
        "K977",
        3,
        "`wheel/odometry`; did you mean `odom`?",
    ),
    ("ekf.yaml", "imu0: imu/data", "imu0: imu", "K977", 4, "`imu`; did you mean `imu/data`?"),
    ("slam.yaml", "/scan", "/front/scan", "K977", 3, "`/front/scan`; did you mean `scan`?"),
    (LAUNCH, OUTPUT, "", "K980", 8, "on `cmd_vel_out` of this node; remap it to `cmd_vel`"),
    (
        LAUNCH,
        'to="cmd_vel"',
        'to="drive/cmd_vel"',
        "K980",
        10,
        "no node subscribes to the velocity commands on `drive/cmd_vel`",
    ),
    (LAUNCH, 'to="cmd_vel_joy"', 'to="joy/cmd_vel"', "K980", 13, "`joy/cmd_vel`; did you mean `cmd_vel_joy`?"),
]
"""File, text, its replacement, code, line and a part of the message."""

DRIVER = '<launch>\n  <node pkg="base_driver" exec="driver"/>'
GOOD = [
    ("ekf.yaml", "odom0: odom", "odom0: /odom"),
    (LAUNCH, 'name="ekf_filter_node">', 'name="ekf_filter_node"><remap from="odom" to="odom"/>'),
    (LAUNCH, OUTPUT, '<remap from="/cmd_vel_out" to="/cmd_vel"/>'),
]


def findings(folder, name, old, new):
    (folder / "cart.urdf").write_text(ROBOT)
    for file, text in FILES.items():
        assert file != name or old in text
        (folder / file).write_text(text.replace(old, new, 1) if file == name else text)
    return [one for one in lint(folder, target="ros2") if one.file.endswith((".yaml", ".launch.xml"))]


@pytest.mark.parametrize(("name", "old", "new", "code", "line", "message"), BAD)
def test_each_wrong_topic_has_one_finding(tmp_path, name, old, new, code, line, message):
    [found] = findings(tmp_path, name, old, new)
    assert (found.code, found.line) == (code, line)
    assert message in found.message


@pytest.mark.parametrize(("name", "old", "new"), GOOD)
def test_right_topics_are_silent(tmp_path, name, old, new):
    assert findings(tmp_path, name, old, new) == []


def test_a_node_that_may_publish_odometry_is_trusted(tmp_path):
    (tmp_path / "cart.urdf").write_text(ROBOT)
    for file, text in FILES.items():
        (tmp_path / file).write_text(text.replace("<launch>", DRIVER).replace("odom0: odom", "odom0: wheel/odometry"))
    assert [one.code for one in lint(tmp_path, target="ros2") if one.file.endswith(".yaml")] == []


@pytest.mark.parametrize(
    ("content", "lines"),
    [('<param name="a" value="1"/>', [3]), ('<node pkg="twist_mux" exec="twist_mux" name="second"/>', [])],
)
def test_a_namespace_of_parameters_does_not_change_topics(tmp_path, content, lines):
    (tmp_path / "cart.urdf").write_text(ROBOT)
    group = f'<group ns="other">{content}</group>'
    for file, text in FILES.items():
        text = text.replace("</launch>", f"{group}</launch>").replace("scan_topic: /scan", "scan_topic: /front/scan")
        (tmp_path / file).write_text(text.replace("base_driver", "robot_state_publisher"))
    assert [one.line for one in lint(tmp_path, target="ros2") if one.code == "K977"] == lines


@pytest.mark.parametrize("has_other", [False, True])
def test_a_topic_of_a_sensor_that_other_files_name_otherwise_is_reported_at_the_sensor(tmp_path, has_other):
    (tmp_path / "cart.urdf").write_text(ROBOT.replace("imu/data<", "imu/data_raw<"))
    for file, text in FILES.items():
        text = text.replace("base_driver", "robot_state_publisher")
        if has_other:
            text = text.replace("</launch>\n", NAVSAT.format("")).replace(
                "imu0: imu/data", "imu0: imu/data\n    imu1: imu/data"
            )
        (tmp_path / file).write_text(text)
    found = [one for one in lint(tmp_path, target="ros2") if one.code == "K977"]
    messages = {
        True: ("cart.urdf", "no other file names the topic `imu/data_raw`; did you mean `imu/data`?"),
        False: ("ekf.yaml", "no other file names the topic `imu/data`; did you mean `imu/data_raw`?"),
    }
    assert [(one.file.rpartition("/")[2], one.message) for one in found] == [messages[has_other]]


GPS = """  <link name="gps"/>
  <joint name="gps_joint" type="fixed"><parent link="base_link"/><child link="gps"/></joint>
  <gazebo reference="gps">
    <sensor name="gps" type="gps">
      <plugin name="gps" filename="libgazebo_ros_gps_sensor.so">
        <ros><namespace>gps</namespace><remapping>~/out:={}</remapping></ros>
      </plugin>
    </sensor>
  </gazebo>
</robot>
"""
NAVSAT = """  <node pkg="robot_localization" exec="navsat_transform_node" name="navsat_transform">
    <remap from="imu" to="imu/data"/>{}
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("topic", "remapping", "driver", "is_reported"),
    [
        ("fix", "", "", False),
        ("position", "", "", True),
        ("position", '<remap from="gps/fix" to="gps/position"/>', "", False),
        ("position", "", '<node pkg="base_driver" exec="driver"/>', False),
    ],
)
def test_the_receiver_publishes_the_positions_that_navsat_transform_reads(
    tmp_path, topic, remapping, driver, is_reported
):
    (tmp_path / "cart.urdf").write_text(ROBOT.replace("</robot>\n", GPS.format(topic)))
    for file, text in FILES.items():
        text = text.replace("base_driver", "robot_state_publisher").replace("</launch>\n", NAVSAT.format(remapping))
        (tmp_path / file).write_text(text.replace("<launch>\n", f"<launch>{driver}\n"))
    found = [one.message for one in lint(tmp_path, target="ros2") if one.code == "K977"]
    message = (
        "no other file names the topic `gps/fix`, which `navsat_transform_node` reads; did you mean `gps/position`?"
    )
    assert found == ([message] if is_reported else [])
