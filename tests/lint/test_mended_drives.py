"""What `--fix --unsafe-fixes` mends loads, and drives straight ahead as it is told."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.lint import lint
from urdfkit.lint.fixes.apply import fix
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

SHARED = Path(__file__).parents[2].parent / "shared"
COMPLETE = ("diff_wheeled_robot", "mybot", "simpleton_urdf", "simpleton_xacro")
"""Tutorial robots with wheels, masses and a drive plugin; the others lack one of these, or do not close an element."""

CART = """<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="drive.xacro"/>
  <xacro:property name="radius" value="0.1"/>
  <macro name="wheel" params="side y">
    <link name="${side}_wheel">
      <inertial><mass value="1"/><inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial>
      <collision>
        <origin rpy="${pi/2} 0 0"/><geometry><cylinder radius="${radius}" length="0.04"/></geometry>
      </collision>
    </link>
    <joint name="${side}_joint" type="continuous">
      <parent link="base"/><child link="${side}_wheel"/><origin xyz="0 ${y} 0"/><axis xyz="0 1 0"/>
    </joint>
  </macro>
  <link name="base">
    <inertial><mass value="4"/><inertia ixx="0.05" ixy="0" ixz="0" iyy="0.08" iyz="0" izz="0.1"/></inertial>
    <collision><geometry><box size="0.4, 0.2, 0.1"/></geometry></collision>
  </link>
  <wheel side="left" y="0.15"/>
  <wheel side="right" y="-0.15"/>
</robot>
"""
DRIVE = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so">
    <leftJoint>left_joint</leftJoint><rightJoint>right_jiont</rightJoint>
    <wheelSeparation>0.3</wheelSeparation><wheelDiameter>${2*radius}</wheelDiameter>
    <robotBaseFrame>base</robotBaseFrame>
  </plugin></gazebo>
</robot>
"""


def drive(entry: Path) -> float:
    """Mend a robot in place, drive it for a second at 0.3 m/s; return how far it came [m]."""
    fixed = fix([Entry(entry)], Options(target="ros1"), within=[entry.parents[1]], unsafe=True)
    for change in fixed.changes:
        change.path.write_bytes(change.after)
    assert not [finding for finding in lint(entry, target="ros1") if finding.severity == "error"]
    command = [
        sys.executable,
        "-m",
        "urdfkit",
        "sim",
        "run",
        str(entry),
        "--for",
        "1",
        "--cmd-vel",
        "0.3,0,0",
        "--json",
    ]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=600, check=False)
    assert ran.returncode == 0, ran.stderr
    return float(json.loads(ran.stdout)["base"]["position"][0])


@pytest.mark.slow
def test_a_cart_with_defects_of_many_kinds_drives_once_mended(tmp_path):
    (tmp_path / "urdf").mkdir()
    (tmp_path / "urdf" / "drive.xacro").write_text(DRIVE)
    entry = tmp_path / "urdf" / "cart.urdf.xacro"
    entry.write_text(CART)
    assert {"X101", "X102", "X105", "E010", "Z802"} <= {finding.code for finding in lint(entry, target="ros1")}
    assert 0.2 < drive(entry) < 0.32


@pytest.mark.slow
@pytest.mark.skipif(not SHARED.is_dir(), reason="no ../shared")
@pytest.mark.parametrize("name", COMPLETE)
def test_the_robots_of_tutorials_drive_once_mended(name, tmp_path):
    shutil.copytree(SHARED / "seed_cases" / name, tmp_path / name)
    entry = tmp_path / name / json.loads((tmp_path / name / "expected.json").read_text())["entry"]
    assert 0.2 < drive(entry) < 0.45
