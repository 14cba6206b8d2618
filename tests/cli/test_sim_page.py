"""The simulation page in a real browser: every control, on one server that is reset between tests."""

from __future__ import annotations

import math
import re
from itertools import combinations
from pathlib import Path

import pytest

from tests.cli.accessibility import violations
from tests.cli.conftest import Visits
from tests.cli.lab import drawn, sized

pytest.importorskip("meshcat")
pytest.importorskip("numba")
pytestmark = pytest.mark.browser

SIZE = {"width": 1000, "height": 640}
TIME = "parseFloat(document.getElementById('sim-time').textContent)"
X = "urdfkit.link().position.x"


@pytest.fixture(scope="module")
def served(serve_for_all):
    return serve_for_all("sim", "teleop", "simpleton")


@pytest.fixture(scope="module")
def opened(served, browser):
    """One page for all tests: opening one takes longer than most of them."""
    visits = Visits(browser)
    page = visits.open(served.url, viewport=SIZE)
    yield page, visits
    visits.contexts[0].close()


@pytest.fixture
def page(opened, until):
    """The page, with the simulation at its start, all panels closed and nothing in hand."""
    page, visits = opened
    visits.problems.clear()
    page.bring_to_front()
    page.mouse.up()
    page.evaluate("document.activeElement?.blur(); urdfkit.page.tools.hold(null); urdfkit.page.select(null)")
    page.evaluate(
        "for (const { id, open } of urdfkit.page.panels.all.values()) if (open) urdfkit.page.panels.close(id)"
    )
    page.evaluate("for (const each of document.querySelectorAll('details')) each.open = false")
    page.evaluate("urdfkit.page.following = true; urdfkit.page.fit()")
    page.evaluate("urdfkit.page.status.time = Infinity")
    page.locator("#reset").click()
    until(lambda: page.evaluate("urdfkit.page.status.time < 1e9 && Math.abs(urdfkit.page.status.pose.x) < 1e-3"))
    yield page
    assert visits.problems == []


def order(page, order: str, /, **values):
    return page.evaluate("([name, values]) => urdfkit.connection.request(name, values)", [order, values])


def names(page) -> list[str]:
    return page.evaluate("urdfkit.objects.objects.map(({ name }) => name)")


def put_down(page) -> None:
    """Remove everything but the robot and the ground."""
    for name in names(page):
        if name not in ("simpleton", "ground_plane", "sun"):
            order(page, "remove", name=name)
            page.wait_for_function("name => urdfkit.objects.objects.every((each) => each.name !== name)", arg=name)


def spot(page, x: float, y: float, z: float = 0.0) -> tuple[float, float]:
    """Return where in the window a place of the world is seen."""
    sized(page)
    found = page.evaluate(
        """([x, y, z]) => {
          const { viewport } = urdfkit, { viewer } = viewport;
          const box = viewport.pane.getBoundingClientRect();
          viewer.camera.updateMatrixWorld();
          const at = viewer.scene.localToWorld(new MeshCat.THREE.Vector3(x, y, z)).project(viewer.camera);
          return [box.left + ((at.x + 1) / 2) * box.width, box.top + ((1 - at.y) / 2) * box.height];
        }""",
        [x, y, z],
    )
    return found[0], found[1]


def look_from_above(page, distance: float = 7.0) -> None:
    page.evaluate(
        """(distance) => {
          const { viewport } = urdfkit;
          urdfkit.page.following = false;
          viewport.viewer.controls.target.set(0, 0, 0);
          viewport.viewer.camera.position.set(-0.01, distance, 0.4 * distance);
          viewport.viewer.controls.update();
          viewport.dirty();
        }""",
        distance,
    )
    drawn(page)


def test_a_change_of_the_model_leaves_no_pose_frame_unacknowledged(page) -> None:
    """The server waits while too many frames are not acknowledged: the robot would stand still for ever."""
    waits = page.evaluate(
        """() => {
          const { scene } = urdfkit, frame = new ArrayBuffer(16);
          new DataView(frame).setUint8(1, scene.model + 1);
          // A frame of the server may take the place of this one before it is applied.
          scene.poses(frame, (sequence) => urdfkit.page.send("ack", { sequence }));
          scene.use(urdfkit.page.model);
          return scene.pending === frame;
        }"""
    )
    assert waits


def test_the_first_view_shows_two_robot_lengths_around_the_robot(page) -> None:
    sized(page)
    share, outside = page.evaluate(
        """() => {
          const { viewport, scene } = urdfkit, { THREE } = MeshCat, { camera, controls } = viewport.viewer;
          const { center, radius } = scene.bounds().getBoundingSphere(new THREE.Sphere());
          camera.updateMatrixWorld();
          const seen = (x, z) => new THREE.Vector3(center.x + x, 0, center.z + z).project(camera);
          const angles = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => (k * Math.PI) / 4);
          const places = angles.map((angle) => [Math.cos(angle), Math.sin(angle)]);
          const outside = places.filter(([x, z]) => {
            const at = seen(4 * radius * x, 4 * radius * z);
            return Math.max(Math.abs(at.x), Math.abs(at.y)) > 1;
          });
          const distance = camera.position.distanceTo(controls.target);
          return [radius / distance / Math.tan((camera.fov * Math.PI) / 360), outside.length];
        }"""
    )
    assert share == pytest.approx(1 / 3, abs=0.05)  # of the height
    assert outside <= 2  # of eight directions: those behind the robot


def test_step_and_speed(page, keep, until) -> None:
    page.get_by_role("button", name="Pause").click()
    until(lambda: page.locator("#rtf").inner_text() == "paused")
    before = page.evaluate(TIME)
    page.locator("#steps").fill("25")
    page.get_by_role("button", name="Step", exact=True).click()
    until(lambda: page.evaluate(TIME) == pytest.approx(before + 0.025, abs=1e-9))
    keep(page, "step")
    page.get_by_role("button", name="Continue").click()
    page.locator("#factor").select_option("0.25")
    until(lambda: 0.2 < float(page.locator("#rtf").inner_text().lstrip("×").replace("paused", "0")) < 0.3)
    page.locator("#factor").select_option("")
    until(lambda: float(page.locator("#rtf").inner_text().lstrip("×")) > 3)
    keep(page, "fast")
    page.locator("#factor").select_option("1")
    until(lambda: 0.8 < float(page.locator("#rtf").inner_text().lstrip("×")) < 1.2)


def test_nothing_is_drawn_while_nothing_moves(page, until) -> None:
    frames = "Number(document.body.dataset.frames)"
    start = page.evaluate(frames)
    until(lambda: page.evaluate(frames) > start + 20)  # after the reset it has come to rest
    drawn(page)
    page.evaluate("window.pictures = 0; urdfkit.page.on('drawn', () => (window.pictures += 1))")
    start = page.evaluate(frames)
    until(lambda: page.evaluate(frames) > start + 60)
    assert page.evaluate("window.pictures") <= 3
    page.keyboard.down("w")
    until(lambda: page.evaluate("window.pictures") > 5)
    page.keyboard.up("w")


def test_everything_has_a_name_and_the_keyboard_reaches_it_and_shows_where_it_is(page) -> None:
    for name in (
        "drive",
        "sensors",
        "topics",
        "plots",
        "recorder",
        "world",
        "physics",
        "push",
        "show",
        "measure",
        "camera",
    ):
        page.evaluate("(name) => urdfkit.page.panels.open(name)", name)
        page.evaluate("for (const each of document.querySelectorAll('details')) each.open = true")
        nameless = page.evaluate(
            """() => [...document.querySelectorAll("button, input, select, summary, textarea, img, [tabindex='0']")]
                .filter((e) => e.checkVisibility())
                .filter((e) => !(e.getAttribute("aria-label") || e.alt || e.labels?.length
                                 || e.closest("button, summary")?.textContent.trim()))
                .map((e) => e.outerHTML)"""
        )
        assert nameless == [], name
    page.locator(".brand").click()
    reached, unseen = [], []
    for _ in range(80):
        page.keyboard.press("Tab")
        name, seen = page.evaluate(
            """() => { const e = document.activeElement;
                const ring = (o) => o && getComputedStyle(o).outlineStyle !== "none"
                  && parseFloat(getComputedStyle(o).outlineWidth) > 0;
                return [e.id || e.getAttribute("aria-label") || e.tagName,
                        e === document.body || Boolean(ring(e) || ring(e.nextElementSibling))]; }"""
        )
        reached.append(name)
        if not seen:
            unseen.append(name)
    assert unseen == []
    expected = (
        "factor",
        "pause",
        "reset",
        "pane",
        "tool-fit",
        "tool-push",
        "camera-orbit",
        "open-drive",
        "open-camera",
    )
    order = [reached.index(name) for name in expected]
    assert order == sorted(order)


def test_axe_finds_no_violation_in_any_panel(page, until) -> None:
    page.locator("#open-world").press("Enter")
    page.locator(".library-entry").first.press("Enter")  # with the forms that a chosen model, a tool, a selection open
    page.evaluate("urdfkit.objects.pick('simpleton')")
    until(lambda: page.locator("#move-object").count() == 1)
    page.evaluate("urdfkit.page.tools.hold('walls')")
    assert violations(page) == {"light": [], "dark": []}


def test_sliders_that_stay_and_stop(page, keep, until) -> None:
    page.locator("#open-drive").click()
    page.get_by_text("Drive sliders and gamepad").click()
    page.locator("#steer-forward").fill("60")
    until(lambda: page.evaluate(X) > 0.15)
    page.locator("#steer-turn").fill("-50")
    until(lambda: page.evaluate("urdfkit.link().quaternion.z") < -0.1)
    keep(page, "steering")
    page.get_by_role("button", name="Stop", exact=True).click()
    assert page.locator("#steer-forward").input_value() == "0"
    until(lambda: page.locator("#velocity").inner_text() == "0.00 m/s")


def test_a_gamepad_drives(page, until) -> None:
    page.evaluate(
        """() => {
          window.pad = { connected: true, id: "Test Pad (STANDARD)", axes: [0, -1, 0, 0], buttons: [] };
          Object.defineProperty(navigator, "getGamepads", { value: () => [window.pad] });
          dispatchEvent(new Event("gamepadconnected"));
        }"""
    )
    until(lambda: page.evaluate(X) > 0.2)
    assert "Test Pad" in page.locator("#gamepad").text_content()
    page.evaluate("window.pad.axes[1] = 0.05")  # within the dead zone: let go
    until(lambda: page.locator("#velocity").inner_text() == "0.00 m/s")
    page.evaluate("window.pad.connected = false")
    until(lambda: "press one of its buttons" in page.locator("#gamepad").text_content())


def test_topics_are_listed_looked_at_plotted_and_published_to(page, keep, until) -> None:
    page.locator("#open-topics").click()
    odom = page.locator("[data-topic='/simpleton/odom']")
    until(lambda: re.fullmatch(r"\d+ Hz", odom.locator(".rate").inner_text() or ""))
    height = "parseFloat(getComputedStyle(urdfkit.topics.list).maxHeight)"
    whole = page.evaluate(height)
    page.locator("#topic-filter").fill("odom")
    until(lambda: not page.locator("[data-topic='/clock']").is_visible())
    odom.get_by_role("button").click()
    assert page.evaluate(height) < whole  # the message is below the list
    until(lambda: "child_frame_id" in page.locator(".message").inner_text())
    keep(page, "topic")
    page.locator("#numbers summary").click()
    page.get_by_role("button", name="pose.pose.position.x", exact=True).click()
    page.locator("#open-topics").click()  # the plot, which is pinned, stays next to it
    page.locator("#topic-filter").fill("cmd_vel")
    page.locator("[data-topic='/simpleton/cmd_vel']").get_by_role("button").click()
    page.locator("#publish summary").click()
    page.get_by_label("linear.x").fill("0.4")
    page.get_by_role("button", name="Publish", exact=True).click()
    until(lambda: page.evaluate(X) > 0.1)
    curve = "[...urdfkit.plots.curves.values()][0].curve"
    until(lambda: page.evaluate(f"{curve}.values[{curve}.length - 1]") > 0.1)
    keep(page, "publish")
    for key in ("k", "Space"):  # they stop what a hand did not begin
        page.locator("#pane").focus()
        page.keyboard.press(key)
        until(lambda: abs(page.evaluate("urdfkit.page.status.speed")) < 0.01)
        page.get_by_role("button", name="Publish", exact=True).click()
        until(lambda: page.evaluate("urdfkit.page.status.speed") > 0.3)


OVERFULL = """() => {
  const Curve = [...urdfkit.plots.curves.values()][0].curve.constructor;
  const curve = new Curve("", "red"), before = curve.t.length;
  for (let start = 0; start < 95000; start += 5) {
    const t = [0, 1, 2, 3, 4].map((each) => start + each);
    curve.push(t, t.map((each) => 2 * each));
  }
  return [before, curve.t.length, curve.length, curve.last, curve.values[curve.length - 1], curve.from(94000)];
}"""
PINCH = """([[left, right], [wider, widest]]) => {
  const plot = urdfkit.plots.canvas, { x, y, width } = plot.getBoundingClientRect();
  plot.setPointerCapture = () => undefined; // these fingers are none that the browser knows
  const touch = (kind, pointerId, part) => {
    const at = { clientX: x + part * width, clientY: y + 60 };
    plot.dispatchEvent(new PointerEvent(kind, { pointerId, pointerType: "touch", bubbles: true, ...at }));
  };
  touch("pointerdown", 71, left); touch("pointerdown", 72, right);
  touch("pointermove", 71, wider); touch("pointermove", 72, widest);
  touch("pointerup", 71, wider); touch("pointerup", 72, widest);
  delete plot.setPointerCapture;
}"""


def test_plots_zoom_stand_still_and_follow_again(page, keep, until) -> None:
    page.locator("#open-plots").click()
    for path in ("twist.twist.linear.x", "twist.twist.angular.z", "pose.pose.position.x"):
        page.locator("#plot-path").fill(f"/simpleton/odom:{path}")
        page.locator("#plot-path").press("Enter")
        until(lambda path=path: page.get_by_label(f"Remove /simpleton/odom:{path}").is_visible())
    page.locator("#plot-path").fill("/simpleton/odom:twist.twist.linear.q")
    page.locator("#plot-form button").click()
    until(lambda: page.locator(".legend").get_by_text("unknown field `q`").is_visible())
    page.keyboard.down("w")
    page.keyboard.down("a")
    until(lambda: page.evaluate("[...urdfkit.plots.curves.values()][0].curve.length") > 100)
    assert page.evaluate(OVERFULL) == [30_000, 30_000, 29_000, 94_999, 189_998, 28_000]
    page.keyboard.up("w")
    page.keyboard.up("a")
    box = page.locator("#plot").bounding_box()
    page.mouse.move(box["x"] + box["width"] * 0.7, box["y"] + 60)
    page.mouse.wheel(0, -800)
    until(lambda: page.evaluate("urdfkit.plots.plot.span") < 5)
    page.locator("#plot-pause").click()
    assert page.evaluate("urdfkit.plots.plot.paused")
    end = page.evaluate("urdfkit.plots.plot.end")
    keep(page, "plot")
    page.mouse.move(box["x"] + box["width"] * 0.5, box["y"] + 60)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] * 0.8, box["y"] + 60, steps=3)
    page.mouse.up()
    assert page.evaluate("urdfkit.plots.plot.end") < end - 0.3
    page.locator("#plot").dblclick()
    assert not page.evaluate("urdfkit.plots.plot.paused")
    page.locator("#plot").focus()
    span = page.evaluate("urdfkit.plots.plot.span")
    page.keyboard.press("+")
    assert page.evaluate("urdfkit.plots.plot.span") == pytest.approx(span / 1.25)
    page.keyboard.press("ArrowLeft")  # on the plot it drives nobody
    assert page.evaluate("urdfkit.plots.plot.paused && !urdfkit.drive.axes().some(Boolean)")
    page.keyboard.press("Home")
    assert not page.evaluate("urdfkit.plots.plot.paused")
    span = page.evaluate("urdfkit.plots.plot.span")
    page.evaluate(PINCH, [[0.4, 0.6], [0.2, 0.8]])
    assert page.evaluate("urdfkit.plots.plot.span") == pytest.approx(span / 3, rel=0.05)
    page.locator("#plot").dblclick()
    page.get_by_label("Remove /simpleton/odom:pose.pose.position.x").click()
    until(
        lambda: (
            page.evaluate("urdfkit.connection.subscriptions.has('field:/simpleton/odom:pose.pose.position.x')") is False
        )
    )


def test_objects_are_inserted_moved_turned_and_deleted(page, keep, until) -> None:
    put_down(page)
    look_from_above(page)
    page.locator("#open-world").click()
    page.locator("#library-filter").fill("crate")
    page.get_by_role("option", name="crate", exact=True).click()
    page.mouse.click(*spot(page, 1.0, 0.8))
    until(lambda: "crate" in names(page))
    page.get_by_role("option", name="crate", exact=True).click()  # put it down
    until(lambda: page.evaluate("urdfkit.scene.byLink.has('world/crate')"))
    where = order(page, "get_pose", name="crate")["pose"]
    assert where[:2] == [pytest.approx(1.0, abs=0.05), pytest.approx(0.8, abs=0.05)]
    page.mouse.move(*spot(page, 1.0, 0.8, 0.3))
    until(lambda: page.locator("#tip").text_content() == "crate")
    page.mouse.click(*spot(page, 1.0, 0.8, 0.3))
    until(lambda: page.locator(".object h3").inner_text() == "crate")
    page.get_by_label("yaw of crate").fill("45")
    page.get_by_label("yaw of crate").press("Enter")
    until(lambda: order(page, "get_pose", name="crate")["pose"][5] == pytest.approx(math.pi / 4, abs=0.02))
    page.get_by_role("button", name="Move with mouse or arrows").click()
    handle = spot(page, *order(page, "get_pose", name="crate")["pose"][:3])
    drawn(page)
    page.mouse.move(*handle)
    page.mouse.down()
    goal = spot(page, -1.03, 1.02, order(page, "get_pose", name="crate")["pose"][2])
    page.mouse.move(*goal, steps=5)
    keep(page, "moving")
    page.mouse.up()
    until(lambda: order(page, "get_pose", name="crate")["pose"][0] < -0.7)
    for at in order(page, "get_pose", name="crate")["pose"][:2]:
        assert at == pytest.approx(0.05 * round(at / 0.05), abs=3e-3)  # on the grid
    keep(page, "moved")
    page.keyboard.press("Delete")
    until(lambda: "crate" not in names(page))
    assert not page.evaluate("urdfkit.scene.byLink.has('world/crate')")


def test_objects_are_inserted_by_the_keyboard_alone(page, until) -> None:
    put_down(page)
    page.locator("#open-world").press("Enter")
    page.locator("#library-filter").fill("b")
    entries = page.locator(".library-entry")
    entries.first.focus()
    shown = entries.all_inner_texts()
    columns = entries.evaluate_all("(all) => all.filter(({ offsetTop }) => offsetTop === all[0].offsetTop).length")
    assert columns > 1
    for key, place in (("ArrowRight", 1), ("ArrowDown", 1 + columns), ("ArrowUp", 1), ("ArrowLeft", 0), ("End", -1)):
        page.keyboard.press(key)
        assert page.evaluate("document.activeElement.innerText") == shown[place]
        assert page.evaluate("urdfkit.drive.axes().every((axis) => axis === 0)")  # the arrow keys drive elsewhere
    page.locator("#library-filter").fill("crate")
    until(lambda: entries.first.locator("img").evaluate("(picture) => picture.naturalWidth") == 96)
    page.locator(".library-entry").first.press("Enter")
    for field, value in (("x", "1,5"), ("y", "-1"), ("yaw", "90")):
        page.locator(f"#insert-{field}").fill(value)
        page.locator(f"#insert-{field}").press("Enter")
    page.locator("#insert-typed").press("Enter")
    until(lambda: "crate" in names(page))
    pose = order(page, "get_pose", name="crate")["pose"]
    assert [pose[0], pose[1], pose[5]] == pytest.approx([1.5, -1.0, math.pi / 2], abs=1e-3)
    page.keyboard.press("Escape")
    assert not page.locator("#insert-typed").is_visible()


def test_changes_are_undone_and_redone_by_the_keyboard_alone(page, until) -> None:
    put_down(page)
    page.locator("#open-world").press("Enter")
    page.locator("#library-filter").fill("crate")
    page.locator(".library-entry").first.press("Enter")
    page.locator("#insert-x").fill("0")
    page.locator("#insert-y").fill("2")  # away from the robot, which would push it
    page.locator("#insert-y").press("Enter")
    page.locator("#insert-typed").press("Enter")
    until(lambda: "crate" in names(page))
    page.locator("[data-object=crate] button").press("Enter")
    page.get_by_label("x of crate").fill("1.5")
    page.get_by_label("x of crate").press("Enter")
    until(lambda: order(page, "get_pose", name="crate")["pose"][0] == pytest.approx(1.5, abs=0.01))
    page.locator("#duplicate-object").press("Enter")
    until(lambda: "crate_1" in names(page))
    page.locator("#undo").press("Enter")
    until(lambda: "crate_1" not in names(page))
    page.keyboard.press("Control+z")
    until(lambda: abs(order(page, "get_pose", name="crate")["pose"][0]) < 0.01)
    until(lambda: page.get_by_role("button", name="Undo: inserted crate").is_enabled())
    page.keyboard.press("Control+z")
    until(lambda: "crate" not in names(page))
    until(lambda: page.get_by_role("button", name="Redo: inserted crate").is_enabled())
    page.keyboard.press("Control+Shift+Z")
    until(lambda: "crate" in names(page))
    page.locator("#open-physics").press("Enter")
    gravity = page.get_by_label("gravity along z")
    gravity.fill("-1.62")
    gravity.press("Enter")
    until(lambda: page.get_by_role("button", name="Undo: changed gravity").is_enabled())
    page.locator("#undo").press("Enter")
    until(lambda: gravity.input_value() == "-9.81")
    put_down(page)


FOLDED = """() => {
  const joint = (name) => ({ name, lower: -1, upper: 1, unit: "rad", value: 0 });
  const arm = (k) => ({ name: `r/c${k}`, type: "t", running: true, joints: [joint(`j${k}`)] });
  const panel = document.getElementById("panel-arms");
  const shown = () => [...panel.querySelectorAll("[data-joint]")].filter((each) => each.checkVisibility());
  const seen = [];
  for (const count of [7, 7, 4]) {
    urdfkit.page.emit("arms", { arms: [...Array(count).keys()].map(arm) });
    urdfkit.page.panels.open("arms");
    seen.push(shown().map((each) => each.dataset.joint));
    if (seen.length === 1) seen.push(panel.offsetHeight < 0.6 * innerHeight), panel.querySelector("[data-controller='r/c3'] .unfold").click();
  }
  urdfkit.page.emit("arms", { arms: [] });
  return seen;
}"""  # noqa: E501
"""All at once, so that nothing the simulation says comes between."""


def test_the_joints_of_many_controllers_are_folded_away(page) -> None:
    assert page.evaluate(FOLDED) == [[], True, ["j3"], ["j0", "j1", "j2", "j3"]]


def test_walls_through_the_robot_are_a_warning(page, until) -> None:
    put_down(page)
    look_from_above(page, 9.0)
    page.locator("#open-world").click()
    page.locator("#draw-walls").click()
    for corner in ((-1.5, 0.0), (1.8, 0.0)):
        page.mouse.click(*spot(page, *corner))
    page.locator("#wall-build").click()
    # In the answer, and as a remark of the world.
    until(lambda: "`walls` starts" in page.locator("#toast").inner_text())
    assert page.locator("#toast").get_attribute("data-tone") == "warning"
    page.keyboard.press("Escape")
    order(page, "remove", name="walls")


def test_walls_with_a_door_are_drawn_and_the_world_is_saved(page, keep, until, tmp_path: Path) -> None:
    put_down(page)
    look_from_above(page, 9.0)
    page.locator("#open-world").click()
    page.locator("#draw-walls").click()
    for corner in ((-1.5, -1.2), (1.8, -1.2), (1.8, 1.5)):
        page.mouse.click(*spot(page, *corner))
    page.locator("#wall-door-mode").click()
    page.mouse.click(*spot(page, 0.3, -1.2))
    keep(page, "drawing")
    page.locator("#wall-build").click()
    until(lambda: "walls" in names(page))
    until(lambda: page.evaluate("urdfkit.scene.byLink.has('world/walls')"))
    page.keyboard.press("Escape")
    drawn(page)
    keep(page, "walls")
    with page.expect_download() as download:
        page.locator("#save-world").click()
    file = tmp_path / "saved.sdf"
    download.value.save_as(file)
    from urdfkit.description.sdf import load_world

    saved = load_world(file)
    walls = next(model for model in saved.models if model.name == "walls")
    assert walls.static
    assert len(walls.links[0].collisions) == 4  # one wall in two pieces and a lintel, one whole
    order(page, "remove", name="walls")


def test_walls_are_drawn_and_moved_by_the_keyboard_alone(page, keep, until) -> None:
    put_down(page)
    look_from_above(page, 9.0)
    page.locator("#open-world").press("Enter")
    page.locator("#draw-walls").press("Enter")
    for corner in ((-1.5, -1.2), (1.75, -1.2), (1.75, 1.5)):
        for axis, value in zip("xy", corner, strict=True):
            page.locator(f"#wall-{axis}").fill(str(value))
        page.locator("#wall-y").press("Enter")
    page.locator("#wall-number").fill("3")
    page.locator("#wall-number").press("Enter")
    until(lambda: page.locator("#toast").inner_text() == "there is no wall 3; the last one is 2")
    page.locator("#wall-number").fill("2")
    page.locator("#wall-door-at").fill("1.5")
    page.get_by_role("button", name="Add door").press("Enter")
    page.locator(".walls button", has_text="Undo").press("Enter")
    assert page.evaluate("[urdfkit.walls.doors.length, urdfkit.walls.corners.length]") == [0, 3]
    page.get_by_role("button", name="Add door").press("Enter")
    assert page.evaluate("urdfkit.walls.corners") == [[-1.5, -1.2], [1.75, -1.2], [1.75, 1.5]]
    assert page.evaluate("urdfkit.walls.doors") == [{"segment": 1, "at": 1.5, "width": 0.9}]
    keep(page, "walls-typed")
    page.locator("#wall-build").press("Enter")
    until(lambda: page.evaluate("urdfkit.scene.byLink.has('world/walls')"))
    page.keyboard.press("Escape")

    page.locator("[data-object=walls] button").press("Enter")
    until(lambda: page.locator("#move-object").is_visible())  # a hidden one of an earlier test cannot be focused
    page.locator("#move-object").press("Enter")
    before = order(page, "get_pose", name="walls")["pose"]
    page.evaluate("urdfkit.page.emit('select', urdfkit.page.selected)")  # as when the links arrive after an insertion
    for key in ("ArrowUp", "ArrowUp", "ArrowLeft", "Shift+ArrowUp", "Shift+ArrowLeft"):
        page.keyboard.press(key)
    step = (-0.05, 0.1, 0.05, 0.0, 0.0, math.radians(5))  # seen from -y
    after = [start + by for start, by in zip(before, step, strict=True)]
    until(lambda: order(page, "get_pose", name="walls")["pose"] == pytest.approx(after, abs=1e-6))
    until(lambda: page.evaluate("document.activeElement.id") == "move-object")  # the form is created again
    assert page.evaluate("urdfkit.drive.timer") is None  # the robot was not driven
    keep(page, "walls-moved")
    page.get_by_role("button", name="Undo: moved walls").press("Enter")
    until(lambda: order(page, "get_pose", name="walls")["pose"] != pytest.approx(after, abs=1e-6))
    put_down(page)


def test_parameters_are_changed_while_it_runs(page, keep, until) -> None:
    page.locator("#open-physics").click()
    page.get_by_label("Gravity of a planet").select_option(label="none")
    until(lambda: page.get_by_label("gravity along z").input_value() == "0")
    page.locator("#parameter-filter").fill("chassis")
    mass = page.locator("tr[data-of='simpleton/chassis']").get_by_label("mass of chassis")
    before = float(mass.input_value())
    mass.fill(str(2 * before))
    mass.press("Enter")
    page.locator("#parameter-filter").fill("chass")  # redrawn from the state of the simulation
    until(lambda: float(mass.input_value()) == 2 * before)
    keep(page, "physics")
    page.get_by_label("Gravity of a planet").select_option(label="Earth")
    order(page, "mass", name="simpleton", link="chassis", mass=before)
    until(lambda: page.get_by_label("gravity along z").input_value() == "-9.81")


@pytest.mark.slow
def test_gains_of_a_controller_are_changed_undone_and_kept_by_the_simulation(serve, visits, until) -> None:
    url = serve("sim", "teleop", "rrbot").url
    page = visits.open(url, viewport=SIZE)
    page.locator("#open-physics").click()
    gains = page.locator(".gains fieldset").first
    path = gains.get_attribute("data-of")
    field = {name: page.get_by_label(f"{name} of {path}", exact=True) for name in ("p", "i", "d", "clamp")}
    before = {name: float(each.input_value()) for name, each in field.items()}

    def reported() -> dict[str, float]:
        """Return the gains in a page that is opened now, which come from the simulation."""
        another = visits.open(url, viewport=SIZE)
        another.locator("#open-physics").click()
        another.locator(f".gains fieldset[data-of='{path}']").wait_for()
        found = {name: float(another.get_by_label(f"{name} of {path}", exact=True).input_value()) for name in field}
        another.context.close()
        return found

    changed = {**before, "p": before["p"] + 7.5, "d": before["d"] + 0.25}
    for name in ("p", "d"):
        field[name].fill(str(changed[name]))
        field[name].press("Enter")
    until(lambda: page.locator("#undo").is_enabled())
    until(lambda: reported() == changed)
    field["p"].fill("-1")
    field["p"].press("Enter")
    assert float(field["p"].input_value()) == changed["p"]  # gains are not negative
    for expected in ({**before, "p": changed["p"]}, before):
        page.locator("#undo").click()
        until(lambda expected=expected: {name: float(each.input_value()) for name, each in field.items()} == expected)
    assert reported() == before


SLOW = 200
"""Time between two keys of a person who types slowly [ms]; the page gets several messages meanwhile."""


def test_the_column_scrolls_only_to_a_panel_that_does_not_fit_and_back(page, until) -> None:
    scrolled, top = "document.getElementById('panel').scrollTop", "document.getElementById('panel').offsetTop"
    for name in ("drive", "joints"):
        page.evaluate("(name) => urdfkit.page.panels.open(name)", name)
    drawn(page)
    assert page.locator("#panel-joints").bounding_box()["y"] > 200  # below Drive, which stays open
    assert page.evaluate(scrolled) == 0
    page.locator("#open-world").click()
    page.locator("#library-filter").fill("")  # all models, which do not fit below Drive
    page.get_by_role("button", name="Close World").click()
    page.locator("#open-world").click()
    until(lambda: page.locator("#panel-world").bounding_box()["y"] == pytest.approx(page.evaluate(top), abs=1))
    assert page.evaluate(scrolled) > 100
    page.get_by_role("button", name="Close World").click()
    until(lambda: page.evaluate(scrolled) == 0)  # nothing of Drive is cut off
    assert page.locator("#panel-drive").bounding_box()["y"] == pytest.approx(page.evaluate(top), abs=1)


def test_a_text_that_is_typed_survives_messages(page, until) -> None:
    put_down(page)
    order(page, "spawn", model="crate", pose=[2, 2, 0], name="first")

    # Parameters: a message of another change arrives; it is shown when the focus leaves the table.
    page.locator("#open-physics").click()
    page.locator("#parameter-filter").fill("")
    mass = page.get_by_role("textbox", name="mass of first")
    mu = page.get_by_role("textbox", name="mu of first")
    friction, typed = mu.input_value(), "12.5"
    mass.select_text()
    mass.press_sequentially(typed[:2], delay=SLOW)
    order(page, "mu", name="first", mu=0.25)
    mass.press_sequentially(typed[2:], delay=SLOW)
    assert (mass.input_value(), mu.input_value()) == (typed, friction)
    mass.blur()
    until(lambda: mu.input_value() == "0.25")
    until(lambda: mass.input_value() == typed)

    # A choice of links is not replaced while it is open.
    page.locator("#open-push").click()
    link = page.locator("#push-link")
    link.select_option(label="first")
    link.focus()
    before = link.locator("option").count()
    order(page, "spawn", model="crate", pose=[-2, 2, 0], name="second")
    until(lambda: "second" in names(page))
    assert (link.locator("option").count(), link.input_value()) == (before, "first")
    link.blur()
    until(lambda: link.locator("option").count() == before + 1)
    assert link.input_value() == "first"

    # The pose of an object: the first number is sent while the second one is typed.
    page.locator("#open-world").click()
    page.locator("[data-object=first] button").click()
    x, y = page.get_by_label("x of first"), page.get_by_label("y of first")
    x.select_text()
    x.press_sequentially("1.5")
    x.press("Tab")
    y.press_sequentially("-1.25", delay=SLOW)
    assert y.input_value() == "-1.25"
    y.press("Enter")
    until(lambda: order(page, "get_pose", name="first")["pose"][:2] == pytest.approx([1.5, -1.25], abs=0.01))
    assert y.evaluate("(field) => field === document.activeElement")

    # Joints of a paused simulation: an insertion sends the model again.
    page.locator("#pause").click()
    page.locator("#open-joints").click()
    number = page.locator("#panel-joints li[data-joint] input.number:enabled").first
    number.select_text()
    number.press_sequentially("0.", delay=SLOW)
    order(page, "remove", name="second")
    until(lambda: "second" not in names(page))
    number.press_sequentially("75", delay=SLOW)
    assert number.input_value() == "0.75"
    number.press("Enter")
    joint = number.evaluate("(field) => field.closest('li').dataset.joint")
    until(lambda: page.evaluate("(joint) => urdfkit.page.values[joint]", joint) == pytest.approx(0.75))
    page.locator("#pause").click()
    put_down(page)


TYPED = """async (text) => {
  const joint = { name: "j", lower: -1, upper: 1, unit: "rad", value: 0 };
  const arms = (running) => urdfkit.page.emit("arms", { arms: [{ name: "r/c", type: "t", running, joints: [joint] }] });
  const panel = document.getElementById("panel-arms");
  arms(true);
  urdfkit.page.panels.open("arms");
  const field = panel.querySelector("input.number");
  field.focus();
  field.value = text;
  arms(false);
  const seen = [document.activeElement === field && field.value];
  field.blur();
  seen.push(panel.querySelector("[data-controller]").dataset.running);
  urdfkit.page.emit("arms", { arms: [] });
  return seen;
}"""


def test_long_names_of_controllers_break_at_words(page) -> None:
    fold, breaks = page.evaluate(
        """() => {
          const arm = (k) => ({ name: `arm/joint${k}_position_controller`, type: "t", running: true, joints: [] });
          urdfkit.page.emit("arms", { arms: [1, 2, 3, 4, 5, 6].map(arm) });
          urdfkit.page.panels.open("arms");
          const first = document.querySelector("#panel-arms .controller");
          const [fold, name] = [first.querySelector(".unfold"), first.querySelector("h3")];
          const found = [fold.offsetWidth, name.querySelectorAll("wbr").length];
          urdfkit.page.emit("arms", { arms: [] });
          return found;
        }"""
    )
    assert fold < 40  # leaves the width to the name
    assert breaks == 3


def test_plots_below_the_view_have_their_legend_beside_them(page) -> None:
    # One script each: a sample of the simulation between two scripts changes values and widths.
    shown = page.evaluate(
        """() => {
          urdfkit.plots.add("/odom", "twist.twist.linear.y");
          const curve = "field:/odom:twist.twist.linear.y";
          urdfkit.page.emit("samples", { curve, t: [1e6, 1e6 + 1], values: [1, 1e-7] });
          return [...document.querySelectorAll(".legend .value")].at(-1).textContent;
        }"""
    )
    assert shown == "0"
    canvas, legend = page.evaluate(
        """() => {
          const { panels } = urdfkit.page;
          panels.places.put(panels.all.get("plots"), "below", true);
          const edges = ["#plot", ".legend"].map((each) => document.querySelector(each).getBoundingClientRect());
          return [edges[0].right, edges[1].left];
        }"""
    )
    assert canvas <= legend
    page.evaluate("urdfkit.plots.remove('field:/odom:twist.twist.linear.y')")
    page.evaluate("urdfkit.page.panels.places.put(urdfkit.page.panels.all.get('plots'), 'side', true)")


def test_a_pinned_panel_that_was_closed_just_before_a_reload_stays_closed(served, visits, until) -> None:
    page = visits.open(served.url, viewport=SIZE)
    sensors = page.locator("#panel-sensors")
    until(sensors.is_visible)
    page.get_by_role("button", name="Close Sensors").click()
    page.reload()
    page.wait_for_selector("body[data-ready=true][data-running=true]")
    until(page.locator("#open-sensors").is_visible)
    assert not sensors.is_visible()


@pytest.mark.parametrize("size", [SIZE, {"width": 390, "height": 844}, {"width": 844, "height": 390}], ids=str)
def test_a_message_covers_neither_the_readout_nor_the_pad(served, visits, keep, size: dict[str, int]) -> None:
    is_phone = size != SIZE
    page = visits.open(served.url, viewport=size, is_mobile=is_phone, has_touch=is_phone)
    for panel in (None, "world", "plots") if is_phone else (None,):
        if panel:
            page.evaluate(f"urdfkit.page.panels.open('{panel}')")
        if panel == "plots":  # leaves little room to a phone on its side
            page.evaluate("urdfkit.page.panels.places.put(urdfkit.page.panels.all.get('plots'), 'below', true)")
        for text in ("saved", "a long message " * 14):
            page.evaluate("(text) => urdfkit.page.toast(text, 'warning')", text)
            keep(page, f"message-{size['width']}-{panel}")
            boxes = [page.locator(f"#{name}").bounding_box() for name in ("toast", "readout", "pad")]
            assert all(apart(*pair) for pair in combinations(boxes, 2)), (panel, text)
            view = page.locator("#viewport").bounding_box()
            assert all(each["height"] > 20 for each in boxes)
            assert all(each["y"] + each["height"] <= view["y"] + view["height"] for each in boxes), (panel, text)


def test_plots_of_a_phone_have_the_width_of_the_screen(served, visits) -> None:
    page = visits.open(served.url, viewport={"width": 390, "height": 844})
    page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.linear.x')")
    page.evaluate("urdfkit.page.panels.places.put(urdfkit.page.panels.all.get('plots'), 'below', true)")
    page.evaluate("urdfkit.page.panels.open('plots')")
    plot, legend = (page.locator(f"#panel-plots .{name}").bounding_box() for name in ("plot", "legend"))
    assert plot["width"] > 340
    assert legend["y"] >= plot["y"] + plot["height"]
    page.set_viewport_size({"width": 844, "height": 390})  # on its side
    page.evaluate("urdfkit.page.panels.open('plots')")
    sized(page)
    pad, pane = (page.locator(f"#{name}").bounding_box() for name in ("pad", "pane"))
    assert pad["y"] > pane["y"] + 30  # below the read-out


def test_symbols_of_many_centres_of_mass_are_smaller(page) -> None:
    count, size = page.evaluate(
        "(() => { const { com } = urdfkit.markers.made;"
        " return [com.length, com[0].scale.x / urdfkit.viewport.radius / urdfkit.markers.size]; })()"
    )
    assert count > 4
    assert size == pytest.approx(0.07 / math.sqrt(count))


def test_the_list_of_objects_keeps_the_focus(page) -> None:
    put_down(page)
    order(page, "spawn", model="crate", pose=[2, 2, 0], name="first")
    page.evaluate("urdfkit.page.panels.open('world')")
    item = page.locator("[data-object=first] button")
    item.focus()
    order(page, "spawn", model="crate", pose=[-2, 2, 0], name="last")
    page.wait_for_selector("[data-object=last]")
    focused = "document.activeElement.closest('[data-object]')?.dataset.object"
    assert page.evaluate(focused) == "first"
    order(page, "remove", name="first")
    page.wait_for_selector("[data-object=first]", state="detached")
    assert page.evaluate(focused) == "last"  # the next one
    put_down(page)


def test_the_target_of_a_joint_that_is_typed_survives_a_change_of_its_controller(page) -> None:
    assert page.evaluate(TYPED, "0.") == ["0.", "false"]


def test_a_link_is_pushed_with_the_mouse(page, keep, until) -> None:
    page.locator("#open-push").click()
    page.locator("#push-hold").click()
    page.locator("#push-strength").fill("1.7")
    start = page.evaluate("[urdfkit.link().position.x, urdfkit.link().position.y]")
    at = spot(page, 0.0, 0.0, 0.1)
    page.mouse.move(*at)
    page.mouse.down()
    page.mouse.move(at[0] + 80, at[1] - 30, steps=5)
    until(lambda: page.evaluate("urdfkit.push.grip !== null"))
    until(lambda: math.dist(start, page.evaluate("[urdfkit.link().position.x, urdfkit.link().position.y]")) > 0.004)
    keep(page, "push")
    assert re.search(r"[\d.]+ N$", page.locator("#push-now").inner_text())
    page.mouse.up()
    assert page.evaluate("urdfkit.push.grip") is None
    page.get_by_label("Torque").check()
    assert "N·m/m" in page.locator("output[for=push-strength]").inner_text()
    page.get_by_label("Force at the point").check()
    page.keyboard.press("Escape")
    assert page.evaluate("urdfkit.page.tools.held") is None


def test_a_push_of_a_given_force_and_time_by_the_keyboard_alone(page, keep, until) -> None:
    put_down(page)
    order(page, "gravity", gravity=[0, 0, 0])
    order(page, "spawn", model="crate", pose=[1.0, 1.0, 1.0])
    page.get_by_role("button", name="Pause").press("Enter")
    until(lambda: page.locator("#rtf").inner_text() == "paused")
    page.locator("#open-physics").press("Enter")
    page.locator("#parameter-filter").fill("crate")
    mass = float(page.get_by_label("mass of crate").input_value())
    start = order(page, "get_pose", name="crate")
    page.locator("#open-push").press("Enter")
    until(lambda: page.locator("#push-link option", has_text="crate").count() == 1)
    page.locator("#push-link").select_option("crate")
    page.locator("#push-seconds").fill("many")
    page.locator("#push-seconds").press("Enter")
    until(lambda: page.locator("#toast").inner_text() == "duration: “many” is not a number, such as 0.5")
    page.locator("#push-seconds").fill("0.05")
    force = 20 * mass
    page.get_by_label("force along z [N]").fill(str(force))
    page.get_by_label("force along z [N]").press("Enter")
    until(lambda: page.locator("#push-now").inner_text() == f"crate: {force:.4g} N for 0.05 s")
    keep(page, "push-typed")
    page.locator("#steps").fill("100")
    page.get_by_role("button", name="Step", exact=True).press("Enter")
    raised = 0.5 * 20 * 0.05**2 + 20 * 0.05 * 0.05  # 20 m/s² for 0.05 s, then 0.05 s without a force
    until(
        lambda: order(page, "get_pose", name="crate")["pose"][2] == pytest.approx(start["pose"][2] + raised, abs=1e-3)
    )
    page.get_by_label("Torque").check()
    assert page.get_by_label("torque about z [N·m]").is_visible()
    page.get_by_label("Force at the point").check()
    put_down(page)
    order(page, "gravity", gravity=[0, 0, -9.81])


def test_contact_forces_slip_and_trails_are_drawn(page, keep, until) -> None:
    page.locator("#open-show").click()
    page.get_by_label("Contact forces").check()
    page.get_by_label("Wheel slip").check()
    # A wheel carries 5.30 N, the caster 4.60 N: 1.55 kg in all.
    until(lambda: page.evaluate("urdfkit.arrows.contacts.longest") == pytest.approx(5.3, abs=0.05))
    assert page.evaluate("urdfkit.arrows.contacts.count") == 3
    page.keyboard.down("w")
    page.keyboard.down("a")
    until(lambda: page.evaluate("urdfkit.trails.real.count") > 20)
    page.keyboard.up("w")
    page.keyboard.up("a")
    assert page.evaluate("urdfkit.trails.believed.count") > 5
    assert page.locator(".slips [data-link]").count() >= 2
    keep(page, "forces")
    page.get_by_label("Contact forces").uncheck()
    page.get_by_label("Wheel slip").uncheck()
    until(lambda: not page.evaluate("urdfkit.connection.subscriptions.has('contacts')"))


def test_what_was_recorded_is_shown_again_and_topics_are_saved(page, keep, until, tmp_path: Path) -> None:
    from rosbags.rosbag2 import Reader

    page.locator("#open-recorder").click()
    page.get_by_label("Record topics to an MCAP file").check()
    page.locator("#record").click()
    until(lambda: "Recording" in page.locator("#recorder-state").inner_text())
    page.keyboard.down("w")
    until(lambda: page.evaluate(X) > 0.4)
    page.keyboard.up("w")
    with page.expect_download() as download:
        page.locator("#record").click()
    download.value.save_as(tmp_path / "ride.mcap")
    with Reader(tmp_path / "ride.mcap") as reader:
        assert {"/clock", "/simpleton/odom"} <= set(reader.topics)
    until(lambda: page.locator("#replay-play").is_visible())
    here = page.evaluate(X)
    page.locator("#replay-at").evaluate(
        "(slider) => { slider.value = slider.min; slider.dispatchEvent(new Event('input', { bubbles: true })); }"
    )
    until(lambda: page.evaluate(X) < 0.05)
    assert page.locator("#replaying").is_visible()
    now, begin = page.evaluate("[urdfkit.page.status.time, Number(document.querySelector('#replay-at').min)]")
    until(lambda: page.locator("#sim-time").inner_text() == f"{begin:.1f} s")  # of the recording
    assert begin < now - 0.3
    assert page.locator("#rtf").inner_text() == "replay"
    assert float(page.locator("#position").inner_text().split(",")[0]) == pytest.approx(0.0, abs=0.05)
    page.locator("#replay-play").click()
    until(lambda: page.evaluate(X) > 0.1)
    keep(page, "replay")
    page.evaluate("urdfkit.page.panels.open('camera')")
    page.get_by_label("One turn, or a timelapse, takes").fill("1")
    with page.expect_download() as download:
        page.get_by_role("button", name="Timelapse of the replay").click()
    assert Path(download.value.path()).stat().st_size > 2000
    until(lambda: page.evaluate(X) == pytest.approx(here, abs=0.3))  # it was played to its end
    page.evaluate("urdfkit.page.panels.open('recorder')")
    page.locator("#replay-end").click()
    until(lambda: page.locator("#rtf").inner_text() != "replay")
    assert float(page.locator("#sim-time").inner_text().split()[0]) >= now - 0.1
    until(lambda: not page.locator("#replaying").is_visible())
    until(lambda: page.evaluate(X) == pytest.approx(here, abs=0.3))


def test_a_second_robot_is_inserted_and_driven(page, keep, until) -> None:
    put_down(page)
    page.locator("#open-drive").click()
    assert order(page, "spawn", model="mybot", pose=[1.2, 1.2, 0.0, 0.0])["name"] == "mybot"
    until(lambda: page.locator("#driven").is_visible())
    page.locator("#driven").select_option("mybot")
    start = page.evaluate("urdfkit.link(urdfkit.page.followed).position.x")
    first = page.evaluate(X)
    page.keyboard.down("w")
    until(lambda: page.evaluate("urdfkit.link(urdfkit.page.followed).position.x") > start + 0.15)
    keep(page, "two-robots")
    page.keyboard.up("w")
    assert page.evaluate(X) == pytest.approx(first, abs=0.02)
    order(page, "remove", name="mybot")
    until(lambda: not page.locator("#driven").is_visible())


def apart(one: dict[str, float], other: dict[str, float]) -> bool:
    """Return whether two rectangles of the page have no common point."""
    return any(
        a[start] + a[size] <= b[start]
        for start, size in (("x", "width"), ("y", "height"))
        for a, b in ((one, other), (other, one))
    )


def test_only_the_driver_can_change_the_simulation(page, served, visits, until) -> None:
    other = visits.open(served.url, viewport={"width": 640, "height": 480})
    page.bring_to_front()
    page.keyboard.down("w")
    reported = until(lambda: other.locator("#driver-other").bounding_box())
    for name in ("#readout", "#pad", *(f"#tools button >> nth={k}" for k in range(4))):
        there = other.locator(name).bounding_box()
        assert there is None or apart(reported, there), name
    ask = "urdfkit.connection.request('gravity', { gravity: [0, 0, -9.81] }).catch((error) => error.message)"
    until(lambda: "another page is driving" in str(other.evaluate(ask)))
    page.keyboard.up("w")


def test_a_phone_shows_the_panels_as_a_sheet(served, visits, keep, until) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
    page = visits.open(served.url, color_scheme="dark", **phone)
    for panel in ("topics", "world", "recorder"):
        page.locator(f"#open-{panel}").tap()
        until(lambda panel=panel: page.locator(f"#panel-{panel}").is_visible())
        keep(page, f"phone-{panel}")
    page.evaluate("document.getElementById('robot-name').textContent = 'diff_wheeled_robot_with_laser'")
    assert page.evaluate(
        "(({ scrollWidth, clientWidth }) => scrollWidth <= clientWidth)(document.getElementById('robot-name'))"
    )
    wide = page.evaluate("document.documentElement.scrollWidth")
    assert wide <= 390
    keys, pause = page.get_by_role("button", name="Keys", exact=True), page.locator("#pause")
    for paused in (False, True):  # a paused simulation has more controls in the bar
        until(lambda paused=paused: page.locator("#step").is_visible() == paused)
        box = keys.bounding_box()
        assert box["x"] + box["width"] <= 390
        keys.tap()
        page.locator("#help").get_by_role("button", name="Close").tap()
        keep(page, f"phone-bar-{paused}")
        pause.tap()
    until(lambda: page.locator("#step").is_hidden())


def test_measuring_and_publishing_a_point(page, keep, until) -> None:
    page.get_by_role("button", name="Pause").click()
    look_from_above(page)
    page.get_by_role("button", name="Measure between two points").click()
    page.mouse.click(*spot(page, 1.0, 1.0))
    page.mouse.click(*spot(page, 1.0, -1.0))
    label = page.locator(".measure-label")
    length = until(lambda: label.count() == 1 and re.fullmatch(r"([\d.]+) m", label.inner_text()))
    assert float(length[1]) == pytest.approx(2.0, abs=0.02)  # a pixel is about a centimetre
    page.get_by_role("button", name="Publish a point").click()
    page.mouse.click(*spot(page, -1.0, 1.0))
    until(lambda: re.fullmatch(r"Published -(1|0\.99).* in world", page.locator("#toast").inner_text()))
    keep(page, "measure")
    page.locator("#open-measure").click() if page.locator("#panel-measure").is_hidden() else None
    page.get_by_role("button", name="Clear", exact=True).click()
    page.keyboard.press("Escape")
