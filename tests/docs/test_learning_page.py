"""The code on the page about batches and environments runs as written, and prints the output that the page shows."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("gymnasium")

PAGE = Path(__file__).parents[2] / "docs" / "learning.md"


@pytest.mark.slow
def test_every_block_runs_and_prints_what_the_page_shows(capsys: pytest.CaptureFixture[str]) -> None:
    text = PAGE.read_text("utf-8")
    pairs = re.findall(r"^```python\n(.*?)^```\n+It prints:\n+```text\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    assert len(pairs) == text.count("```python") == 2
    for code, printed in pairs:
        names: dict[str, Any] = {}
        exec(compile(code, str(PAGE), "exec"), names)
        assert capsys.readouterr().out == printed
