"""Cameras, frames, measuring and pointing, in a real browser."""

import math
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from tests.cli.lab import at, drawn, panel, values
from urdfkit.description import load
from urdfkit.kinematics import Kinematics

pytestmark = pytest.mark.browser


@pytest.fixture
def page(lab_page):
    return lab_page


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


def test_measuring_and_publishing_by_the_keyboard_alone(page, lab_served, until, keep) -> None:
    page.locator("#open-measure").press("Enter")
    page.locator("#measure-from").select_option("base")
    page.locator("#measure-to").select_option("lower")
    for name, place in (("from", (0.15, 0.15, 0.1)), ("to", (0.03, 0.03, 0.3))):
        for axis, value in zip("xyz", place, strict=True):
            page.locator(f"#measure-{name}-{axis}").fill(str(value))
    page.locator("#measure-to-z").press("Enter")
    length = math.dist((0.15, 0.15, 0.1), (0.03, 0.03, 0.7))
    until(
        lambda: page.locator(".measure-label").all_inner_texts() == [f"{1000 * length:.1f}".removesuffix(".0") + " mm"]
    )
    keep(page, "measure-typed")
    page.get_by_role("button", name="Publish the first").press("Enter")
    until(lambda: page.locator("#toast").inner_text() == "Published 0.15, 0.15, 0.1 in base")
    page.get_by_role("button", name="Clear", exact=True).press("Enter")


def test_a_point_is_published(page, lab_served, until, keep) -> None:
    page.get_by_role("button", name="Publish a point").click()
    page.mouse.click(*at(page, "base", (0.147, 0.147, 0.1)))
    until(lambda: "/clicked_point: 0.15 0.15 0.1 in base" in lab_served.errors.read_text())
    until(lambda: page.locator("#toast").inner_text() == "Published 0.15, 0.15, 0.1 in base")
    keep(page, "point")
    page.keyboard.press("Escape")
    assert page.evaluate("urdfkit.page.tools.held") is None


def test_the_fixed_frame_stands_still(page, until, keep) -> None:
    panel(page, "camera")
    page.get_by_label("Fixed frame").select_option("lower")
    place = "(link) => urdfkit.viewport.viewer.scene.worldToLocal(urdfkit.page.labels.at(link)).toArray()"
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
    arm = "urdfkit.viewport.viewer.camera.position.clone().sub(urdfkit.viewport.viewer.controls.target).toArray()"
    drawn(page)
    before, target = page.evaluate(arm), page.evaluate("urdfkit.viewport.viewer.controls.target.toArray()")
    page.evaluate("urdfkit.page.setJoints({ bend: 1 })")
    moved = np.add(target, [0.3 * math.sin(1), 0.3 * math.cos(1) - 0.3, 0])
    until(
        lambda: (
            page.evaluate("urdfkit.viewport.viewer.controls.target.toArray()") == pytest.approx(list(moved), abs=1e-5)
        )
    )
    assert page.evaluate(arm) == pytest.approx(before, abs=1e-5)


def test_every_camera(page, until, keep) -> None:
    panel(page, "camera")
    camera = "urdfkit.viewport.viewer.camera"
    before = page.evaluate(f"{camera}.position.toArray()")
    page.get_by_label("Top down").check()
    assert page.evaluate(f"{camera}.type") == "OrthographicCamera"
    drawn(page)
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
    target = "urdfkit.viewport.viewer.controls.target.toArray()"
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
    drawn(page)
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
    assert height > 0.9 * page.evaluate(f"{camera}.position.distanceTo(urdfkit.viewport.viewer.controls.target)")


def test_the_keyboard_moves_the_camera(page) -> None:
    camera = "urdfkit.viewport.viewer.camera.position.toArray()"
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
