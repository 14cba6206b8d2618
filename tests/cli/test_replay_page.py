"""The page of a recording: its robot description is shown, time is controlled, no simulation is offered."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("meshcat")

from tests.app.replay.test_replay import ARM, turned
from tests.app.replay.written_bags import Messages, Written, write_bag


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
    page.locator("#pause").click()
    until(lambda: page.evaluate("urdfkit.page.status.paused"))
    page.evaluate("urdfkit.connection.request('replay', { action: 'show', at: 7.0 })")
    until(lambda: page.evaluate("Math.abs(urdfkit.page.status.pose.x - 7) < 1e-6"))
    hand = "urdfkit.page.scene.byLink.get('hand').position"
    until(lambda: abs(page.evaluate(f"{hand}.z") - 0.5 + 0.7 * 0.29552) < 1e-3)
    page.locator("#reset").click()
    until(lambda: page.evaluate("urdfkit.page.status.pose.x < 1e-6"))
    page.locator("#pause").click()
    until(lambda: page.evaluate("urdfkit.page.status.time > 0.3"))
    until(lambda: page.locator("#sim-time").inner_text() not in ("", "0.0 s"))
