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


@pytest.mark.parametrize(
    ("unknown", "is_kept"),
    [
        (('<link name="imu_link"/>', '<link name="imu_link"><xacro:shape/></link>'), True),
        (('effort="5" velocity="2"', 'effort="${strength}" velocity="2"'), True),
        (('<axis xyz="0 1 0"/>\n    </joint>', '<axis xyz="${tilt}"/>\n    </joint>'), False),
        (('<origin xyz="0 ${sign * 0.3} 0"/>', '<origin xyz="0 ${sign * beam} 0"/>'), False),
        (('<origin xyz="0.2 0 0.1"/>', '<origin xyz="0.2 0 ${height}"/>'), True),
    ],
    ids=["macro", "effort", "axis", "parent", "other part"],
)
def test_an_unknown_value_hides_only_findings_on_places_that_need_it(unknown, is_kept, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = ROBOT.replace('x="${-half}"', 'x="${half}"').replace(*unknown, 1)
    (tmp_path / "rover.urdf.xacro").write_text(text)
    found = lint("rover.urdf.xacro", select=(*CODES, "X103", "X104"))
    expected = {"X103" if "xacro:shape" in unknown[1] else "X104", *(["S907"] if is_kept else [])}
    assert {each.code for each in found} == expected


WHEELS = """<robot name="rover" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="wheel" params="name x y z">
    <link name="${name}_wheel"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="${name}_wheel_joint" type="continuous">
      <parent link="base"/><child link="${name}_wheel"/><origin xyz="${x} ${y} ${z}"/><axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="leg" params="name is_left is_front">
    <link name="${name}_hip"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="${name}_hip_joint" type="continuous">
      <parent link="base"/><child link="${name}_hip"/><axis xyz="1 0 0"/>
      <xacro:if value="${is_left}">
        <origin xyz="${0.4 if is_front else -0.4} 0.2 0.3"/>
      </xacro:if>
      <xacro:unless value="${is_left}">
        <origin xyz="${0.4 if is_front else -0.4} -0.2 0.3"/>
      </xacro:unless>
    </joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:wheel name="front_left"
    x="0.31"
    y="0.21"
    z="0.1"/>
  <xacro:wheel name="front_right"
    x="0.31"
    y="-0.21"
    z="0.1"/>
  <xacro:wheel name="rear_left"
    x="-0.31"
    y="0.21"
    z="0.1"/>
  <xacro:wheel name="rear_right"
    x="-0.31"
    y="-0.21"
    z="0.1"/>
  <xacro:leg name="FL" is_left="true" is_front="true"/>
  <xacro:leg name="FR" is_left="false" is_front="true"/>
  <xacro:leg name="RL" is_left="true" is_front="false"/>
  <xacro:leg name="RR" is_left="false" is_front="false"/>
</robot>
"""


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (None, None),
        (('y="0.21"', 'y="-0.21"'), 23),
        (('x="-0.31"', 'x="0.31"'), 30),
        (('y="-0.21"', 'y="-2.1"'), 27),
        (('name="FR" is_left="false"', 'name="FR" is_left="true"'), 38),
    ],
    ids=["none", "left", "rear", "decimal point", "condition"],
)
def test_a_misplaced_part_is_reported_at_the_argument_that_misplaces_it(change, line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rover.urdf.xacro").write_text(WHEELS.replace(*change, 1) if change else WHEELS)
    found = lint("rover.urdf.xacro", select=CODES)
    assert [(each.code, each.line) for each in found] == ([("S909", line)] if line else [])


@pytest.mark.parametrize(
    ("change", "line"),
    [
        (('"front_right"', '"rear_left"'), 25),
        (('"rear_right"', '"rear_left"'), 33),
        (('"rear_left"', '"rear_right"'), 29),
    ],
    ids=["earlier call", "later call", "other side"],
)
def test_a_repeated_name_is_reported_at_the_call_on_the_side_that_contradicts_it(change, line, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rover.urdf.xacro").write_text(WHEELS.replace(*change, 1))
    found = lint("rover.urdf.xacro", select=("T206", "T207"))
    assert [(each.code, each.line) for each in found] == [("T206", line)]
