"""How the page keeps moving scenes quick where the processor draws."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

pytestmark = [pytest.mark.browser, pytest.mark.slow]

LEVELS = """() => {
  const { viewport } = urdfkit, { viewer, budget } = viewport, { renderer } = viewer, gl = renderer.getContext();
  viewer.render(); // a smooth frame before it had more pixels
  const { drawingBufferWidth: width, drawingBufferHeight: height } = gl;
  const pixels = new Uint8Array(4 * width * height);
  budget.motion = () => {}; // only this test decides what moves
  viewport.ground.visible = false;
  const draw = (level) => {
    budget.held = level > 0;
    budget.level = level;
    viewport.dirty();
    viewer.render();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  };
  const times = [[], []];
  for (let i = 0; i < 18; i++) {
    const start = performance.now();
    draw(i % 2);
    if (i > 3) times[i % 2].push(performance.now() - start);
  }
  const median = (list) => list.sort((a, b) => a - b)[Math.floor(list.length / 2)];
  const triangles = () => renderer.info.render.triangles;
  budget.constructor.LEVELS.forEach((level) => (level.pixels = 1));
  draw(0);
  const full = pixels.slice(), fine = triangles();
  const difference = () => {
    let sum = 0, surface = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if ([0, 1, 2].every((k) => full[i + k] === full[k])) continue; // sky
      surface += 1;
      for (let k = 0; k < 3; k++) sum += Math.abs(full[i + k] - pixels[i + k]) / 3 / 255;
    }
    return [sum / surface, surface / (width * height)];
  };
  draw(1);
  const [quick, surface] = difference();
  draw(budget.constructor.LEVELS.length - 1);
  const [coarse] = difference(), left = triangles() / fine;
  draw(0);
  return { cost: median(times[1]) / median(times[0]), quick, coarse, left, surface, again: difference()[0] };
}"""


def test_moving_surfaces_take_little_time_and_keep_their_colours(serve, visits, keep, tmp_path: Path) -> None:
    trimesh.creation.torus(0.12, 0.05, 80, 80).export(tmp_path / "ring.stl")
    text = []
    for k in range(8):
        mesh = '<geometry><mesh filename="ring.stl"/></geometry>'
        color = f'<material name="m{k}"><color rgba="{k / 7} {1 - k / 7} {0.5 * (k % 3)} 1"/></material>'
        text.append(f'<link name="l{k}"><visual>{mesh}{color}</visual></link>')
        if k:
            ends = f'<parent link="l{k - 1}"/><child link="l{k}"/><origin xyz="0 0.05 0.15" rpy="0.3 0.2 0"/>'
            text.append(f'<joint name="j{k}" type="fixed">{ends}</joint>')
    (tmp_path / "rings.urdf").write_text(f'<robot name="rings">{"".join(text)}</robot>')  # 102,400 triangles
    page = visits.open(serve("view", str(tmp_path / "rings.urdf")).url)
    page.evaluate("urdfkit.scene.settled()")
    found = page.evaluate(LEVELS)
    keep(page, "moving")
    assert found["surface"] > 0.05, found
    assert found["cost"] < 0.6, found
    assert 0.0 < found["quick"] < 0.05, found
    assert 0.0 < found["coarse"] < 0.06, found
    assert found["left"] < 0.4, found
    assert found["again"] == 0.0, found
    assert visits.problems == []


def test_a_still_view_has_smooth_edges(lab_served, visits, until) -> None:
    page = visits.open(lab_served.url, device_scale_factor=1)
    pixels = "document.querySelector('#pane canvas').width / document.getElementById('pane').clientWidth"
    until(lambda: page.evaluate(pixels) == 2)
    page.evaluate("urdfkit.viewport.budget.hold(true); urdfkit.viewport.dirty()")  # the camera moves
    until(lambda: page.evaluate(pixels) <= 1)
    page.evaluate("urdfkit.viewport.budget.hold(false); urdfkit.viewport.draw(300, 200)")
    assert page.evaluate("document.querySelector('#pane canvas').width") == 300
    page.evaluate("urdfkit.viewport.resize()")
    until(lambda: page.evaluate(pixels) == 2)
    assert visits.problems == []


def test_a_million_triangles_are_simplified_and_moved_quickly(serve, visits, until, tmp_path: Path) -> None:
    torus = trimesh.creation.torus(0.3, 0.1, 710, 710)
    torus.export(tmp_path / "torus.stl")
    link = '<link name="ring"><visual><geometry><mesh filename="torus.stl"/></geometry></visual></link>'
    (tmp_path / "ring.urdf").write_text(f'<robot name="ring">{link}</robot>')
    page = visits.open(serve("view", str(tmp_path / "ring.urdf")).url)
    page.evaluate("urdfkit.scene.settled()")
    until(lambda: "of 1,008,200 triangles" in (page.locator("#simplified").text_content() or ""))
    shown = page.evaluate("urdfkit.scene.shapes('ring', 'visual')[0].children[0].children[0].geometry.index.count / 3")
    assert 300_000 < shown < 700_000
    # Half a million triangles take a processor longer than the budget of a frame.
    middle = page.locator("#pane").bounding_box()
    page.mouse.move(middle["x"] + 300, middle["y"] + 300)
    page.mouse.down()
    used = "[urdfkit.viewport.budget.used, urdfkit.viewport.sunShadow.sun.castShadow]"

    def drag() -> bool:
        page.mouse.move(middle["x"] + 300 + len(seen), middle["y"] + 300)
        seen.append(page.evaluate(used))
        return seen[-1][0] > 0

    seen: list[list[object]] = []
    until(drag)
    assert seen[-1][1] is False
    page.mouse.up()
    until(lambda: page.evaluate(used) == [0, True])  # at rest, everything is drawn again
