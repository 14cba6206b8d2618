"""Transforms against the real robot_state_publisher (Debian's, ROS 1)."""

from __future__ import annotations

import json
import socket
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest

from tests.processes import running
from urdfkit.description import load
from urdfkit.description.xacro.expand import expand
from urdfkit.kinematics import TransformTree
from urdfkit.resources import find_model

pytestmark = pytest.mark.rospy

SCRIPT = Path(__file__).with_name("publish_states.py")


@pytest.fixture
def ros(tmp_path: Path) -> dict[str, str]:
    """Return the environment of a ROS 1 of its own, on the loopback interface."""
    return {
        "PATH": "/usr/sbin:/usr/bin:/sbin:/bin",
        "HOME": str(tmp_path),
        "ROS_HOME": str(tmp_path),
        "ROS_LOG_DIR": str(tmp_path / "log"),
        "ROS_IP": "127.0.0.1",
        "ROS_MASTER_URI": f"http://127.0.0.1:{_free_port()}",
        "LANG": "C.UTF-8",
    }


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


@pytest.fixture(params=["arm", "simpleton"])
def model(request: pytest.FixtureRequest, tmp_path: Path, arm_xml: str) -> Path:
    if request.param == "simpleton":
        return find_model(["simpleton"]).path
    path = tmp_path / "arm.urdf"
    path.write_text(arm_xml, encoding="utf-8")
    return path


@pytest.mark.slow
def test_robot_state_publisher_agrees(model: Path, ros: dict[str, str]) -> None:
    tree = TransformTree(load(model))
    rng = np.random.default_rng(6)
    states = [{name: float(rng.uniform(-3, 3)) for name in tree.kinematics.joint_names} for _ in range(12)]
    answers = _published(expand(model).xml, states, ros)
    assert len(answers) == len(states)
    for positions, transforms in zip(states, answers, strict=True):
        assert {child for _, child, _, _ in transforms} == set(tree.frames) - {tree.root}
        local = {child: (parent, pin.XYZQUATToSE3(np.array(t + q))) for parent, child, t, q in transforms}
        for frame in tree.frames:
            published = pin.SE3.Identity()
            at = frame
            while at != tree.root:
                at, step = local[at]
                published = step * published
            np.testing.assert_allclose(
                tree.placement(frame, tree.root, positions).homogeneous, published.homogeneous, rtol=0, atol=1e-9
            )
            backwards = tree.placement(tree.root, frame, positions)
            np.testing.assert_allclose(backwards.homogeneous, published.inverse().homogeneous, rtol=0, atol=1e-9)


def _published(urdf: str, states: list[dict[str, float]], environment: dict[str, str]) -> list[Any]:
    """Return what robot_state_publisher makes of these joint states; nothing is left running."""
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    with running(["/usr/bin/python3", str(SCRIPT)], env=environment, text=True, **pipes) as process:
        out, err = process.communicate(json.dumps({"urdf": urdf, "states": states}))
    assert process.returncode == 0, err
    return list(json.loads(out))
