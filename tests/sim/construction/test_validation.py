"""Sizes of collision shapes that a simulation cannot use."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.sim.construction.validation import sizes_not_positive


@pytest.mark.parametrize(
    ("shape", "found"),
    [
        ('<capsule radius="0.1" length="0"/>', []),  # a sphere
        ('<capsule radius="0.1" length="-1"/>', [("length", -1.0)]),
        ('<capsule radius="0" length="1"/>', [("radius", 0.0)]),
        ('<cylinder radius="0.1" length="0"/>', [("length", 0.0)]),
        ('<box size="1 0 -2"/>', [("size", 0.0), ("size", -2.0)]),
        ('<sphere radius="1"/>', []),
    ],
)
def test_sizes_that_are_not_positive(shape: str, found: list[tuple[str, float]], tmp_path: Path) -> None:
    path = tmp_path / "r.urdf"
    collision = f"<collision><geometry>{shape}</geometry></collision>"
    path.write_text(f'<robot name="r" version="1.1"><link name="a">{collision}</link></robot>')
    assert list(sizes_not_positive(load(path).links[0].collisions[0])) == found
