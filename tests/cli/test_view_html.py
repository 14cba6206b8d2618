"""The page in one file: opened from the disk, with nobody to serve it."""

import math
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.resources import find_model
from urdfkit.view.content.inspector import inspection

ROBOT = """<robot name="every joint">
  <link name="base"><visual><geometry><box size="0.4 0.3 0.1"/></geometry></visual></link>
  <link name="a"><visual><geometry><cylinder radius="0.05" length="0.3"/></geometry></visual></link>
  <link name="b"/><link name="c"/><link name="d/e%2F"/><link name="f"/><link name="g"/>
  <link name="wheel"><visual><geometry><mesh filename="wheel.stl"/></geometry></visual></link>
  <joint name="oblique" type="revolute"><parent link="base"/><child link="a"/>
    <origin xyz="0.1 0.2 0.3" rpy="0.4 -0.5 1.6"/><axis xyz="1 -2 3"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="on" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0 0 0.3" rpy="3.1 0 0.2"/>
    <axis xyz="0 -1 0"/></joint>
  <joint name="slide" type="prismatic"><parent link="b"/><child link="c"/><origin xyz="0 0.1 0"/>
    <axis xyz="0 0.6 0.8"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="glue" type="fixed"><parent link="c"/><child link="d/e%2F"/>
    <origin xyz="0 0 0.1" rpy="0 1.5707963 0"/></joint>
  <joint name="plane" type="planar"><parent link="d/e%2F"/><child link="f"/><origin xyz="0 0 0.1" rpy="0.1 0 0"/>
    <axis xyz="1 1 0"/></joint>
  <joint name="free" type="floating"><parent link="f"/><child link="g"/><origin xyz="0.2 0 0"/></joint>
  <joint name="echo" type="revolute"><parent link="base"/><child link="wheel"/><origin xyz="-0.2 0 0.2"/>
    <axis xyz="1 0 0"/><limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="oblique" multiplier="-1.5" offset="0.25"/></joint>
</robot>"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    import trimesh

    folder = tmp_path_factory.mktemp("html")
    trimesh.creation.annulus(0.05, 0.1, 0.04).export(folder / "wheel.stl")
    path = folder / "every.urdf"
    path.write_text(ROBOT)
    return path


@pytest.fixture(scope="module")
def html(robot: Path) -> Path:
    path = robot.parent / "every.html"
    assert main(["view", str(robot), "--html", str(path)]) == 0
    return path


@pytest.fixture
def page(visits, html: Path):
    opened = visits.open(html.as_uri())
    yield opened
    assert visits.problems == []
    assert [url for url in visits.requests if not url.startswith(("data:", "blob:"))] == [html.as_uri()]


def poses_of(kinematics: Kinematics, values: dict[str, float]) -> np.ndarray:
    own = {name: value for name, value in values.items() if name in kinematics.variable_names}
    return kinematics.link_poses(kinematics.configuration(own))


def apart(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Return the largest difference of poses; a quaternion and its negative are the same turn."""
    turns = np.minimum(np.abs(ours[:, 3:] - theirs[:, 3:]), np.abs(ours[:, 3:] + theirs[:, 3:]))
    return max(np.abs(ours[:, :3] - theirs[:, :3]).max(), turns.max())


def test_writing_reports_path_and_size(robot: Path, tmp_path: Path, capfd) -> None:
    path = tmp_path / "page.html"
    assert main(["view", str(robot), "--html", str(path)]) == 0
    output = capfd.readouterr()
    assert output.out == ""
    assert output.err == f"wrote {path} ({path.stat().st_size / 1e6:.2f} MB)\n"
    assert path.stat().st_size < 1_500_000


@pytest.mark.browser
def test_sliders_move_the_robot_without_a_server(page, robot: Path, keep, until) -> None:
    assert page.locator("#robot-name").inner_text() == "every joint"
    page.locator("#joint-oblique").evaluate("(s) => { s.value = 0.7; s.dispatchEvent(new Event('input')); }")
    wheel = "urdfkit.scene.byLink.get('wheel')"
    angle = -1.5 * 0.7 + 0.25
    until(lambda: page.evaluate(f"{wheel}.quaternion.x") == pytest.approx(math.sin(angle / 2), abs=1e-6))
    assert page.get_by_label("echo [rad]").input_value() == f"{angle:.3f}"
    assert page.evaluate(f"{wheel}.children[0].children[0].children[0].geometry.attributes.position.count") > 50
    number = page.get_by_label("plane/theta [rad]")
    number.fill("0.5")
    number.press("Enter")
    until(lambda: page.evaluate("urdfkit.page.values['plane/theta']") == 0.5)
    nodes = "urdfkit.scene.nodes.map((n) => [...n.position.toArray(), ...n.quaternion.toArray()])"
    expected = poses_of(Kinematics(load(robot)), page.evaluate("urdfkit.page.values"))
    until(lambda: apart(np.array(page.evaluate(nodes)), expected) < 1e-6)  # they travel as 32-bit numbers
    keep(page, "html")
    page.locator("#open-findings").click()
    assert page.get_by_role("button", name="Apply fix").count() == 0  # nobody is there to apply it
    page.locator("#open-inspect").click()
    page.get_by_role("button", name="Publish a point").click()
    box = page.locator("#pane").bounding_box()
    assert box is not None
    page.mouse.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    until(lambda: "no server" in page.locator("#toast").inner_text())


@pytest.mark.browser
def test_forward_kinematics_is_pinocchios(page, robot: Path) -> None:
    chance = np.random.default_rng(11)
    models = [robot, *(find_model([name]).path for name in ("simpleton", "seven_dof_arm", "artoo", "rrbot", "gem_e2"))]
    for path in models:
        kinematics = Kinematics(load(path))
        page.evaluate("(d) => { window.tried = new urdfkit.kinematics.constructor(d); }", inspection(kinematics))
        for _ in range(5):
            values = {name: float(chance.uniform(-2, 2)) for name in kinematics.variable_names}
            found = page.evaluate(
                "(v) => { const p = tried.forward(v); return tried.links.map((l) => p.get(l)); }", values
            )
            assert apart(np.array(found), poses_of(kinematics, values)) < 1e-9, path.name
