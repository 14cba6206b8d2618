"""The page of `urdfkit srdf`, in a real browser: the matrix, and the configuration of each collision."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")
pytest.importorskip("coal")

from urdfkit.cli import main

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, dict]:
    folder = tmp_path_factory.mktemp("srdf")
    words = ["seven_dof_arm", "--samples", "300", "--html", str(folder / "pairs.html"), "--json", "-q"]
    with pytest.MonkeyPatch.context() as patch:
        printed: list[str] = []
        patch.setattr("builtins.print", lambda text, **_: printed.append(text))
        assert main(["srdf", *words]) == 0
    return folder, json.loads(printed[0])


def test_each_pair_shows_its_collision(visits, files: tuple[Path, dict], until, keep) -> None:
    folder, values = files
    page = visits.open((folder / "pairs.html").as_uri())
    page.locator("#panel-collisions").wait_for()
    colliding = [pair for pair in values["pairs"] if pair["reason"] is None]
    names = page.locator("#collision-pairs button").all_inner_texts()
    assert sorted(names) == sorted(" – ".join(pair["links"]) for pair in colliding)
    pair = colliding[0]
    page.get_by_role("button", name=" – ".join(pair["links"])).click()
    until(lambda: all(abs(page.evaluate("urdfkit.page.values")[k] - v) < 1e-9 for k, v in pair["collision"].items()))
    words = page.locator("#collision-words").inner_text()
    assert f"{pair['hits']} of {pair['samples']} samples collide" in words
    names = page.locator(".name-label").evaluate_all("labels => labels.map((label) => label.dataset.name)")
    assert set(pair["links"]) <= set(names)
    keep(page, "pair")
    # A cell of the matrix is the pair of its row and its column.
    never = next(pair for pair in values["pairs"] if pair["reason"] == "Never")
    count = len(values["links"])
    box = page.locator("#collision-matrix").bounding_box()
    row, column = (values["links"].index(link) for link in never["links"])
    edge = box["width"] / count
    page.mouse.click(box["x"] + edge * (column + 0.5), box["y"] + edge * (row + 0.5))
    until(lambda: page.evaluate("urdfkit.collisions.chosen?.links") == never["links"])
    assert f"closest approach {round(never['distance'], 4):g} m" in page.locator("#collision-words").inner_text()
    page.locator("#collision-reasons").select_option("Never")
    assert page.locator("#collision-pairs button").count() == sum(p["reason"] == "Never" for p in values["pairs"])
    assert visits.problems == []


def test_the_served_page_has_the_pairs(visits, serve, until) -> None:
    served = serve("srdf", "seven_dof_arm", "--samples", "50", "--view")
    page = visits.open(served.url)
    until(lambda: page.evaluate("urdfkit.collisions.matrix?.pairs.length") == 55)
    assert served.end() == 0
