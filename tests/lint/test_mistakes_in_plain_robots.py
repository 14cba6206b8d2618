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


def leg(name: str, x: float, y: float) -> str:
    """Return a leg of the quadruped."""
    side = 1 if y > 0 else -1
    links = "".join(
        f'  <link name="{name}_{part}"><inertial><origin xyz="0 {side * 0.04} -0.1"/><mass value="1"/>'
        '<inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial></link>\n'
        for part in ("hip", "thigh", "calf", "foot")
    )
    joints = "".join(
        f'  <joint name="{name}_{child}_joint" type="{kind}"><parent link="{parent}"/><child link="{name}_{child}"/>\n'
        f'    <origin xyz="{xyz}"/>\n    <axis xyz="{axis}"/>\n'
        '    <limit lower="-1" upper="1" effort="9" velocity="9"/></joint>\n'
        for child, parent, kind, xyz, axis in (
            ("hip", "trunk", "revolute", f"{x} {y} 0", "1 0 0"),
            ("thigh", f"{name}_hip", "revolute", f"0 {side * 0.08} 0", "0 1 0"),
            ("calf", f"{name}_thigh", "revolute", f"0.01 {side * 0.01} -0.2", "0 1 0"),
            ("foot", f"{name}_calf", "revolute", f"0 {side * 0.02} -0.21", "0 1 0"),
        )
    )
    return links + joints


def quadruped(*names: str) -> str:
    """Return a robot with legs."""
    legs = (leg(name, 0.2 if name[0] == "F" else -0.2, 0.1 if name[1] == "L" else -0.1) for name in names)
    return f'<robot name="dog">\n  <link name="trunk"/>\n{"".join(legs)}</robot>\n'


FOUR = quadruped("FL", "FR", "HL", "HR")


@pytest.mark.parametrize("name", ["FL", "FR", "HL", "HR"])
@pytest.mark.parametrize(
    ("joint", "k", "old", "new", "code"),
    [
        ("thigh", 1, "0.08", "-0.08", "S909"),
        ("calf", 2, "-0.2", "0.2", "S909"),
        ("foot", 2, "-0.21", "-2.1", "S909"),
        ("calf", None, "0 1 0", "0 0 1", "S904"),
    ],
)
def test_the_joint_that_breaks_the_symmetry_of_the_legs_is_reported(
    name, joint, k, old, new, code, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    lines = FOUR.splitlines()
    at = next(i for i, line in enumerate(lines) if f'"{name}_{joint}_joint"' in line) + (1 if code == "S909" else 2)
    if k is None:
        lines[at] = lines[at].replace(old, new)
    else:
        parts = lines[at].split('"')[1].split()
        parts[k] = str(round(float(parts[k]) * float(new) / float(old), 6))
        lines[at] = f'    <origin xyz="{" ".join(parts)}"/>'
    (tmp_path / "dog.urdf").write_text("\n".join(lines))
    (found,) = lint("dog.urdf", select=("S904", "S909"))
    assert (found.code, found.line) == (code, at + 1)


@pytest.mark.parametrize("names", [("FL", "FR", "HL", "HR"), ("FL", "FR")])
def test_symmetric_legs_have_no_findings(names, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "dog.urdf").write_text(quadruped(*names))
    assert lint("dog.urdf", select=("S904", "S909")) == []
