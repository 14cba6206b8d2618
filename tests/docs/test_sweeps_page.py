"""The code on the page about sweeps runs as written, and prints the output that the page shows."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("distributed")
PAGE = Path(__file__).parents[2] / "docs" / "sweeps.md"


@pytest.mark.slow
def test_the_script_prints_what_the_page_shows(tmp_path: Path) -> None:
    text = PAGE.read_text("utf-8")
    [(code, printed)] = re.findall(r"^```python\n(.*?)^```\n+It prints:\n+```text\n(.*?)^```", text, re.M | re.S)
    (tmp_path / "script.py").write_text(code)
    done = subprocess.run([sys.executable, "script.py"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.stdout == printed, done.stderr
