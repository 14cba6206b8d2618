"""The pages of a recording and of a live robot: what has no effect on them is not offered."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("meshcat")
pytest.importorskip("numba")

from tests.app.replay.test_replay import ARM, turned
from tests.app.replay.written_bags import Messages, Written, write_bag
from tests.served_simulation import rosbridge
from urdfkit.sim import Simulator

TOOLS_OF_SIMULATIONS = {"tool-push", "tool-place", "tool-walls"}


def tools(page: Any) -> set[str]:
    found: list[str] = page.locator("#tools button:visible").evaluate_all("tools => tools.map(({ id }) => id)")
    return set(found)


@pytest.mark.browser
def test_a_live_robot_is_driven_and_has_no_controls_of_a_simulation(
    serve: Any, visits: Any, until: Any, keep: Any
) -> None:
    simulator = Simulator("simpleton")
    with rosbridge(simulator) as url:
        page = visits.open(serve("view", "simpleton", "--live", url).url)
        until(lambda: page.locator("#open-displays").is_visible())
        names = set(page.locator(".rail-button:visible").all_inner_texts())
        assert names >= {"Drive", "Joints", "Topics", "Plots", "Displays"}
        assert names.isdisjoint({"World", "Physics", "Push", "Record", "Replay"})
        assert TOOLS_OF_SIMULATIONS.isdisjoint(tools(page))
        assert {"tool-goal", "tool-estimate", "tool-point"} <= tools(page)
        page.locator("#keys summary").click()
        assert page.get_by_text("both speeds ±10 %").is_visible()
        for control in ("pause", "reset", "factor", "step", "key-pause"):
            assert not page.locator(f"#{control}").is_visible(), control
        keep(page, "live")
        page.locator("#pane").focus()
        page.keyboard.down("w")
        until(lambda: simulator.state.base_pose[0] > 0.05)
        page.keyboard.up("w")
        until(lambda: abs(simulator.state.v[0]) < 1e-3)
        page.locator("#open-joints").click()
        assert page.get_by_text("The joints move with the robot.").is_visible()
        assert not page.get_by_role("button", name="Zero all").is_visible()
        row = page.locator("#joints li").nth(0)
        name = str(row.get_attribute("data-joint"))
        turned = simulator.kinematics.positions(simulator.state.q)[name]
        assert abs(turned) > 0.1
        until(lambda: abs(float(row.locator(".joint-value input").input_value()) - turned) < 2e-3)
        assert row.locator("input[type=range]").is_disabled()
        keep(page, "live-joints")
    assert visits.problems == []


IMAGE = """async () => {
  const canvas = new OffscreenCanvas(4, 3);
  canvas.getContext("2d").fillRect(0, 0, 4, 3);
  const image = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
  const frame = new Uint8Array(16 + image.length);
  frame[1] = urdfkit.sensors.shown[0].kinds[0];
  frame.set(image, 16);
  urdfkit.sensors.frame(frame.buffer);
}"""
"""Receive an image of the first sensor."""


@pytest.mark.browser
def test_a_sensor_without_an_image_says_so_until_the_first_one(
    serve: Any, visits: Any, until: Any, keep: Any, tmp_path: Path
) -> None:
    (tmp_path / "box.urdf").write_text(
        '<robot name="box"><link name="base"><visual><geometry><box size="1 1 1"/></geometry></visual></link></robot>'
    )
    page = visits.open(serve("sim", "teleop", "box.urdf").url)
    page.evaluate(
        """() => {
          urdfkit.sensors.use([{ topic: "/eye", picture: true }, { topic: "/scan", picture: false }]);
          urdfkit.page.panels.available("sensors", true);
          urdfkit.page.panels.open("sensors");
        }"""
    )
    waiting = page.locator("#sensors p:visible")
    assert waiting.all_inner_texts() == ["Waiting for the first image", "Waiting for the first points"]
    assert page.locator("#sensors canvas:visible").count() == 0
    keep(page, "waiting")
    page.evaluate(IMAGE)
    until(lambda: page.locator("#sensors .picture canvas[role=img]:visible").count() == 1)
    until(lambda: page.evaluate("urdfkit.sensors.shown[0].image.width") == 4)
    # The last image stays if the next one cannot be read, and the server is answered.
    page.evaluate("new Promise((shown) => urdfkit.sensors.shown[0].take(new ArrayBuffer(20), 1, shown))")
    assert page.evaluate("urdfkit.sensors.shown[0].image.width") == 4
    assert waiting.all_inner_texts() == ["Waiting for the first points"]
    page.locator("#sensors input").nth(0).click()
    page.locator("#sensors input").nth(1).click()
    assert page.locator("#sensors :is(p, canvas):visible").count() == 0
    assert visits.problems == []


@pytest.mark.browser
def test_a_recording_with_its_own_robot_is_replayed(tmp_path: Path, serve: Any, visits: Any, until: Any) -> None:
    ros = Messages(2)
    box = ARM.replace(
        '<link name="hand"/>', '<link name="hand"><visual><geometry><box size="1 1 1"/></geometry></visual></link>'
    )
    written: list[Written] = [("/robot_description", 0.0, ros.make("std_msgs/msg/String", box))]
    for k in range(101):
        moved = ros.transforms(0.1 * k, ("odom", "base", turned(0.1 * k, 0, 0)))
        written += [("/tf", 0.1 * k, moved), ("/joint_states", 0.1 * k, ros.joints(0.1 * k, {"wrist": 0.01 * k}))]
    page = visits.open(serve("replay", str(write_bag(tmp_path / "lab.mcap", written))).url)
    until(lambda: page.evaluate("urdfkit.page.status?.time > 0.5"))
    assert page.locator("#replaying").inner_text() == "Replay of lab"
    names = page.locator(".rail-button:visible").all_inner_texts()
    assert "Topics" in names
    assert "Replay" in names
    assert not {"Drive", "World", "Physics", "Push"} & set(names)
    assert TOOLS_OF_SIMULATIONS.isdisjoint(tools(page))
    assert "tool-goal" not in tools(page)
    page.locator("#pause").click()
    until(lambda: page.evaluate("urdfkit.page.status.paused"))
    assert not page.locator("#step").is_visible()
    page.evaluate("urdfkit.connection.request('replay', { action: 'show', at: 7.0 })")
    until(lambda: page.evaluate("Math.abs(urdfkit.page.status.pose.x - 7) < 1e-6"))
    hand = "urdfkit.page.scene.byLink.get('hand').position"
    until(lambda: abs(page.evaluate(f"{hand}.z") - 0.5 + 0.7 * 0.29552) < 1e-3)
    page.locator("#reset").click()
    until(lambda: page.evaluate("urdfkit.page.status.pose.x < 1e-6"))
    page.locator("#pause").click()
    until(lambda: page.evaluate("urdfkit.page.status.time > 0.3"))
    until(lambda: page.locator("#sim-time").inner_text() not in ("", "0.0 s"))
