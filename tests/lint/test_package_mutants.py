"""Whole packages with one mistake each. ``python tests/bench/package_mutants`` does six hundred."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import pytest

from tests.bench.package_mutants import __main__ as command
from tests.bench.package_mutants import bases, judging
from tests.bench.package_mutants.mutant import KINDS, Mutant, Workspace


@pytest.fixture(scope="module")
def workspaces(tmp_path_factory):
    made = []
    for name in bases.WRITTEN:
        folder = tmp_path_factory.mktemp(name)
        bases.write(name, folder)
        made.append(Workspace(name, folder))
    return made


@pytest.fixture(autouse=True)
def _here():
    folder = Path.cwd()
    yield
    os.chdir(folder)


def test_the_workspaces_have_no_defect(workspaces):
    for workspace in workspaces:
        assert judging.lint(workspace.folder) == []


def test_mutants_are_the_same_for_the_same_seed(workspaces):
    for area, name in (("SRDF", "group-of-unknown-joint"), ("launch", "executable-misspelt"), ("YAML", "tab")):
        once, again, other = (list(command.candidates(workspaces, area, name, seed)) for seed in (1, 1, 2))
        assert once == again != other


def test_each_area_has_many_kinds():
    assert {area: len(kinds) >= 15 for area, kinds in KINDS.items()} == dict.fromkeys(command.SHARES, True)


def test_a_mutant_counts_at_its_line_and_nowhere_else(workspaces):
    workspace = next(each for each in workspaces if each.base == "ros1_arm")
    mutant = next(command.candidates([workspace], "model", "limits-swapped", 1))
    verdict = judging.judge(mutant, workspace.folder)
    assert verdict.found
    assert verdict.at_line
    assert not verdict.others
    end = len(workspace.files[mutant.file])
    elsewhere = replace(mutant, also=(end, end), around=(end, end))
    places = judging.Places(elsewhere, workspace.folder, workspace.folder)
    places.exact = places.exact[1:]
    assert not any(places.at_line(report) or places.names_it(report) for report in verdict.found)


def test_a_mutant_without_effect_is_left_out(workspaces):
    workspace = workspaces[0]
    file = "titan_moveit_config/config/kinematics.yaml"
    same = Mutant(file, 0, 0, "# a comment\n", area="YAML", base=workspace.base)
    assert not judging.judge(same, workspace.folder).effective
    assert judging.judge(replace(same, text="other: 1\n"), workspace.folder).effective
