"""Findings that depend on the version of URDF and on the release of the target."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description.urdf.parser import parse
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.lint import lint

ROBOT = (
    '<robot name="r" version="{version}"><link name="a"/><link name="b"/><joint name="j" type="revolute">'
    '<parent link="a"/><child link="b"/>{origin}<axis xyz="0 0 1"/><limit {limit}/></joint></robot>'
)
LIMIT = 'lower="-1" upper="1" effort="1" velocity="1"'


def _found(folder: Path, version: str, *, origin: str = "", limit: str = LIMIT, target: str | None = None) -> set[str]:
    (folder / "r.urdf").write_text(ROBOT.format(version=version, origin=origin, limit=limit))
    return {f"{finding.code} {finding.severity}" for finding in lint(folder / "r.urdf", target=target)}


@pytest.mark.parametrize("version", ["1.1", "1.2"])
@pytest.mark.parametrize(
    ("target", "found"),
    [
        ("ros1", {"E022 error"}),
        ("ros1-noetic", {"E022 error"}),
        ("ros2-humble", {"E022 error"}),
        ("ros2-jazzy", {"E022 error"}),
        ("ros2-kilted", {"E022 error"}),
        ("ros2-lyrical", set()),
        ("ros2-rolling", set()),
        ("ros2", {"E022 note"}),
        ("classic", {"E022 error", "I511 error"}),  # The moving link has no mass.
        ("mujoco", {"I511 error"}),
        (None, set()),
    ],
)
def test_releases_that_do_not_read_a_version(tmp_path: Path, version: str, target: str | None, found: set[str]) -> None:
    assert _found(tmp_path, version, target=target) == found
    assert _found(tmp_path, "1.0", target=target) == found - {"E022 error", "E022 note"}


@pytest.mark.parametrize(
    ("limit", "old", "new"),
    [
        ('lower="-1" upper="1"', {"J404 error"}, set()),
        ('effort="1" velocity="1"', {"J406 warning"}, {"E014 error"}),
        ('lower="-1" effort="1" velocity="1"', set(), {"E014 error"}),
        (f'{LIMIT} acceleration="-1"', {"E021 note"}, {"J410 error"}),
        (f'{LIMIT} acceleration="2" deceleration="1" jerk="-1"', {"E021 note"}, {"J410 error"}),
        (f'{LIMIT} jerk="x"', {"E021 note"}, {"E010 error"}),
    ],
)
def test_limits_of_each_version(tmp_path: Path, limit: str, old: set[str], new: set[str]) -> None:
    assert _found(tmp_path, "1.1", limit=limit) == old
    assert _found(tmp_path, "1.2", limit=limit) == new


@pytest.mark.parametrize(
    ("origin", "found"),
    [
        ('<origin quat_xyzw="0 0 1"/>', {"E011 error"}),
        ('<origin quat_xyzw="0, 0, 0, 1"/>', {"E010 error"}),
        ('<origin quat_xyzw="0 0 0 nan"/>', {"E012 error"}),
        ('<origin quat_xyzw="0 0 0 1" rpy="0 0 x"/>', {"E010 error", "E023 error"}),
        ('<origin quat_xyzw="0 0 1e300 1e300"/>', {"E012 error"}),
    ],
)
def test_defective_quaternions(tmp_path: Path, origin: str, found: set[str]) -> None:
    assert _found(tmp_path, "1.1", origin=origin) == found
    assert _found(tmp_path, "1.0", origin=origin) - {"E010 error"} == {"E021 error"}


def test_a_change_of_the_version_reads_all_parts_again() -> None:
    text = ROBOT.format(version="1.0", origin='<origin quat_xyzw="0 0 0.6 0.8"/>', limit=LIMIT)
    root = document_of(Source("r.urdf", text))
    parts: dict = {}
    assert parse(root, cached_parts=parts).joints[0].origin.rpy == (0.0, 0.0, 0.0)
    root.attributes["version"] = "1.1"
    assert parse(root, cached_parts=parts).joints[0].origin.rpy != (0.0, 0.0, 0.0)
