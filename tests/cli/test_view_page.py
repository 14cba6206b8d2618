"""Everything a person can click in the viewer, in a real browser."""

import math
import re
import struct
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.description import load
from urdfkit.kinematics import Kinematics

pytestmark = pytest.mark.browser

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


def write(folder: Path) -> Path:
    (folder / "parts.xacro").write_text(PARTS)
    path = folder / "lab.urdf.xacro"
    path.write_text(ROBOT)
    return path


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write(tmp_path_factory.mktemp("lab"))


@pytest.fixture(scope="module")
def served(serve_for_all, lab: Path):
    return serve_for_all("view", str(lab))


@pytest.fixture
def page(served, visits, until):
    """The viewer with every joint at zero; nothing may go wrong in it."""
    opened = visits.open(served.url)
    opened.get_by_role("button", name="Zero all").click()
    until(lambda: opened.evaluate("Object.values(urdfkit.page.values).every((x) => x === 0)"))
    yield opened
    assert visits.problems == []
    assert all(url.startswith((served.origin, "data:", "blob:")) for url in visits.requests)  # works offline


def values(page) -> dict[str, float]:
    return page.evaluate("urdfkit.page.values")


def panel(page, name: str) -> None:
    page.locator(f"#open-{name}").click()
    page.wait_for_selector(f"#panel-{name}:visible")


def at(page, link: str, local=(0, 0, 0)) -> tuple[float, float]:
    """Where a point of a link is in the window [pixels]."""
    x, y = page.evaluate(
        """([link, local]) => { const { labels, stage } = urdfkit.page;
            stage.viewer.render();
            const [x, y] = labels.screen(labels.at(link, local));
            const { left, top } = stage.pane.getBoundingClientRect();
            return [x + left, y + top]; }""",
        [link, list(local)],
    )
    return x, y


# Joints


def test_units_of_angles(page, until, keep) -> None:
    page.get_by_label("Angles in").first.select_option("deg")
    number = page.get_by_label("bend [deg]")
    number.fill("30")
    number.press("Enter")
    until(lambda: values(page)["bend"] == pytest.approx(math.radians(30)))
    ends = page.locator('li[data-joint="bend"] .joint-ends').inner_text().split()
    assert ends == ["-114.592", "57.296"]
    assert page.get_by_label("open [m]").is_visible()  # lengths stay metres
    keep(page, "degrees")


def test_centre_random_and_zero(page, until, keep) -> None:
    page.get_by_role("button", name="Centre").click()
    until(lambda: values(page)["bend"] == pytest.approx(-0.5))
    assert values(page)["open"] == pytest.approx(0.025)
    assert values(page)["follow"] == pytest.approx(-0.025)  # it follows
    page.get_by_role("button", name="Random").click()
    until(lambda: values(page)["bend"] != pytest.approx(-0.5))
    assert -2 <= values(page)["bend"] <= 1
    assert 0 <= values(page)["open"] <= 0.05
    keep(page, "random")
    page.keyboard.press("0")
    until(lambda: values(page)["bend"] == 0)


def test_limits_can_be_ignored_and_come_back(page, until, keep) -> None:
    number = page.get_by_label("bend [rad]")
    page.get_by_label("Ignore limits").check()
    number.fill("2.5")
    number.press("Enter")
    until(lambda: values(page)["bend"] == 2.5)
    assert page.locator('li[data-joint="bend"]').get_attribute("data-beyond") is not None
    keep(page, "beyond-limits")
    page.get_by_label("Ignore limits").uncheck()
    until(lambda: values(page)["bend"] == 1)


def test_a_mimic_joint_says_what_it_follows_and_cannot_be_moved(page) -> None:
    row = page.locator('li[data-joint="follow"]')
    assert "follows -1 × open" in row.inner_text()
    assert row.locator("input").first.is_disabled()


def test_the_filter_leaves_what_fits(page) -> None:
    page.get_by_label("Filter joints").fill("TI")
    assert page.locator("#joints li:visible").evaluate_all("rows => rows.map((r) => r.dataset.joint)") == ["tip"]
    page.get_by_label("Filter joints").fill("nothing")
    assert page.get_by_text("No joint of this name.").is_visible()


# Selecting


def test_a_click_selects_a_link_and_hovering_names_it(page, keep, until) -> None:
    x, y = at(page, "upper", (0.03, 0.03, 0.15))
    page.mouse.move(x - 1, y)
    page.mouse.move(x, y)
    until(lambda: page.locator("#tip").inner_text() == "upper")
    keep(page, "hover")
    page.mouse.click(x, y)
    assert page.evaluate("urdfkit.page.selected") == {"link": "upper"}
    assert page.locator("#selection").inner_text().split()[:2] == ["link", "upper"]
    glow = "urdfkit.scene.shapes('upper', 'visual')[0].children[0].children[0].material.emissive.getHex()"
    assert page.evaluate(glow) != 0
    page.get_by_role("button", name="Look at it").click()
    target = page.evaluate("urdfkit.stage.viewer.controls.target.toArray()")
    assert target == pytest.approx([0, 0.25, 0], abs=1e-6)  # three.js has y up
    keep(page, "selected")
    page.mouse.click(150, 760)  # beside it
    assert page.evaluate("urdfkit.page.selected") is None
    assert page.evaluate(glow) == 0


def test_the_tree_finds_and_selects(page, keep, until) -> None:
    panel(page, "tree")
    page.get_by_role("button", name="hand", exact=True).click()
    assert page.evaluate("urdfkit.page.selected") == {"link": "hand"}
    page.keyboard.press("ArrowDown")
    assert page.evaluate("urdfkit.page.selected") == {"joint": "open"}
    page.keyboard.press("Escape")
    assert page.evaluate("urdfkit.page.selected") is None
    page.keyboard.press("/")
    page.keyboard.type("lef")
    assert page.locator(".tree [data-found]").all_inner_texts() == ["left"]
    seen = page.locator(".tree .link-entry:visible").all_inner_texts()
    assert seen == ["base", "upper", "lower", "hand", "left"]  # with what it hangs on
    keep(page, "tree")
    page.get_by_label("Find a link or joint").fill("")
    page.get_by_role("button", name="Fold upper").click()
    assert page.locator(".tree .link-entry:visible").all_inner_texts() == ["base", "upper", "eye"]


def test_the_inspector_tells_numbers_and_where_they_are_written(page, lab: Path, keep) -> None:
    page.evaluate("urdfkit.page.select({ link: 'upper' })")
    page.get_by_role("button", name="Inspect", exact=True).first.click()
    text = page.locator("#panel-inspect").inner_text()
    assert "mass\n0.5 kg" in text
    assert "0.002  0.002  0.0003 kg·m²" in text
    assert "box 0.06 × 0.06 × 0.3 m" in text
    assert "cylinder, radius 0.05 m, length 0.3 m" in text
    places = page.locator("#panel-inspect .place").all_inner_texts()
    assert places[0].endswith("parts.xacro:3")
    line = next(i for i, row in enumerate(ROBOT.splitlines(), 1) if 'name="upper" length' in row)
    assert f"in macro rod, called at lab.urdf.xacro:{line}" in text
    assert '<link name="${name}">' in page.locator("#panel-inspect .code").first.inner_text()
    keep(page, "inspect-link")
    page.get_by_role("button", name="turn from base").click()
    text = page.locator("#panel-inspect").inner_text()
    assert "Joint\nturn" in text
    assert "limits\nnone" in text
    page.get_by_role("button", name="upper", exact=True).last.click()
    page.evaluate("urdfkit.page.select({ joint: 'follow' })")
    assert "mimics\n-1 · open + 0" in page.locator("#panel-inspect").inner_text()
    keep(page, "inspect-joint")


# Layers


def test_marks_names_wires_and_opacity(page, keep) -> None:
    panel(page, "show")
    shown = "(kind) => urdfkit.markers.made[kind].filter((mark) => mark.parent).length"
    counts = {
        "Link frames": ("frames", 7),
        "Joint axes": ("axes", 6),
        "Inertia": ("inertia", 6),
        "Centres of mass": ("com", 6),
    }
    for words, (kind, count) in counts.items():
        assert page.evaluate(shown, kind) == 0
        page.get_by_role("checkbox", name=words, exact=True).check()
        assert page.evaluate(shown, kind) == count
    page.get_by_role("checkbox", name="Names").check()
    page.wait_for_function("document.querySelectorAll('.name-label:not([hidden])').length === 7")
    page.get_by_label("Size of marks").fill("1.5")
    keep(page, "marks")
    # a solid ellipsoid of this mass has the inertia that is written
    a, b, c = sorted(page.evaluate("urdfkit.markers.made.inertia[1].scale.toArray()"))
    assert 0.5 / 5 * np.array([a * a + b * b, a * a + c * c, b * b + c * c]) == pytest.approx([0.0003, 0.002, 0.002])

    material = "urdfkit.scene.shapes('upper', 'visual')[0].children[0].children[0].material"
    page.get_by_role("checkbox", name="Wireframe").check()
    assert page.evaluate(f"{material}.wireframe")
    keep(page, "wireframe")
    page.get_by_role("checkbox", name="Wireframe").uncheck()
    page.get_by_label("Opacity").fill("0.4")
    assert page.evaluate(f"[{material}.wireframe, {material}.opacity, {material}.transparent]") == [False, 0.4, True]
    keep(page, "opacity")


# Measuring


def test_measuring_between_two_points_that_stay_on_their_links(page, until, keep) -> None:
    page.get_by_role("button", name="Measure between two points").click()
    page.mouse.click(*at(page, "base", (0.147, 0.147, 0.1)))  # corners, which are taken exactly
    page.mouse.click(*at(page, "base", (0.147, -0.147, 0.1)))
    until(lambda: page.locator(".measure-label").all_inner_texts() == ["300 mm"])
    page.mouse.click(*at(page, "base", (0.147, 0.147, 0.1)))
    page.mouse.click(*at(page, "lower", (0.028, 0.028, 0.3)))
    length = math.dist((0.15, 0.15, 0.1), (0.03, 0.03, 0.7))
    until(
        lambda: (
            page.locator(".measure-label").all_inner_texts()[-1] == f"{1000 * length:.1f}".removesuffix(".0") + " mm"
        )
    )
    keep(page, "measure")
    number = page.get_by_label("bend [rad]")
    panel(page, "joints")
    number.fill("1")
    number.press("Enter")
    x, z = 0.03 * math.cos(1) + 0.3 * math.sin(1), 0.4 - 0.03 * math.sin(1) + 0.3 * math.cos(1)
    length = math.dist((0.15, 0.15, 0.1), (x, 0.03, z))
    until(
        lambda: (
            page.locator(".measure-label").all_inner_texts()[-1] == f"{1000 * length:.1f}".removesuffix(".0") + " mm"
        )
    )
    panel(page, "measure")
    page.get_by_role("button", name="Clear").click()
    assert page.locator(".measure-label").count() == 0


def test_a_point_is_published(page, served, until, keep) -> None:
    page.get_by_role("button", name="Publish a point").click()
    page.mouse.click(*at(page, "base", (0.147, 0.147, 0.1)))
    until(lambda: "/clicked_point: 0.15 0.15 0.1 in base" in served.errors.read_text())
    until(lambda: page.locator("#toast").inner_text() == "Published 0.15, 0.15, 0.1 in base")
    keep(page, "point")
    page.keyboard.press("Escape")
    assert page.evaluate("urdfkit.page.tools.held") is None


# Cameras and frames


def test_the_fixed_frame_stands_still(page, until, keep) -> None:
    panel(page, "camera")
    page.get_by_label("Fixed frame").select_option("lower")
    place = "(link) => urdfkit.stage.viewer.scene.worldToLocal(urdfkit.page.labels.at(link)).toArray()"
    assert page.evaluate(place, "lower") == pytest.approx([0, 0, 0], abs=1e-6)
    assert page.evaluate(place, "base") == pytest.approx([0, 0, -0.4], abs=1e-6)
    page.evaluate("urdfkit.page.setJoints({ bend: 1 })")
    until(lambda: values(page)["bend"] == 1)
    base = [0.4 * math.sin(1), 0, -0.4 * math.cos(1)]
    until(lambda: page.evaluate(place, "base") == pytest.approx(base, abs=1e-6))
    assert page.evaluate(place, "lower") == pytest.approx([0, 0, 0], abs=1e-6)
    keep(page, "fixed-frame")


def test_the_camera_goes_after_the_target_frame(page, until) -> None:
    panel(page, "camera")
    page.get_by_label("Target frame").select_option("hand")
    arm = "urdfkit.stage.viewer.camera.position.clone().sub(urdfkit.stage.viewer.controls.target).toArray()"
    page.wait_for_timeout(50)
    before, target = page.evaluate(arm), page.evaluate("urdfkit.stage.viewer.controls.target.toArray()")
    page.evaluate("urdfkit.page.setJoints({ bend: 1 })")
    moved = np.add(target, [0.3 * math.sin(1), 0.3 * math.cos(1) - 0.3, 0])
    until(
        lambda: page.evaluate("urdfkit.stage.viewer.controls.target.toArray()") == pytest.approx(list(moved), abs=1e-5)
    )
    assert page.evaluate(arm) == pytest.approx(before, abs=1e-5)


def test_every_camera(page, until, keep) -> None:
    panel(page, "camera")
    camera = "urdfkit.stage.viewer.camera"
    before = page.evaluate(f"{camera}.position.toArray()")
    page.get_by_label("Top down").check()
    assert page.evaluate(f"{camera}.type") == "OrthographicCamera"
    page.wait_for_timeout(50)
    left, right = at(page, "base", (0, 0.15, 0)), at(page, "base", (0, -0.15, 0))
    near, far = at(page, "base", (-0.15, 0, 0)), at(page, "base", (0.15, 0, 0))
    assert left[0] == pytest.approx(right[0], abs=0.5)  # y up, x to the right
    assert left[1] < right[1]
    assert near[1] == pytest.approx(far[1], abs=0.5)
    assert near[0] < far[0]
    assert far[0] - near[0] == pytest.approx(right[1] - left[1], abs=0.5)
    keep(page, "camera-top")
    page.mouse.click(*at(page, "base", (0.12, 0.12, 0.1)))  # what is seen from above can be clicked
    assert page.evaluate("urdfkit.page.selected") == {"link": "base"}

    page.get_by_label("First person").check()
    assert page.evaluate(f"{camera}.type") == "PerspectiveCamera"
    assert page.evaluate(f"{camera}.position.toArray()") == pytest.approx(before, abs=1e-6)
    page.locator("#pane").focus()
    page.keyboard.down("w")
    target = "urdfkit.stage.viewer.controls.target.toArray()"
    until(lambda: math.dist(page.evaluate(f"{camera}.position.toArray()"), before) > 0.1)
    page.keyboard.up("w")
    ahead = np.array(page.evaluate(target)) - page.evaluate(f"{camera}.position.toArray()")
    moved = np.array(page.evaluate(f"{camera}.position.toArray()")) - before
    assert ahead @ moved / np.linalg.norm(ahead) / np.linalg.norm(moved) == pytest.approx(1, abs=1e-3)
    place = page.evaluate(f"{camera}.position.toArray()")
    page.mouse.move(400, 600)
    page.mouse.down()
    page.mouse.move(500, 600, steps=3)
    page.mouse.up()
    assert page.evaluate(f"{camera}.position.toArray()") == pytest.approx(place, abs=1e-6)  # it turns on the spot
    turned = np.array(page.evaluate(target)) - place
    assert ahead @ turned / np.linalg.norm(ahead) / np.linalg.norm(turned) == pytest.approx(
        math.cos(0.4 * math.sin(math.acos(ahead[1] / np.linalg.norm(ahead)))), abs=0.02
    )
    keep(page, "camera-first")

    page.get_by_label("Target frame").select_option("upper")
    page.get_by_label("Follow", exact=True).check()
    eye = np.array(page.evaluate(f"{camera}.position.toArray()")) - page.evaluate(target)
    assert eye[0] < 0  # behind: the link looks along x
    assert eye[2] == pytest.approx(0, abs=1e-6)
    page.wait_for_timeout(50)
    page.evaluate("urdfkit.page.setJoints({ turn: Math.PI / 2 })")
    until(
        lambda: (
            page.evaluate(f"{camera}.position.z - {target.replace('toArray()', 'z')}")
            == pytest.approx(-eye[0], abs=1e-4)
        )
    )
    keep(page, "camera-follow")
    page.get_by_label("Orbit").check()
    for side in ("Front", "Left", "Above"):
        page.get_by_role("button", name=side).click()
    height = page.evaluate(f"{camera}.position.y - {target.replace('toArray()', 'y')}")
    assert height > 0.9 * page.evaluate(f"{camera}.position.distanceTo(urdfkit.stage.viewer.controls.target)")


def test_the_stage_obeys_the_keyboard(page) -> None:
    camera = "urdfkit.stage.viewer.camera.position.toArray()"
    page.locator("#pane").focus()
    before = page.evaluate(camera)
    page.keyboard.press("ArrowLeft")
    assert math.dist(page.evaluate(camera), before) > 0.01
    page.keyboard.press("ArrowRight")
    assert page.evaluate(camera) == pytest.approx(before, abs=1e-6)
    page.keyboard.press("+")
    assert np.linalg.norm(page.evaluate(camera)) < np.linalg.norm(before)


def test_the_frames_panel_agrees_with_pinocchio(page, lab: Path, until, keep) -> None:
    panel(page, "tf")
    page.evaluate("urdfkit.page.setJoints({ turn: 0.5, bend: -0.7, tip: 0.3 })")
    until(lambda: values(page)["tip"] == 0.3)
    page.get_by_label("Express in").select_option("lower")
    kinematics = Kinematics(load(lab))
    kinematics.link_poses(kinematics.configuration({"turn": 0.5, "bend": -0.7, "tip": 0.3}))
    frames = kinematics.data.oMf
    placed = frames[kinematics.frame("lower")].inverse() * frames[kinematics.frame("base")]
    x, y, z = (f"{value:.4f}".rstrip("0").rstrip(".") for value in placed.translation)
    until(lambda: f"xyz {x}  {y}  {z} m" in page.locator('li[data-frame="base"]').inner_text().replace("-0 ", "0 "))
    page.locator("#tf-unit").select_option("deg")
    assert "deg" in page.locator('li[data-frame="hand"]').inner_text()
    keep(page, "frames")
    page.get_by_role("button", name="hand", exact=True).click()
    assert page.evaluate("urdfkit.page.selected") == {"link": "hand"}


# Dragging


def test_a_link_follows_the_handle_within_its_limits(page, until, keep) -> None:
    page.evaluate("urdfkit.page.setJoints({ bend: 0.6, tip: 0.6 })")
    until(lambda: values(page)["tip"] == 0.6)
    page.evaluate("urdfkit.page.select({ link: 'left' })")
    page.get_by_role("button", name="Drag the selected link").click()
    assert page.locator("#ik-strip").inner_text().startswith("Drag the handle of left.")
    page.wait_for_timeout(50)
    x, y = at(page, "left")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 10, y + 40, steps=5)
    until(lambda: math.dist(at(page, "left"), (x - 10, y + 40)) < 2)  # the link is where the hand is
    keep(page, "drag")
    page.mouse.move(x + 700, y, steps=5)  # out of reach
    until(lambda: "out of reach" in " ".join(page.locator(".measure-label").all_inner_texts()))
    page.mouse.up()
    now = values(page)
    assert -2 <= now["bend"] <= 1
    assert -1.5 <= now["tip"] <= 1.5
    assert page.locator(".measure-label").count() == 0
    page.get_by_label("Hold orientation").check()
    assert page.evaluate("urdfkit.ik.gizmo.handles.filter((h) => h.userData.kind === 'about' && h.visible).length") == 6
    keep(page, "drag-rings")


def test_inverse_kinematics_finds_what_can_be_reached(page) -> None:
    left = page.evaluate(
        """() => { const k = urdfkit.kinematics, found = [];
            let seed = 7; const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
            for (let i = 0; i < 30; i++) {
              const pose = { turn: 6 * random() - 3, bend: -0.4 - 1.4 * random(), tip: 2.4 * random() - 1.2 };
              const goal = k.forward(pose).get("left");
              const start = { turn: 0, bend: -0.5, tip: 0.5, open: 0.02 };
              found.push(k.inverse("left", goal, start).error);
            }
            return found; }"""
    )
    assert sorted(left)[len(left) * 8 // 10] < 1e-3  # what is left is a local minimum at a limit


# Findings


def test_a_badge_leads_to_the_finding_and_its_fix_is_applied(serve, visits, until, keep, tmp_path: Path) -> None:
    path = write(tmp_path)
    served = serve("view", str(path))
    page = visits.open(served.url)
    page.wait_for_selector(".badge")
    page.evaluate("urdfkit.page.setJoints({ bend: 0.5 })")
    until(lambda: values(page)["bend"] == 0.5)
    page.locator("#pane").focus()
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    keep(page, "badges")
    page.get_by_role("button", name="1 finding on lower").click()
    assert page.evaluate("urdfkit.page.selected") == {"link": "lower"}
    card = page.locator(".finding")
    assert card.count() == 1
    line = next(i for i, row in enumerate(ROBOT.splitlines(), 1) if 'axis xyz="0 2 0"' in row)
    assert f"lab.urdf.xacro:{line}" in card.inner_text()
    assert "J412" in card.inner_text()
    assert '<axis xyz="0 2 0"/>' in card.locator(".code").first.inner_text()
    assert [row[0] for row in card.locator(".diff .code-line").all_inner_texts()] == ["-", "+"]
    card.get_by_text("The rule").click()
    assert card.locator(".prose h3").first.inner_text() == "axis-not-normalised (J412)"
    keep(page, "finding")
    camera = page.evaluate("urdfkit.stage.viewer.camera.position.toArray()")
    model = page.evaluate("urdfkit.scene.model")
    before = path.read_text()
    card.get_by_role("button", name="Apply fix").click()
    until(lambda: page.evaluate("urdfkit.scene.model") != model)
    assert path.read_text() == before.replace('axis xyz="0 2 0"', 'axis xyz="0 1 0"')
    until(lambda: page.locator(".badge[data-link=lower]").count() == 0)
    assert "fixed J412: Make the axis one long" in served.errors.read_text()
    assert page.evaluate("urdfkit.page.selected") == {"link": "lower"}
    assert values(page)["bend"] == 0.5
    assert page.evaluate("urdfkit.stage.viewer.camera.position.toArray()") == pytest.approx(camera)
    glow = "urdfkit.scene.shapes('lower', 'visual')[0].children[0].children[0].material.emissive.getHex()"
    until(lambda: page.evaluate(glow) != 0)  # what was selected still shines
    keep(page, "fixed")
    refused = page.evaluate("urdfkit.connection.order('fix', { finding: 1 }).catch((error) => error.message)")
    assert "gone" in refused
    for order, values_ in (("fix", {"finding": "../x"}), ("fix", {"finding": 1, "path": "x"}), ("write", {})):
        sent = page.evaluate(
            "([o, v]) => urdfkit.connection.order(o, v).then(() => 'done', (e) => e.message)", [order, values_]
        )
        assert sent != "done"
    assert visits.problems == []


# The rest of the page


def test_a_screenshot_and_a_turn_are_kept(page, keep) -> None:
    with page.expect_download() as download:
        page.get_by_role("button", name="Screenshot").first.click()
    assert download.value.suggested_filename == "lab.png"
    picture = Path(download.value.path()).read_bytes()
    assert picture[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", picture[16:24])
    assert [width, height] == page.evaluate("[2 * urdfkit.stage.pane.clientWidth, 2 * urdfkit.stage.pane.clientHeight]")
    panel(page, "camera")
    page.get_by_label("One turn takes").fill("1")
    before = page.evaluate("urdfkit.stage.viewer.camera.position.toArray()")
    with page.expect_download() as download:
        page.get_by_role("button", name="Record a turn").click()
    film = Path(download.value.path()).read_bytes()
    assert re.fullmatch(r"lab\.(webm|mp4)", download.value.suggested_filename)
    assert film[:4] == b"\x1aE\xdf\xa3" or film[4:8] == b"ftyp"  # Matroska or MP4
    assert len(film) > 10_000
    assert page.evaluate("urdfkit.stage.viewer.camera.position.toArray()") == pytest.approx(before, abs=1e-6)
    keep(page, "turned")


def test_colours_and_keys(page, keep) -> None:
    theme = "document.documentElement.dataset.theme"
    assert page.evaluate(theme) == "light"
    page.get_by_role("button", name="Colours: as the system").click()
    page.get_by_role("button", name="Colours: light").click()
    assert page.evaluate(theme) == "dark"
    keep(page, "dark")
    page.reload()
    page.wait_for_selector("body[data-ready=true]")
    assert page.evaluate(theme) == "dark"  # it is remembered
    page.keyboard.press("?")
    assert page.get_by_role("dialog").is_visible()
    listed = page.locator("#help kbd").all_inner_texts()
    assert {"v", "c", "x", "j", "i", "m", "n", "w", "g", "0", "r", "/", "?", "Esc", "f", "t", "o"} <= set(listed)
    assert len(listed) == len(set(listed))
    keep(page, "keys")
    page.keyboard.press("Escape")
    assert not page.get_by_role("dialog").is_visible()
    page.keyboard.press("c")
    assert page.locator("#show-collision").is_checked()


def test_everything_has_a_name_and_the_keyboard_reaches_it(page) -> None:
    page.evaluate("urdfkit.page.select({ link: 'upper' })")
    for name in ("joints", "tree", "inspect", "show", "tf", "measure", "findings", "camera"):
        panel(page, name) if page.locator(f"#panel-{name}").is_hidden() else None
        nameless = page.evaluate(
            """() => [...document.querySelectorAll("button, input, select, summary, [tabindex='0']")]
                .filter((e) => e.checkVisibility())
                .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.length || e.title))
                .map((e) => e.outerHTML)"""
        )
        assert nameless == [], name
    page.locator(".brand").click()
    reached = []
    for _ in range(60):
        page.keyboard.press("Tab")
        reached.append(page.evaluate("document.activeElement.id || document.activeElement.className"))
    order = [reached.index(name) for name in ("theme", "help-open", "pane", "tool-fit", "open-joints", "open-camera")]
    assert order == sorted(order)


def test_a_panel_can_be_kept_open_beside_others(page, keep) -> None:
    page.get_by_role("button", name="Keep Joints open").click()
    panel(page, "tree")
    assert page.locator("#panel-joints").is_visible()
    keep(page, "pinned")
    page.get_by_role("button", name="Close Joints").click()
    assert page.locator("#panel-joints").is_hidden()
    assert page.evaluate("document.activeElement.id") == "open-joints"


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_has_room_for_every_panel(served, visits, keep, scheme: str) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True, "color_scheme": scheme}
    page = visits.open(served.url, **phone)
    page.touchscreen.tap(*at(page, "base", (0.15, 0.05, 0.05)))
    page.wait_for_selector("#selection:visible")
    for name in ("joints", "tree", "inspect", "show", "tf", "measure", "findings", "camera"):
        page.locator(f"#open-{name}").tap()
        page.wait_for_selector(f"#panel-{name}:visible")
        wide = page.evaluate(
            """() => [...document.querySelectorAll("#panel *")]
                .filter((e) => e.checkVisibility() && !e.closest(".code"))
                .filter((e) => e.getBoundingClientRect().right > innerWidth + 0.5)
                .map((e) => e.outerHTML.slice(0, 200))"""
        )
        assert wide == [], name
        small = page.evaluate(
            """() => [...document.querySelectorAll("button, input, select, summary, .check")]
                .filter((e) => e.checkVisibility() && !["checkbox", "radio"].includes(e.type))
                .filter((e) => e.getBoundingClientRect().height < 43.9)
                .map((e) => e.outerHTML.slice(0, 200))"""
        )
        assert small == [], name
        keep(page, f"phone-{scheme}-{name}")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert visits.problems == []
