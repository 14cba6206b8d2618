"""The code on the page of exports runs as written, and prints the output that the page shows."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

PAGE = Path(__file__).parents[2] / "docs" / "exports.md"

pytestmark = pytest.mark.slow


def blocks(kind: str) -> list[str]:
    return re.findall(rf"^```{kind}\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.fixture
def _restored() -> Any:
    pytest.importorskip("numba")
    pytest.importorskip("yourdfpy")
    torch: Any = pytest.importorskip("torch")  # here, because each collection of tests would import it
    before = torch.get_default_dtype()
    yield
    torch.set_default_dtype(before)


@pytest.mark.usefixtures("_restored")
@pytest.mark.parametrize("k", range(len(blocks("python"))))
def test_a_block_prints_what_the_page_shows(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path, k: int
) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(blocks("python")[k], str(PAGE), "exec"), {})
    assert capsys.readouterr().out == blocks("text")[k]
