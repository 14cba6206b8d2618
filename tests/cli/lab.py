"""A robot to look at in the viewer's tests, and hands for its page."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from playwright.sync_api import Page

PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="rod" params="name length">
    <link name="${name}">
      <inertial><origin xyz="0 0 ${length/2}"/><mass value="0.5"/>
        <inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.0003"/></inertial>
      <visual><origin xyz="0 0 ${length/2}"/><geometry><box size="0.06 0.06 ${length}"/></geometry>
        <material name="teal"><color rgba="0.1 0.5 0.55 1"/></material></visual>
      <collision><origin xyz="0 0 ${length/2}"/><geometry>
        <cylinder radius="0.05" length="${length}"/></geometry></collision>
    </link>
  </xacro:macro>
</robot>
"""
ROBOT = """<robot name="lab" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="parts.xacro"/>
  <link name="base">
    <inertial><mass value="4"/><inertia ixx="0.02" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.03"/></inertial>
    <visual><origin xyz="0 0 0.05"/><geometry><box size="0.3 0.3 0.1"/></geometry></visual>
    <collision><origin xyz="0 0 0.05"/><geometry><box size="0.3 0.3 0.1"/></geometry></collision>
  </link>
  <xacro:rod name="upper" length="0.3"/>
  <xacro:rod name="lower" length="0.3"/>
  <xacro:rod name="hand" length="0.1"/>
  <xacro:rod name="left" length="0.08"/>
  <xacro:rod name="right" length="0.08"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.1"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="bend" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0 0 0.3"/>
    <axis xyz="0 2 0"/><limit lower="-2" upper="1" effort="5" velocity="2"/></joint>
  <joint name="tip" type="revolute"><parent link="lower"/><child link="hand"/><origin xyz="0 0 0.3"/>
    <axis xyz="0 1 0"/><limit lower="-1.5" upper="1.5" effort="5" velocity="2"/></joint>
  <joint name="open" type="prismatic"><parent link="hand"/><child link="left"/><origin xyz="0 0.02 0.1"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.05" effort="5" velocity="2"/></joint>
  <joint name="follow" type="prismatic"><parent link="hand"/><child link="right"/><origin xyz="0 -0.02 0.1"/>
    <axis xyz="0 1 0"/><limit lower="-0.05" upper="0.05" effort="5" velocity="2"/>
    <mimic joint="open" multiplier="-1"/></joint>
  <link name="eye"/>
  <joint name="glass" type="revolute"><parent link="base"/><child link="eye"/><origin xyz="0.15 0 0.1"/>
    <axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="5" velocity="2"/></joint>
</robot>
"""

TWINS = """<robot name="two" version="1.2" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="a"><visual><origin quat_xyzw="0 0 0 2"/><geometry><box size="1 1 1"/></geometry></visual></link>
  <link name="b"><visual><origin quat_xyzw="0 0 0 2"/><geometry><box size="1 1 1"/></geometry></visual></link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/><origin quat_xyzw="0 0 0 2"/></joint>
  <xacro:macro name="wheel" params="side">
    <link name="wheel_${side}">
      <visual><origin quat_xyzw="0 0 0 2"/><geometry><cylinder radius="0.1" length="0.1"/></geometry></visual></link>
    <joint name="${side}" type="fixed"><parent link="a"/><child link="wheel_${side}"/></joint>
  </xacro:macro>
  <xacro:wheel side="left"/>
  <xacro:wheel side="right"/>
</robot>
"""
"""Four findings that say the same, one of them in a macro."""


def write(folder: Path) -> Path:
    """Write the robot and return its file."""
    (folder / "parts.xacro").write_text(PARTS)
    path = folder / "lab.urdf.xacro"
    path.write_text(ROBOT)
    return path


def values(page: Page) -> dict[str, float]:
    """Return joint positions as the page knows them."""
    found: dict[str, float] = page.evaluate("urdfkit.page.values")
    return found


def panel(page: Page, name: str) -> None:
    """Open a panel by its button."""
    page.locator(f"#open-{name}").click()
    page.wait_for_selector(f"#panel-{name}:visible")


def sized(page: Page) -> None:
    """Wait until the camera has the shape of its pane, which changes one picture later when a panel opens."""
    # Not `wait_for_function`, which evaluates a string: the page's Content-Security-Policy forbids that.
    page.evaluate(
        """() => new Promise((done) => {
          const check = () => {
            const { aspect, pane } = urdfkit.viewport;
            if (aspect === pane.clientWidth / pane.clientHeight) done();
            else requestAnimationFrame(check);
          };
          check();
        })"""
    )


def drawn(page: Page) -> None:
    """Wait until everything there is to see has been drawn."""
    sized(page)
    page.evaluate(
        """() => new Promise((done) => {
          const look = () => (urdfkit.viewport.viewer.needs_render ? requestAnimationFrame(look) : done());
          requestAnimationFrame(look);
        })"""
    )


def at(page: Page, link: str, local: tuple[float, float, float] = (0, 0, 0)) -> tuple[float, float]:
    """Return where a point of a link is in the window [pixels]."""
    sized(page)
    x, y = page.evaluate(
        """([link, local]) => { const { labels, viewport } = urdfkit.page;
            viewport.viewer.render();
            const [x, y] = labels.screen(labels.at(link, local));
            const { left, top } = viewport.pane.getBoundingClientRect();
            return [x + left, y + top]; }""",
        [link, list(local)],
    )
    return x, y
