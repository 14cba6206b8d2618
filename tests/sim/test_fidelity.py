"""Our engine next to closed forms: the rows of docs/fidelity.md, without peers, and that the page has them all."""

from __future__ import annotations

import importlib
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs" / "fidelity.md"


def module(name: str) -> Any:
    """Return a module of tests/bench/fidelity."""
    folder = str(ROOT / "tests" / "bench")
    if folder not in sys.path:
        sys.path.append(folder)
    return importlib.import_module(f"fidelity.{name}")


ROWS = module("rows").ROWS
NAMES = [row.name for row in ROWS]


@pytest.mark.parametrize("row", ROWS, ids=NAMES)
def test_ours_is_as_near_the_closed_form_as_it_claims(row: Any) -> None:
    assert row.error(module("ours").runner(0.001)) <= row.bound


@pytest.mark.parametrize("row", [row for row in ROWS if row.coarse is not None], ids=lambda row: row.name)
def test_it_stays_near_with_steps_of_5_ms(row: Any) -> None:
    assert row.error(module("ours").runner(0.005)) <= row.coarse


CROWDED = [
    "box sliding diagonally",
    "solid cylinder rolling",
    "pendulum, 143°",
    "ball that slides",
    "lever held",
    "skid steer",
]


@pytest.mark.parametrize("row", [row for row in ROWS if row.name.startswith(tuple(CROWDED))], ids=lambda row: row.name)
def test_a_crate_far_away_changes_nothing(row: Any) -> None:
    # A world that holds bodies has a kernel of its own.
    crate = module("scene").Thing("crate", (0.2, 0.2, 0.2), (100.0, 0.0, 0.1), 1.0)
    run = module("ours").runner(0.001)
    assert row.error(lambda scene: run(replace(scene, things=(*scene.things, crate)))) <= row.bound


def test_rows_have_names_of_their_own() -> None:
    assert len(set(NAMES)) == len(NAMES)


def test_the_page_has_every_row_and_no_other() -> None:
    text = PAGE.read_text(encoding="utf-8")
    table = module("table")
    part = text.partition(table.BEGIN)[2].partition(table.END)[0]
    shown = [line.split(" | ")[0].removeprefix("| ") for line in part.splitlines() if line.startswith("| ")]
    assert [name for name in shown if name != "quantity"] == NAMES


def test_an_error_that_is_too_large_is_seen() -> None:
    row, table = ROWS[0], module("table")
    near = table.Result(row, 1e-3, 1e-3, {"MuJoCo": {"default": 2e-3, "RK4": 5e-4}, "Drake": {}})
    assert near.best_peer == ("MuJoCo", 5e-4)
    assert near.verdict == "**worse**"
    assert table.Result(row, 1e-4, 1e-3, {"MuJoCo": {"default": 2e-3}}).verdict == "better"
    assert table.Result(row, 1e-10, 1e-3, {"MuJoCo": {"default": 1e-14}}).verdict == "equal"
