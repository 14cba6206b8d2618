import math
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.view.content.joint_panel import home, joint_rows

URDF = """<robot name="toy">
  <link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="e"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="a"/></joint>
  <joint name="lift" type="prismatic"><parent link="a"/><child link="b"/>
    <limit lower="0.1" upper="0.5" effort="1" velocity="1"/></joint>
  <joint name="glued" type="fixed"><parent link="b"/><child link="c"/></joint>
  <joint name="elbow" type="revolute"><parent link="c"/><child link="d"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="echo" type="revolute"><parent link="d"/><child link="e"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/><mimic joint="elbow" multiplier="-1" offset="0.2"/></joint>
</robot>"""


@pytest.fixture
def kinematics(tmp_path: Path) -> Kinematics:
    path = tmp_path / "toy.urdf"
    path.write_text(URDF)
    return Kinematics(load(path))


def test_a_row_for_every_joint_that_moves_in_the_order_written(kinematics: Kinematics) -> None:
    rows = joint_rows(kinematics, {"elbow": 0.5, "echo": -0.3})
    own = {"mimic": None, "multiplier": 1.0, "offset": 0.0}
    assert rows == [
        {"name": "turn", "type": "continuous", "lower": -math.pi, "upper": math.pi, "limited": False, "unit": "rad"}
        | {"position": 0.0} | own,
        {"name": "lift", "type": "prismatic", "lower": 0.1, "upper": 0.5, "limited": True, "unit": "m"}
        | {"position": 0.0} | own,
        {"name": "elbow", "type": "revolute", "lower": -1.0, "upper": 2.0, "limited": True, "unit": "rad"}
        | {"position": 0.5} | own,
        {"name": "echo", "type": "revolute", "lower": -1.0, "upper": 2.0, "limited": True, "unit": "rad"}
        | {"position": -0.3, "mimic": "elbow", "multiplier": -1.0, "offset": 0.2},
    ]  # fmt: skip


def test_home_is_zero_or_the_nearest_limit(kinematics: Kinematics) -> None:
    assert home(kinematics) == {"turn": 0.0, "lift": 0.1, "elbow": 0.0}


def test_planar_and_floating_joints_have_a_row_for_each_number(tmp_path: Path) -> None:
    path = tmp_path / "toy.urdf"
    path.write_text("""<robot name="toy"><link name="base"/><link name="a"/><link name="b"/>
      <joint name="plane" type="planar"><parent link="base"/><child link="a"/></joint>
      <joint name="free" type="floating"><parent link="a"/><child link="b"/></joint></robot>""")
    kinematics = Kinematics(load(path))
    rows = joint_rows(kinematics, home(kinematics))
    assert [(row["name"], row["unit"]) for row in rows] == [
        ("plane/x", "m"), ("plane/y", "m"), ("plane/theta", "rad"),
        ("free/trans_x", "m"), ("free/trans_y", "m"), ("free/trans_z", "m"),
        ("free/rot_x", ""), ("free/rot_y", ""), ("free/rot_z", ""), ("free/rot_w", ""),
    ]  # fmt: skip
    reach = {row["name"]: (row["lower"], row["upper"], row["limited"], row["position"]) for row in rows}
    assert reach["plane/theta"] == (-math.pi, math.pi, False, 0.0)
    assert reach["free/trans_x"] == (-1.0, 1.0, False, 0.0)
    assert reach["free/rot_w"] == (-1.0, 1.0, False, 1.0)
