"""Mistakes in robots without macros: one finding for each, at the line that has to be edited."""

import pytest

from urdfkit.lint import lint


def wheel(name: str, x: float, y: float) -> str:
    """Return a wheel of the cart."""
    return f"""  <link name="{name}_wheel">
    <visual>
      <geometry>
        <mesh filename="{name}.stl" scale="0.001 0.001 0.001"/>
      </geometry>
    </visual>
  </link>
  <joint name="{name}_wheel_joint" type="continuous">
    <parent link="base"/>
    <child link="{name}_wheel"/>
    <origin xyz="{x} {y} 0" rpy="-1.5708 0 0"/>
    <axis xyz="0 0 1"/>
  </joint>
"""


ROBOT = f"""<robot name="cart">
  <link name="base"/>
{wheel("front_left", 0.3, 0.2)}{wheel("front_right", 0.3, -0.2)}{wheel("rear_left", -0.3, 0.2)}
{wheel("rear_right", -0.3, -0.2)}
  <link name="lidar">
    <visual>
      <geometry>
        <cylinder radius="0.05" length="0.07"/>
      </geometry>
    </visual>
    <collision>
      <geometry>
        <cylinder radius="0.05" length="0.07"/>
      </geometry>
    </collision>
  </link>
  <joint name="lidar_joint" type="fixed">
    <parent link="base"/>
    <child link="lidar"/>
    <origin xyz="0.2 0 0.2"/>
  </joint>
  <gazebo reference="lidar">
    <sensor name="lidar" type="gpu_lidar">
      <lidar>
        <scan><horizontal>
          <samples>360</samples>
          <min_angle>-1.5</min_angle>
          <max_angle>1.5</max_angle>
        </horizontal></scan>
        <range>
          <min>0.1</min>
          <max>12</max>
        </range>
      </lidar>
    </sensor>
  </gazebo>
  <ros2_control name="cart" type="system">
    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    <joint name="front_left_wheel_joint">
      <command_interface name="velocity">
        <param name="min">-3</param>
        <param name="max">3</param>
      </command_interface>
    </joint>
  </ros2_control>
</robot>
"""
CODES = ("C719", "G620", "I518", "S904", "T204", "Z823")


@pytest.mark.parametrize(
    ("change", "code", "marked"),
    [
        (('left.stl" scale="0.001 0.001 0.001"', 'left.stl"'), "I518", 'front_left.stl"'),
        (('rear_right.stl" scale="0.001 0.001 0.001"', 'rear_right.stl"'), "I518", 'rear_right.stl"'),
        (('0.3 0.2 0" rpy="-1.5708', '0.3 0.2 0" rpy="1.5708'), "S904", '"0.3 0.2 0" rpy="1.5708'),
        (
            ('<parent link="base"/>\n    <child link="lidar"/>', '<parent link="lidar"/>\n <child link="lidar"/>'),
            "T204",
            0,
        ),
        (('0.07"/>\n      </geometry>\n    </coll', '0.7"/>\n      </geometry>\n    </coll'), "G620", 'length="0.7"'),
        (("<min_angle>-1.5", "<min_angle>1.5"), "Z823", "<min_angle>1.5"),
        (("<max_angle>1.5", "<max_angle>-1.5"), "Z823", "<max_angle>-1.5"),
        (("<min>0.1", "<min>100"), "Z823", "<min>100"),
        (("<max>12", "<max>0.012"), "Z823", "<max>0.012"),
        (('"min">-3', '"min">3'), "C719", '"min">3'),
        (('"max">3', '"max">-3'), "C719", '"max">-3'),
    ],
)
def test_a_mistake_is_one_finding_at_its_line(change, code, marked, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = ROBOT.replace(*change, 1)
    (tmp_path / "cart.urdf").write_text(text)
    (found,) = lint("cart.urdf", select=CODES)
    assert (found.code, (marked or '<parent link="lidar"/>') in text.splitlines()[found.line - 1]) == (code, True)


def test_the_robot_without_mistakes_has_no_findings(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cart.urdf").write_text(ROBOT)
    assert lint("cart.urdf", select=CODES) == []
