import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")

import pinocchio as pin

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.view.content.inspector import ellipsoid, inspection, quaternion

URDF = """<robot name="toy" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="wheel" params="side">
    <link name="${side}">
      <inertial><origin xyz="0 0 0.1" rpy="0 0 0.5"/><mass value="2"/>
        <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/></inertial>
      <visual name="tyre"><geometry><sphere radius="0.1"/></geometry></visual>
    </link>
    <joint name="${side}_joint" type="continuous"><parent link="base"/><child link="${side}"/>
      <origin xyz="0 1 0" rpy="0.1 0.2 0.3"/><axis xyz="0 3 4"/></joint>
  </xacro:macro>
  <link name="base"/>
  <xacro:wheel side="left"/>
  <xacro:wheel side="right"/>
</robot>"""


@pytest.fixture
def found(tmp_path: Path, monkeypatch) -> dict:
    monkeypatch.chdir(tmp_path)
    Path("toy.urdf.xacro").write_text(URDF)
    return inspection(Kinematics(load("toy.urdf.xacro")))


def test_links_come_in_the_order_of_the_poses_and_as_json(found: dict) -> None:
    assert [link["name"] for link in found["links"]] == ["base", "left", "right"]
    assert found["root"] == "base"
    json.dumps(found, allow_nan=False)


def test_a_place_has_the_lines_and_the_call(found: dict) -> None:
    source = found["links"][2]["source"]
    assert (source["file"], source["line"]) == ("toy.urdf.xacro", 3)
    assert source["lines"][0].strip() == '<link name="${side}">'
    assert source["lines"][-1].strip() == "</link>"
    assert source["more"] == 0
    assert source["chain"] == [{"macro": "wheel", "file": "toy.urdf.xacro", "line": 13}]
    assert found["links"][0]["source"]["chain"] == []
    assert found["links"][2]["visuals"][0]["source"]["line"] == 6


def test_poses_and_axes(found: dict) -> None:
    joint = found["joints"][0]
    assert joint["axis"] == pytest.approx([0, 0.6, 0.8])
    assert joint["origin"][:3] == [0, 1, 0]
    turn = pin.Quaternion(pin.rpy.rpyToMatrix(0.1, 0.2, 0.3)).coeffs()
    assert joint["origin"][3:] == pytest.approx(list(turn))
    assert (joint["lower"], joint["upper"]) == (None, None)
    assert found["links"][1]["visuals"][0]["geometry"] == "sphere, radius 0.1 m"


@pytest.mark.parametrize("mass", [0.5, 5.0])
def test_the_ellipsoid_has_the_inertia(mass: float) -> None:
    rotation = pin.rpy.rpyToMatrix(0.3, -0.4, 1.1)
    half = np.array([0.1, 0.2, 0.3])
    moments = mass / 5 * np.array([0.2**2 + 0.3**2, 0.1**2 + 0.3**2, 0.1**2 + 0.2**2])
    tensor = rotation @ np.diag(moments) @ rotation.T
    made = ellipsoid(mass, [tensor[0, 0], tensor[0, 1], tensor[0, 2], tensor[1, 1], tensor[1, 2], tensor[2, 2]])
    assert made is not None
    assert sorted(made["axes"]) == pytest.approx(sorted(half))
    R = pin.Quaternion(np.array(made["turn"])).matrix()
    assert R @ np.diag(made["moments"]) @ R.T == pytest.approx(tensor)
    a = np.array(made["axes"])
    sums = np.array([a[1] ** 2 + a[2] ** 2, a[0] ** 2 + a[2] ** 2, a[0] ** 2 + a[1] ** 2])
    assert made["moments"] == pytest.approx(mass / 5 * sums)


@pytest.mark.parametrize("tensor", [[0.4, 0, 0, 0.1, 0, 0.1], [-1, 0, 0, 1, 0, 1], [0, 0, 0, 0, 0, 0]])
def test_what_no_body_has_is_no_ellipsoid(tensor: list[float]) -> None:
    assert ellipsoid(1.0, tensor) is None
    assert ellipsoid(0.0, [1, 0, 0, 1, 0, 1]) is None


def test_quaternions_of_any_turn() -> None:
    chance = np.random.default_rng(3)
    turns = [pin.rpy.rpyToMatrix(*chance.uniform(-np.pi, np.pi, 3)) for _ in range(200)]
    turns += [np.diag(signs) for signs in ([1, -1, -1], [-1, 1, -1], [-1, -1, 1], [1, 1, 1])]
    for R in turns:
        q = quaternion(R)
        assert q[3] >= 0
        assert pin.Quaternion(q).matrix() == pytest.approx(R, abs=1e-12)
