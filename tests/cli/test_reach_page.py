"""The page of `urdfkit reach`, in a real browser: slices, all cells, least score, and the frame of the base."""

from __future__ import annotations

import base64
import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")

from urdfkit.cli import main

pytestmark = pytest.mark.browser

ARM = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="fore"/><link name="tip"/><link name="hand"/>
  <link name="mast"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="mast"/><axis xyz="0 0 1"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
  <joint name="a" type="revolute"><parent link="mast"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="2" effort="1" velocity="1"/></joint>
  <joint name="b" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="c" type="revolute"><parent link="fore"/><child link="tip"/><origin xyz="0 0 0.4"/><axis xyz="1 0 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="d" type="fixed"><parent link="tip"/><child link="hand"/><origin xyz="0 0 0.3"/></joint>
</robot>"""
SHOWN = """() => { const { mesh } = urdfkit.reach, rows = [];
  for (let k = 0; k < mesh.count; k++) {
    const own = mesh.matrix.clone(), m = mesh.matrix.clone(); mesh.getMatrixAt(k, own); m.multiply(own);
    rows.push([m.elements[12], m.elements[13], m.elements[14]]);
  }
  return rows; }"""


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("reach")
    (folder / "arm.urdf").write_text(ARM)
    words = ["--base", "mast", "--position-only", "--resolution", "0.1", "-q"]
    words += ["--html", str(folder / "map.html"), "-o", str(folder / "map.json")]
    assert main(["reach", str(folder / "arm.urdf"), "hand", *words]) == 0
    return folder


def centres(values: dict) -> np.ndarray:
    place = np.argwhere(np.array(values["score"]) > 0)
    return np.array(values["origin"]) + values["resolution"] * (place + 0.5)


def same(found: list, expected: np.ndarray) -> bool:
    rows = np.array(found).reshape(-1, 3)
    return len(rows) == len(expected) and np.allclose(
        rows[np.lexsort(rows.round(4).T)], expected[np.lexsort(expected.round(4).T)], rtol=0, atol=1e-5
    )


def test_slices_and_all_cells_in_the_frame_of_the_base(visits, files: Path, until, keep) -> None:
    values = json.loads((files / "map.json").read_text())
    expected = centres(values)
    page = visits.open((files / "map.html").as_uri())
    across = expected[np.abs(expected[:, 1] - 0.05) < 1e-6]
    assert 0 < len(across) < len(expected)
    until(lambda: same(page.evaluate(SHOWN), across))
    assert page.locator("#reach-words").inner_text() == f"{len(across)} cells of 0.1 m shown"
    keep(page, "reach")
    page.get_by_label("y 0.05 m").fill("3")
    layer = values["origin"][1] + 0.35
    until(lambda: same(page.evaluate(SHOWN), expected[np.abs(expected[:, 1] - layer) < 1e-6]))
    page.get_by_label("Cells").select_option("all cells")
    until(lambda: same(page.evaluate(SHOWN), expected))
    # The cells follow the base link.
    page.evaluate("urdfkit.page.send('joints', { positions: { lift: 0.5 } })")
    until(lambda: same(page.evaluate(SHOWN), expected + np.array([0.0, 0.0, 0.5])))
    page.get_by_label("Cells").select_option("none")
    until(lambda: page.evaluate(SHOWN) == [])
    assert visits.problems == []


def test_the_served_page_has_the_map(visits, serve, files: Path, until) -> None:
    served = serve("reach", str(files / "arm.urdf"), "hand", "--position-only", "--resolution", "0.1", "--view")
    page = visits.open(served.url)
    until(lambda: page.evaluate("urdfkit.reach.map?.tip") == "hand")
    assert page.evaluate("urdfkit.reach.map.base") == "base"
    assert page.locator("#panel-reach").is_visible()
    assert served.end() == 0


def test_the_scores_of_the_page_are_those_of_the_map(files: Path) -> None:
    text = (files / "map.html").read_text()
    recording = json.loads(text.partition('id="recording">')[2].partition("</script>")[0])
    (message,) = [each for each in map(json.loads, recording["texts"]) if each["type"] == "reach"]
    values = json.loads((files / "map.json").read_text())
    scores = np.frombuffer(base64.b64decode(message["scores"]), dtype=np.uint8).reshape(message["shape"])
    np.testing.assert_array_equal(scores, np.round(255 * np.array(values["score"])))
    assert (message["origin"], message["resolution"]) == (values["origin"], values["resolution"])
