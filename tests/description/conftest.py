from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'

Write = Callable[[str, str], Path]


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Write:
    """Write a file into the working folder; `HEAD` stands for the start tag of a xacro robot."""
    monkeypatch.chdir(tmp_path)

    def writer(name: str, text: str) -> Path:
        path = Path(name)
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(text.replace("HEAD", HEAD).encode())
        return path

    return writer
