"""The scenes with many contacts end as they must in our engine, and their checks can fail."""

from __future__ import annotations

from dataclasses import replace

import pytest

from tests.bench.contact_rich import models
from tests.bench.contact_rich.command import measure
from tests.bench.contact_rich.scenes import cases
from tests.bench.peers.engine_scene import InUrdfkit
from tests.bench.peers.parsed_urdf import read

BY_NAME = {case.scene.name: case for case in cases()}


def test_names_are_unique() -> None:
    assert len(BY_NAME) == len(cases())


@pytest.mark.parametrize("joints", [25, 42])
def test_a_humanoid_has_as_many_joints_as_its_name_states(joints: int) -> None:
    assert len(read(models.humanoid(joints)).joints) == joints


@pytest.mark.parametrize(
    "name", ["quadruped-standing", "quadruped-trotting", "humanoid25-standing", "gripper", "sweep"]
)
def test_a_scene_ends_as_it_must(name: str) -> None:
    case = BY_NAME[name]
    assert measure(InUrdfkit(case.scene, sleep=case.sleep), case).right


def test_a_quadruped_without_servos_is_found_out() -> None:
    case = BY_NAME["quadruped-standing"]
    limp = replace(case.scene.things[0], servos={})
    case = replace(case, scene=replace(case.scene, things=(limp,)))
    assert not measure(InUrdfkit(case.scene), case).right
