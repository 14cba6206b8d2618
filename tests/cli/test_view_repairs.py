"""A defective robot in the viewer: the rest of it is shown, with placeholders and a badge for each fault."""

from __future__ import annotations

from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.cli import main

ROBOT = """<robot name="broken">
  <link name="base"><visual><geometry><box size="0.4 0.3 0.1"/></geometry></visual></link>
  <link name="arm">
    <visual><geometry><mesh filename="package://gone_description/arm.stl"/></geometry></visual>
    <collision><origin xyz="0 0 0.3"/><geometry><box size="0.1 0.1 0.5"/></geometry></collision>
  </link>
  <link name="stray"><visual><origin xyz="0 0.5 0"/><geometry><sphere radius="0.05"/></geometry></visual></link>
  <joint name="turn" type="revolute"><parent link="base"/><child link="arm"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("broken") / "broken.urdf"
    path.write_text(ROBOT)
    return path


def test_repairs_are_warnings_with_their_place(robot: Path, tmp_path: Path, capfd) -> None:
    page = tmp_path / "page.html"
    assert main(["view", str(robot), "--html", str(page)]) == 0
    *warnings, last = capfd.readouterr().err.splitlines()
    places = [line.removeprefix("urdfkit: warning: ").split(": ")[0] for line in warnings]
    assert places == [f"{robot}:7:9", f"{robot}:4:29"]
    assert "2 root links" in warnings[0]
    assert warnings[1].endswith("a placeholder is shown")
    assert last.startswith("wrote ")
    assert main(["view", str(robot), "--html", str(page), "--quiet"]) == 0
    assert capfd.readouterr().err.splitlines() == warnings


def test_strict_refuses(robot: Path, tmp_path: Path, capfd) -> None:
    page = tmp_path / "page.html"
    assert main(["view", str(robot), "--strict", "--html", str(page)]) == 2
    assert f"{robot}:7:3: 2 root links" in capfd.readouterr().err
    one = tmp_path / "one.urdf"
    one.write_text("\n".join(line for line in ROBOT.splitlines() if "stray" not in line))
    assert main(["view", str(one), "--strict", "--html", str(page)]) == 2
    assert f"{one}:4:23: no package `gone_description`" in capfd.readouterr().err
    assert not page.exists()


@pytest.mark.browser
def test_a_placeholder_is_hatched_and_its_link_has_a_badge(visits, robot: Path, tmp_path: Path, keep) -> None:
    html = tmp_path / "page.html"
    assert main(["view", str(robot), "--html", str(html)]) == 0
    page = visits.open(html.as_uri())
    size, hatched = page.evaluate(
        """() => {
          const boxes = [];
          urdfkit.scene.shapes("arm", "visual")[0].traverse((object) => object.isMesh && boxes.push(object));
          const { width, height, depth } = boxes[0].geometry.parameters;
          return [[width, height, depth], boxes[0].material.map.isTexture];
        }"""
    )
    assert size == pytest.approx([0.1, 0.1, 0.5])
    assert hatched
    shown = page.evaluate("() => [...urdfkit.scene.byLink.keys()]")
    assert shown == ["base", "arm", "stray"]
    colors = page.evaluate(
        """() => {
          const { renderer, scene, camera } = urdfkit.page.viewport.viewer;
          renderer.render(scene, camera);
          const gl = renderer.getContext();
          const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
          const pixels = new Uint8Array(4 * w * h);
          gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
          let stripes = 0;
          for (let i = 0; i < pixels.length; i += 4) stripes += pixels[i] > 1.5 * pixels[i + 2] && pixels[i] > 60;
          return stripes;
        }"""
    )
    assert colors > 500  # no other part of the page is orange
    page.locator('.badge[data-link="arm"]').click()
    card = page.locator(".finding", has_text="G602")
    assert "a placeholder is shown" in card.inner_text()
    page.locator('.badge[data-link="stray"]').click()
    assert "is fixed to the origin of base" in page.locator(".finding", has_text="T203").inner_text()
    keep(page, "placeholder")
    assert visits.problems == []
