"""Small models in a folder of their own, which is the working folder."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'


@pytest.fixture
def tmp_path(tmp_path: Path) -> Path:
    """Return a folder alone in its parent: a package is linted with those next to it, which other tests have left."""
    alone = tmp_path / "own"
    alone.mkdir()
    return alone


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Path]:
    """Write a file below the working folder; ``<robot …>`` is put around text that has none."""
    monkeypatch.chdir(tmp_path)

    def write(name: str, text: str | bytes) -> Path:
        path = Path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(text, str):
            text = (
                text if "<robot" in text or name.endswith("package.xml") else f"{HEAD}\n{text}\n</robot>\n"
            ).encode()
        path.write_bytes(text)
        return path

    return write
