"""Clean robots with one defect each: found at its line. ``python tests/bench/mutants.py`` does five hundred."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path

import pytest

BENCH = Path(__file__).parents[1] / "bench" / "mutants.py"


@pytest.fixture(scope="module")
def bench():
    found = importlib.util.spec_from_file_location("mutants", BENCH)
    assert found is not None
    assert found.loader is not None
    module = importlib.util.module_from_spec(found)
    sys.modules["mutants"] = module
    found.loader.exec_module(module)
    yield module
    del sys.modules["mutants"]


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["simpleton", "rrbot"])
def test_a_defect_of_each_kind_is_found_at_its_line(bench, robot, monkeypatch):
    monkeypatch.chdir(BENCH.parents[2])
    every = bench.mutants(robot)
    kinds = len({mutant.code for mutant in every})
    chosen = bench.sample((robot,), kinds, 1)
    assert len(chosen) == kinds > 30
    missed = [(mutant, codes) for mutant in chosen for found, codes in [bench.is_found(mutant)] if not found]
    assert not missed


def test_a_mutant_counts_only_at_its_line(bench, monkeypatch):
    monkeypatch.chdir(BENCH.parents[2])
    mutant = next(m for m in bench.mutants("simpleton") if m.code == "T202")
    end = len(Path(mutant.file).read_text())
    elsewhere = bench.Mutant("T202", "simpleton", mutant.file, end, end, "\n")
    assert bench.is_found(mutant)[0]
    assert not bench.is_found(elsewhere)[0]
