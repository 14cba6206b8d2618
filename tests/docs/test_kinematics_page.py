"""The Python file of docs/kinematics.md prints what the page shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.docs.course import agrees, run

pytest.importorskip("pinocchio")

PAGE = Path(__file__).parents[2] / "docs" / "kinematics.md"


def test_the_efforts_against_gravity_are_those_of_the_page(tmp_path: Path) -> None:
    _, heading, rest = PAGE.read_text("utf-8").partition("## Efforts against gravity\n")
    section = heading + rest.partition("\n## ")[0] + "\n"
    (step,) = run(section, tmp_path.resolve())
    assert step.shown.strip()
    assert agrees(step.shown, step.printed), step.printed
