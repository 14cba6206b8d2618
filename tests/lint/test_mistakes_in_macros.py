"""Mistakes in robots of macros: one finding for each, at the line that has to be edited."""

import pytest

from urdfkit.lint import lint

ROBOT = """<robot name="rover" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="half" value="0.2"/>
  <xacro:macro name="wheel" params="name parent x sign">
    <link name="${name}_wheel">
      <visual><geometry>
        <box size="0.2 0.1 0.2"/>
      </geometry></visual>
      <collision><geometry>
        <box size="0.2 0.1 0.2"/>
      </geometry></collision>
    </link>
    <joint name="${name}_wheel_joint" type="continuous">
      <parent link="${parent}"/>
      <child link="${name}_wheel"/>
      <origin xyz="${x} ${sign * 0.1} 0"/>
      <axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="side" params="side sign turn:=40">
    <link name="${side}_beam">
      <collision><geometry><box size="0.5 0.05 0.05"/></geometry></collision>
    </link>
    <joint name="${side}_beam_joint" type="revolute">
      <parent link="base"/>
      <child link="${side}_beam"/>
      <origin xyz="0 ${sign * 0.3} 0"/>
      <axis xyz="0 1 0"/>
      <limit lower="${radians(-turn)}" upper="${radians(turn)}" effort="5" velocity="2"/>
      <safety_controller soft_lower_limit="-0.5" soft_upper_limit="0.5" k_velocity="1"/>
    </joint>
    <xacro:wheel name="${side}_front" parent="${side}_beam" x="${half}" sign="${sign}"/>
    <xacro:wheel name="${side}_rear" parent="${side}_beam" x="${-half}" sign="${sign}"/>
  </xacro:macro>
  <xacro:macro name="velocities" params="side">
    <joint name="${side}_front_wheel_joint"><command_interface name="velocity"/></joint>
    <joint name="${side}_rear_wheel_joint"><command_interface name="velocity"/></joint>
  </xacro:macro>
  <link name="base"><collision><geometry><box size="0.6 0.4 0.2"/></geometry></collision></link>
  <xacro:side side="left" sign="1"/>
  <xacro:side side="right" sign="-1"/>
  <link name="imu_link"/>
  <joint name="imu_joint" type="fixed"><parent link="base"/><child link="imu_link"/></joint>
  <link name="gps_link"/>
  <joint name="gps_joint" type="fixed"><parent link="base"/><child link="gps_link"/><origin xyz="0.2 0 0.1"/></joint>
  <gazebo reference="imu_link">
    <sensor name="imu" type="imu"><update_rate>50</update_rate><gz_frame_id>imu_link</gz_frame_id></sensor>
  </gazebo>
  <gazebo reference="gps_link">
    <sensor name="gps" type="gps"><update_rate>5</update_rate>
      <gz_frame_id>gps_link</gz_frame_id>
    </sensor>
    <sensor name="eye" type="camera"><camera>
      <horizontal_fov>1.2</horizontal_fov>
      <image><width>640</width><height>480</height></image><clip><near>0.1</near><far>9</far></clip>
    </camera></sensor>
  </gazebo>
  <gazebo reference="left_front_wheel">
    <mu1>1</mu1>
    <mu2>1</mu2>
  </gazebo>
  <gazebo>
    <plugin name="gz::sim::systems::DiffDrive" filename="gz-sim-diff-drive-system">
      <left_joint>left_front_wheel_joint</left_joint><left_joint>left_rear_wheel_joint</left_joint>
      <right_joint>right_front_wheel_joint</right_joint><right_joint>right_rear_wheel_joint</right_joint>
      <wheel_separation>0.8</wheel_separation>
    </plugin>
  </gazebo>
  <ros2_control name="rover" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <xacro:velocities side="left"/>
    <xacro:velocities side="right"/>
  </ros2_control>
</robot>
"""
CODES = ("C721", "G620", "J405", "J407", "J420", "S907", "S909", "S914", "Z823", "Z835")
WHEEL = 'name="${side}_rear" parent="${side}_beam" '


@pytest.mark.parametrize(
    ("change", "code", "marked"),
    [
        (('parent="${side}_beam" x="${-half}"', 'parent="left_beam" x="${-half}"'), "S909", 'parent="left_beam"'),
        (('x="${-half}"', 'x="${half}"'), "S907", WHEEL + 'x="${half}"'),
        (('side="right" sign="-1"', 'side="right" sign="1"'), "S907", 'side="right" sign="1"'),
        (("turn:=40", "turn:=0.72"), "J407", "turn:=0.72"),
        (("-0.5", "-5.1"), "J420", 'soft_lower_limit="-5.1"'),
        (('-0.5" soft_upper_limit="0.5"', '-5.1" soft_upper_limit="5.1"'), "J420", 'soft_lower_limit="-5.1"'),
        (
            ('0.2 0.1 0.2"/>\n      </geometry></coll', '0.2 0.2 0.1"/>\n      </geometry></coll'),
            "G620",
            '"0.2 0.2 0.1"',
        ),
        (("<gz_frame_id>gps_link", "<gz_frame_id>imu_link"), "Z835", "      <gz_frame_id>imu_link"),
        (('<gazebo reference="imu_link">', '<gazebo reference="gps_link" >'), "Z835", 'reference="gps_link" >'),
        (("<mu2>1", "<mu2>0"), "S914", "<mu2>0"),
        (("fov>1.2<", "fov>${radians(1.2)}<"), "Z823", "<horizontal_fov>"),
        (('<xacro:velocities side="right"/>', '<xacro:velocities side="left" />'), "C721", 'side="left" />'),
    ],
    ids=["side", "end", "sign", "radians", "limit", "limits", "sizes", "frame", "link", "friction", "view", "copy"],
)
def test_a_mistake_is_one_finding_at_its_line(change, code, marked, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = ROBOT.replace(*change)
    (tmp_path / "rover.urdf.xacro").write_text(text)
    (found,) = lint("rover.urdf.xacro", select=CODES)
    assert (found.code, marked in text.splitlines()[found.line - 1]) == (code, True)


def test_the_robot_without_mistakes_has_no_findings(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rover.urdf.xacro").write_text(ROBOT)
    assert lint("rover.urdf.xacro", select=CODES) == []
