"""Findings, and the rest of the viewer's page, in a real browser."""

import re
import struct
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from tests.cli.accessibility import violations
from tests.cli.lab import ROBOT, TWINS, at, drawn, panel, values, write

pytestmark = pytest.mark.browser


@pytest.fixture
def page(lab_page):
    return lab_page


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
    counted = page.evaluate("urdfkit.page.findings.length")
    assert page.locator("#open-findings .count").inner_text() == str(counted)  # notes too, as the badges do
    assert {int(each) for each in page.locator(".badge").all_inner_texts()} == {1}
    assert page.locator(".badge").count() == page.evaluate("urdfkit.page.findings.flatMap((f) => f.links).length")
    page.get_by_role("button", name="1 finding on lower").click()
    assert page.evaluate("urdfkit.page.selected") == {"link": "lower"}
    card = page.locator(".finding")
    assert card.count() == 1
    line = next(i for i, row in enumerate(ROBOT.splitlines(), 1) if 'axis xyz="0 2 0"' in row)
    assert f"lab.urdf.xacro:{line}" in card.inner_text()
    assert "J412" in card.inner_text()
    assert '<axis xyz="0 2 0"/>' in card.locator(".code").first.inner_text()
    assert [row[0] for row in card.locator(".diff .code-line").all_inner_texts()] == ["-", "+"]
    card.get_by_text("Rule", exact=True).click()
    assert card.locator(".prose h3").first.inner_text() == "axis-not-normalised (J412)"
    keep(page, "finding")
    camera = page.evaluate("urdfkit.viewport.viewer.camera.position.toArray()")
    model = page.evaluate("urdfkit.scene.model")
    before = path.read_text()
    card.get_by_role("button", name="Apply fix").click()
    until(lambda: page.evaluate("urdfkit.scene.model") != model)
    assert path.read_text() == before.replace('axis xyz="0 2 0"', 'axis xyz="0 1 0"')
    until(lambda: page.locator(".badge[data-link=lower]").count() == 0)
    assert "fixed J412: Normalise the axis" in served.errors.read_text()
    assert page.evaluate("urdfkit.page.selected") == {"link": "lower"}
    assert values(page)["bend"] == 0.5
    assert page.evaluate("urdfkit.viewport.viewer.camera.position.toArray()") == pytest.approx(camera)
    glow = "urdfkit.scene.shapes('lower', 'visual')[0].children[0].children[0].material.emissive.getHex()"
    until(lambda: page.evaluate(glow) != 0)  # what was selected still shines
    keep(page, "fixed")
    refused = page.evaluate("urdfkit.connection.request('fix', { finding: 1 }).catch((error) => error.message)")
    assert "outdated" in refused
    for order, values_ in (("fix", {"finding": "../x"}), ("fix", {"finding": 1, "path": "x"}), ("write", {})):
        sent = page.evaluate(
            "([o, v]) => urdfkit.connection.request(o, v).then(() => 'done', (e) => e.message)", [order, values_]
        )
        assert sent != "done"
    assert visits.problems == []


def test_a_robot_that_outgrows_the_view_is_fitted_again_but_not_against_a_person(
    serve, visits, until, tmp_path: Path
) -> None:
    path = tmp_path / "box.urdf"

    def grow(size: float) -> None:
        shape = f'<visual><geometry><box size="{size} {size} {size}"/></geometry></visual>'
        path.write_text(f'<robot name="box"><link name="base">{shape}</link></robot>')

    def radius() -> float:
        return float(page.evaluate("urdfkit.viewport.radius"))

    grow(1.0)
    page = visits.open(serve("view", str(path)).url)
    until(lambda: radius() == pytest.approx(0.75**0.5))
    for size in (2.0, 0.5):
        grow(size)
        until(lambda size=size: radius() == pytest.approx(0.75**0.5 * size))

    def placed(size: float) -> None:
        poses = page.evaluate(frames)
        grow(size)
        until(lambda: page.evaluate(frames) > poses)
        page.evaluate("urdfkit.scene.settled()")
        drawn(page)

    frames = "Number(document.body.dataset.frames)"
    placed(0.55)
    assert radius() == pytest.approx(0.75**0.5 * 0.5)
    middle = page.locator("#pane").bounding_box()
    page.mouse.move(middle["x"] + middle["width"] / 2, middle["y"] + middle["height"] / 2)
    place = "urdfkit.viewport.viewer.camera.position.toArray()"
    before = page.evaluate(place)
    page.mouse.wheel(0, 300)
    until(lambda: page.evaluate(place) != before)
    camera = page.evaluate(place)
    placed(3.0)
    assert page.evaluate(place) == pytest.approx(camera)


def test_a_robot_without_visual_shapes_stands_on_the_ground_and_shows_its_collision_shapes(
    serve, visits, tmp_path: Path
) -> None:
    shape = '<collision><geometry><sphere radius="0.5"/></geometry></collision>'
    (tmp_path / "ball.urdf").write_text(f'<robot name="ball"><link name="base">{shape}</link></robot>')
    page = visits.open(serve("view", str(tmp_path / "ball.urdf")).url)
    assert page.locator("#show-collision").is_checked()
    look = """() => {
      const [shown] = urdfkit.scene.shapes("base", "collision"), found = [shown.visible];
      shown.traverse(({ material, castShadow }) => material && found.push(material.opacity, castShadow));
      return found;
    }"""
    assert page.evaluate(look) == [True, 1, True]
    assert page.evaluate("urdfkit.viewport.floor") == pytest.approx(-0.5)


def test_a_finding_in_a_macro_marks_every_link_it_made(serve, visits, until, tmp_path: Path) -> None:
    path = tmp_path / "two.urdf.xacro"
    path.write_text(TWINS)
    page = visits.open(serve("view", str(path)).url)
    page.wait_for_selector(".badge")
    page.locator("#open-findings").click()
    card = page.locator(".finding").filter(has_text="two.urdf.xacro:7")
    assert card.locator(".chips .chip").all_inner_texts() == ["wheel_left", "wheel_right"]
    assert "wheel" in card.inner_text().split("two.urdf.xacro:10")[0]  # through which call
    for link in ("a", "b", "wheel_left", "wheel_right"):
        assert page.locator(f".badge[data-link={link}]").count() == 1
    left = "urdfkit.page.findings.filter(({ code }) => code === 'E024').length"
    for count in (3, 2, 1, 0):  # all of them say the same
        first = page.locator(".finding").filter(has_text="E024").first
        first.get_by_role("button", name="Apply fix").click()
        until(lambda count=count: page.evaluate(left) == count)
    assert "0 0 0 2" not in path.read_text()
    assert visits.problems == []


def test_find_by_name_and_take_it_with_enter(page) -> None:
    page.locator("#pane").focus()
    page.keyboard.press("/")
    page.keyboard.type("low")
    page.keyboard.press("Enter")
    assert page.evaluate("urdfkit.page.selected") == {"link": "lower"}
    page.locator("#tree-search").fill("t")  # turn, tip, left, right …
    found = page.evaluate("[...document.querySelectorAll('.tree [data-found]')].map((each) => each.textContent)")
    page.keyboard.press("Enter")
    seen = [page.evaluate("urdfkit.page.selected")]
    for _ in found[1:]:
        page.keyboard.press("ArrowDown")
        seen.append(page.evaluate("urdfkit.page.selected"))
    assert len({str(each) for each in seen}) == len(found) > 3
    page.keyboard.press("ArrowDown")
    assert page.evaluate("urdfkit.page.selected") == seen[0]  # round
    page.keyboard.press("ArrowUp")
    assert page.evaluate("urdfkit.page.selected") == seen[-1]
    page.locator("#tree-search").fill("left")
    page.keyboard.press("Enter")
    assert page.evaluate("urdfkit.page.selected") == {"link": "left"}
    page.locator("#tree-search").fill("nothing")
    page.keyboard.press("Enter")
    assert page.evaluate("urdfkit.page.selected") == {"link": "left"}


def test_a_screenshot_and_a_turn_are_kept(page, keep) -> None:
    with page.expect_download() as download:
        page.get_by_role("button", name="Screenshot").first.click()
    assert download.value.suggested_filename == "lab.png"
    picture = Path(download.value.path()).read_bytes()
    assert picture[:8] == b"\x89PNG\r\n\x1a\n"
    width, height = struct.unpack(">II", picture[16:24])
    assert [width, height] == page.evaluate(
        "[2 * urdfkit.viewport.pane.clientWidth, 2 * urdfkit.viewport.pane.clientHeight]"
    )
    panel(page, "camera")
    page.get_by_label("One turn, or a timelapse, takes").fill("1")
    before = page.evaluate("urdfkit.viewport.viewer.camera.position.toArray()")
    with page.expect_download() as download:
        page.get_by_role("button", name="Record a turn").click()
    film = Path(download.value.path()).read_bytes()
    assert re.fullmatch(r"lab\.(webm|mp4)", download.value.suggested_filename)
    assert film[:4] == b"\x1aE\xdf\xa3" or film[4:8] == b"ftyp"  # Matroska or MP4
    assert len(film) > 10_000
    assert page.evaluate("urdfkit.viewport.viewer.camera.position.toArray()") == pytest.approx(before, abs=1e-6)
    # Films that end in their first frame, as on a computer that is too busy to draw, have a picture too: a cluster.
    for short in ("turntable(0.001)", "film(() => false)"):
        content = f"urdfkit.capture.{short}.then((blob) => blob.arrayBuffer()).then((all) => [...new Uint8Array(all)])"
        written = bytes(page.evaluate(content))
        assert b"\x1fC\xb6u" in written or b"moof" in written
        assert len(written) > 2000
    never = "MediaRecorder.prototype.start = () => {}; MediaRecorder.prototype.requestData = () => {}"
    assert "no frame" in page.evaluate(f"{{ {never} }}; urdfkit.capture.film(() => false, 100).catch((e) => e.message)")
    page.get_by_label("Custom size of screenshots").check()
    page.get_by_label("Width of screenshots").fill("400")
    page.get_by_label("Height of screenshots").fill("300")
    page.get_by_label("Transparent ground and sky").check()
    with page.expect_download() as download:
        page.get_by_role("button", name="Screenshot").last.click()
    with Image.open(download.value.path()) as shot:
        assert shot.size == (400, 300)
        alpha = np.asarray(shot)[..., 3]
    assert alpha[0, 0] == 0
    assert alpha.max() == 255
    keep(page, "turned")


def test_colours_and_keys(page, keep) -> None:
    theme = "document.documentElement.dataset.theme"
    assert page.evaluate(theme) == "light"
    page.get_by_role("button", name="Colours: system").click()
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
    assert page.evaluate("urdfkit.scene.shapes('upper', 'collision').map(({ visible }) => visible)") == [True]


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


def test_axe_finds_no_violation_in_any_panel(page, until) -> None:
    page.evaluate("urdfkit.page.select({ link: 'left' })")
    page.evaluate("urdfkit.page.tools.hold('ik')")
    until(lambda: page.locator("#ik-lost").inner_text().startswith("singular"))
    assert violations(page) == {"light": [], "dark": []}


def test_a_panel_can_be_kept_open_beside_others(page, keep, until) -> None:
    page.get_by_role("button", name="Keep Joints open").click()
    panel(page, "tree")
    assert page.locator("#panel-joints").is_visible()
    keep(page, "pinned")
    page.get_by_role("button", name="Keep Tree open").click()
    for name in ("findings", "show"):  # below those that are kept: it comes to where it can be seen
        panel(page, name)
        seen = f"""(() => {{ const [a, b] = ["#panel-{name}", "#panel"].map((s) =>
            document.querySelector(s).getBoundingClientRect());
            return Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) >= Math.min(a.height, 150) - 1; }})()"""
        until(lambda seen=seen: page.evaluate(seen))
        keep(page, f"pinned-{name}")
    page.get_by_role("button", name="Close Joints").click()
    assert page.locator("#panel-joints").is_hidden()
    assert page.evaluate("document.activeElement.id") == "open-joints"


def drag(page, start: tuple[float, float], end: tuple[float, float]) -> None:
    page.mouse.move(*start)
    page.mouse.down()
    page.mouse.move((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    page.mouse.move(*end)
    page.mouse.up()


def test_panels_are_docked_by_dragging_and_columns_are_split(page, keep, until) -> None:
    for name in ("joints", "tree", "show"):
        page.evaluate("(name) => urdfkit.page.panels.open(name)", name)
        page.get_by_role("button", name=f"Keep {page.locator(f'#title-{name}').inner_text()} open").click()

    def drop(name: str, x: float, y: float) -> None:
        title = page.locator(f"#title-{name}")
        title.scroll_into_view_if_needed()
        box = title.bounding_box()
        drag(page, (box["x"] + 20, box["y"] + 8), (x, y))

    places = "urdfkit.layout.state.panels.places"
    drop("tree", 10, 400)
    assert page.locator("#left #panel-tree").is_visible()
    drop("show", 100, 790)
    assert page.evaluate("[...document.querySelectorAll('#left .panel')].map(({ id }) => id)") == [
        "panel-tree",
        "panel-show",
    ]
    drop("tree", 100, 790)
    assert page.evaluate("[...document.querySelectorAll('#left .panel')].map(({ id }) => id)") == [
        "panel-show",
        "panel-tree",
    ]
    drop("joints", 600, 300)
    assert page.locator("#stage > #panel-joints.floating").is_visible()
    keep(page, "columns")
    for name, selector in (("joints", "#stage > #panel-joints.floating"), ("show", "#left #panel-show")):
        before, kept = (
            page.locator(selector).bounding_box(),
            page.evaluate("JSON.stringify(urdfkit.layout.state.panels)"),
        )
        title = page.locator(f"#title-{name}").bounding_box()
        page.mouse.move(title["x"] + 20, title["y"] + 8)
        page.mouse.down()
        page.mouse.move(700, 400, steps=3)
        assert page.locator("#dock-target").is_visible() == (name == "show")
        page.keyboard.press("Escape")
        page.mouse.move(600, 795)
        page.mouse.up()
        assert not page.locator("#dock-target").is_visible()
        assert page.locator(selector).bounding_box() == before
        assert page.evaluate("JSON.stringify(urdfkit.layout.state.panels)") == kept
    drop("joints", 600, 795)
    assert page.locator("#strip #panel-joints").is_visible()

    edge = page.get_by_role("separator", name="Height of Show")
    edge.press("ArrowUp")
    box, before = edge.bounding_box(), page.evaluate(f"{places}.show.size")
    drag(page, (box["x"] + 50, box["y"] + 3), (box["x"] + 50, box["y"] - 57))
    assert page.evaluate(f"{places}.show.size") == before - 60
    assert page.locator("#panel-show").bounding_box()["height"] == before - 60
    width = page.locator("#left").bounding_box()["width"]
    page.get_by_role("separator", name="Width of the panels at the left").press("ArrowRight")
    assert page.locator("#left").bounding_box()["width"] == pytest.approx(width + 16, abs=0.5)

    stored = "(text) => Object.values(localStorage).some((each) => each.includes(text))"
    panels = page.evaluate("JSON.stringify(urdfkit.layout.state.panels)")
    until(lambda: page.evaluate(stored, panels))
    page.reload()
    page.wait_for_selector("#left #panel-show:visible")
    assert page.evaluate("JSON.stringify(urdfkit.layout.state.panels)") == panels
    for name, x, y in (("Height of Show", 50, 3), ("Width of the panels at the left", 0, 50)):
        line = page.get_by_role("separator", name=name)
        before = line.bounding_box()
        page.mouse.move(before["x"] + x, before["y"] + y)
        page.mouse.down()
        page.mouse.move(before["x"] + x - 40, before["y"] + y - 40)
        assert line.bounding_box() != before
        page.keyboard.press("Escape")
        page.mouse.up()
        assert line.bounding_box() == before
        assert page.evaluate("JSON.stringify(urdfkit.layout.state.panels)") == panels
    page.get_by_role("separator", name="Height of Show").dblclick()
    assert page.evaluate(f"{places}.show.size ?? null") is None
    assert violations(page) == {"light": [], "dark": []}


def test_panels_are_docked_and_sized_by_touch(lab_served, visits) -> None:
    page = visits.open(lab_served.url, viewport={"width": 1024, "height": 768}, has_touch=True)
    panel(page, "tree")
    finger = page.context.new_cdp_session(page)

    def swipe(start: tuple[float, float], by: tuple[float, float], end: str = "touchEnd") -> None:
        points = [{"x": start[0] + k / 4 * by[0], "y": start[1] + k / 4 * by[1]} for k in range(5)]
        finger.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": points[:1]})
        for point in points[1:]:
            finger.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [point]})
        finger.send("Input.dispatchTouchEvent", {"type": end, "touchPoints": []})

    def middle(selector: str) -> tuple[float, float]:
        box = page.locator(selector).bounding_box()
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    start = middle("#title-tree")
    swipe(start, (10 - start[0], 300))
    assert page.locator("#left #panel-tree").is_visible()
    width, start = page.locator("#left").bounding_box()["width"], middle("[data-divides=left]")
    swipe(start, (60, 0), "touchCancel")
    assert page.evaluate("urdfkit.layout.state.panels.sizes") == {}
    swipe((start[0] + 8, start[1]), (60, 0))  # a finger is wider than the line
    assert page.locator("#left").bounding_box()["width"] == pytest.approx(width + 60, abs=0.5)


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_has_room_for_every_panel(lab_served, visits, keep, scheme: str) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True, "color_scheme": scheme}
    page = visits.open(lab_served.url, **phone)
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
