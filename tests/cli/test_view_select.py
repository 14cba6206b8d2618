"""Selecting, the tree, the inspector and what is shown of a robot, in a real browser."""

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from tests.cli.lab import ROBOT, at, drawn, panel

pytestmark = pytest.mark.browser


@pytest.fixture
def page(lab_page):
    return lab_page


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
    page.get_by_role("button", name="Centre the view").click()
    target = page.evaluate("urdfkit.viewport.viewer.controls.target.toArray()")
    assert target == pytest.approx([0, 0.25, 0], abs=1e-6)  # three.js has y up
    keep(page, "selected")
    page.mouse.click(150, 760)  # next to it
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
    page.get_by_role("button", name="Collapse upper").click()
    assert page.locator(".tree .link-entry:visible").all_inner_texts() == ["base", "upper", "eye"]


def test_the_inspector_shows_values_and_their_source_lines(page, lab: Path, keep) -> None:
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


def test_marks_names_wires_and_opacity(page, keep, until) -> None:
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
    until(lambda: page.evaluate("document.querySelectorAll('.name-label:not([hidden])').length") == 7)
    lying = """() => { const shown = [...document.querySelectorAll(".name-label:not([hidden], [data-covered])")];
        const boxes = shown.map((label) => label.getBoundingClientRect());
        return [shown.length, boxes.some((a, i) => boxes.some((b, k) =>
          i < k && a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom))]; }"""
    for zoom in ("", "-" * 12):
        page.locator("#pane").press("-") if zoom else None
        for key in zoom:
            page.locator("#pane").press(key)
        drawn(page)
        count, overlapping = page.evaluate(lying)
        assert count >= 1
        assert not overlapping
    assert count < 7  # from far away the names of what is behind are ignored …
    keep(page, "names-far")
    page.evaluate("urdfkit.page.select({ link: 'hand' })")
    until(
        lambda: not page.evaluate("document.querySelector('.name-label[data-name=hand]').hasAttribute('data-covered')")
    )
    page.evaluate("urdfkit.page.select(null)")  # … but not of what is selected
    page.keyboard.press("f")
    page.get_by_label("Marker size").fill("1.5")
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


BADGES = """(tones) => {
  const { labels, viewport } = urdfkit.page, { camera } = viewport.viewer;
  for (const [i, tone] of tones.entries()) {
    const badge = Object.assign(document.createElement("button"), { className: "badge", innerHTML: "<span>1</span>" });
    Object.assign(badge.dataset, { tone, count: 1, words: tone });
    const at = new MeshCat.THREE.Vector3(0, 0, 0).project(camera);
    at.x += (2 * 20 * i) / viewport.pane.clientWidth; // 20 px beside the one before
    const point = at.unproject(camera);
    labels.add(badge, () => point);
  }
  labels.place();
  const shown = [...document.querySelectorAll(".badge:not([data-covered])")];
  return shown.map(({ title, innerText, firstChild }) => [title, innerText, firstChild.dataset.tone]);
}"""


def test_badges_that_overlap_are_one_with_the_worst_tone(lab_page) -> None:
    lab_page.evaluate("for (const each of [...urdfkit.page.labels.kept.keys()]) urdfkit.page.labels.remove(each)")
    shown = lab_page.evaluate(BADGES, ["note", "error", "warning"])
    assert len(shown) == 2  # 40 px apart, with the middle one in one of them
    assert sorted(int(count) for _, count, _ in shown) == [1, 2]
    assert {tone for words, _, tone in shown if "error" in words} == {"error"}
