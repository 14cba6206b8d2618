"""The code on the library's page runs as written, and prints the output that the page shows."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import urdfkit

pytest.importorskip("numba")
matplotlib = pytest.importorskip("matplotlib")

PAGE = Path(__file__).parents[2] / "docs" / "library.md"

pytestmark = pytest.mark.slow


def blocks(kind: str) -> list[str]:
    return re.findall(rf"^```{kind}\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


def test_every_block_runs_and_prints_what_the_page_shows(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    matplotlib.use("agg")
    names: dict[str, Any] = {}
    printed = []
    for block in blocks("python"):
        exec(compile(block, str(PAGE), "exec"), names)
        printed.append(capsys.readouterr().out)
    shown = blocks("text")
    assert printed[0] == shown[0]
    assert printed[2] == shown[1]
    assert printed[3].endswith("<PageHandle closed>\n")
    xs, ys = names["plt"].gca().lines[0].get_data()
    assert len(xs) > 100
    assert np.hypot(np.diff(xs), np.diff(ys)).sum() > 4.0  # 0.5 m/s for 10 s, less the acceleration
    # the last message is 1/100 s old at most, and the robot moves at 0.5 m/s
    assert names["simulator"].state.base_pose[:2] == pytest.approx([xs[-1], ys[-1]], abs=0.01)
    assert len(blocks("python")[0].splitlines()) <= 17


def test_the_page_lists_every_public_name() -> None:
    table = PAGE.read_text(encoding="utf-8").partition("## Public names")[2].partition("\n## ")[0]
    listed = set(re.findall(r"`(\w+)[(`]", table))
    assert set(urdfkit.__all__) - {"__version__"} <= listed
