"""Cameras of Gazebo without a frame, and the files and elements that give them one."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

ROBOT = (Path(__file__).parent / "rules" / "sensor-frame-undefined" / "bad.camera.urdf").read_text()
MANIFEST = """<package format="3"><name>cart</name><version>1.0.0</version><description>A cart.</description>
  <maintainer email="test@example.org">tester</maintainer><license>MIT</license></package>"""
NODE = '<launch><node pkg="tf2_ros" exec="static_transform_publisher" args="{}"/></launch>'
TRANSFORM = "--frame-id camera_optical_frame --child-frame-id {}"
PLUGIN = '<plugin name="eye" filename="{}"/></sensor>'


@pytest.mark.parametrize(
    ("old", "new", "launch", "count"),
    [
        ("", "", NODE.format(TRANSFORM.format("imu")), 1),
        ("", "", NODE.format(TRANSFORM.format("cart/camera/eye")), 0),
        ("", "", NODE.format("").replace("<node", '<param name="override_frame_id" value="camera"/><node'), 0),
        ("</sensor>", PLUGIN.format("libgazebo_ros_camera.so"), "", 0),
        ("</sensor>", PLUGIN.format("my_camera"), "", 0),
        ("<topic>eye</topic>", "<topic>eye</topic><frame_id>camera</frame_id>", "", 0),
        ("camera_optical_frame", "camera_frame", "", 0),
        ('"rgbd_camera"', '"camera"', "", 1),
    ],
    ids=["other frame", "published", "overridden", "classic", "plugin", "frame", "no optical frame", "camera"],
)
def test_a_camera_without_a_frame(old, new, launch, count, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "launch").mkdir()
    (tmp_path / "package.xml").write_text(MANIFEST)
    (tmp_path / "cart.urdf").write_text(ROBOT.replace(old, new) if old else ROBOT)
    if launch:
        (tmp_path / "launch" / "cart.launch.xml").write_text(launch)
    assert ["`eye`" in each.message for each in lint(".", select=("Z804",))].count(True) == count


def test_a_camera_of_another_generation_has_no_finding(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = ROBOT.replace('"rgbd_camera"', '"camera"').replace('"gpu_lidar"', '"ray"')
    (tmp_path / "cart.urdf").write_text(text)
    assert lint("cart.urdf", select=("Z804",)) == []
    plugin = '<gazebo><plugin name="a" filename="gz-sim-sensors-system"/></gazebo></robot>'
    (tmp_path / "cart.urdf").write_text(text.replace("</robot>", plugin))
    assert [each.line for each in lint("cart.urdf", select=("Z804",))] == [17]
