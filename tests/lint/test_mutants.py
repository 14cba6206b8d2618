"""Clean robots with one defect each: found at its line. ``python tests/bench/mutants.py`` does five hundred."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.bench import mutants as bench

ROOT = Path(__file__).parents[2]


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["simpleton", "rrbot"])
def test_a_defect_of_each_kind_is_found_at_its_line(robot, monkeypatch):
    monkeypatch.chdir(ROOT)
    every = bench.mutants(robot)
    kinds = len({mutant.code for mutant in every})
    chosen = bench.sample((robot,), kinds, 1)
    assert len(chosen) == kinds > 30
    missed = [(mutant, codes) for mutant in chosen for found, codes in [bench.is_found(mutant)] if not found]
    assert not missed


def test_a_mutant_counts_only_at_its_line(monkeypatch):
    monkeypatch.chdir(ROOT)
    mutant = next(m for m in bench.mutants("simpleton") if m.code == "T202")
    end = len(Path(mutant.file).read_text())
    elsewhere = bench.Mutant("T202", "simpleton", mutant.file, end, end, "\n")
    assert bench.is_found(mutant)[0]
    assert not bench.is_found(elsewhere)[0]
