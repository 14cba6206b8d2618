"""Small models in a folder of their own, which is the working folder."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint.engine.run import Outcome, run

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'


@pytest.fixture
def tmp_path(tmp_path: Path) -> Path:
    """Return a folder alone in its parent: a package is linted with those next to it, which other tests have left."""
    alone = tmp_path / "own"
    alone.mkdir()
    return alone


def is_inside_word(text: str, offset: int) -> bool:
    return 0 < offset < len(text) and re.fullmatch(r"\w\w", text[offset - 1 : offset + 1]) is not None


@pytest.fixture(autouse=True)
def _findings_are_at_whole_words(monkeypatch: pytest.MonkeyPatch) -> None:
    """Fail a test with a finding that begins or ends inside of a word of the source; a single character is a point."""

    def checked(*arguments: Any, **options: Any) -> Outcome:
        outcome = run(*arguments, **options)
        for finding in outcome.findings:
            source, span = outcome.sources.get(finding.file), finding.span
            path = outcome.files.get(finding.file, Path(finding.file))
            if source is None and path.is_file():
                source = Source(finding.file, path.read_text("utf-8", errors="replace"))
            if source is not None:
                start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
                place = source.text[start:end]
                assert not is_inside_word(source.text, start), finding
                assert len(place) < 2 or not place[0].isspace(), (finding, place)
                assert len(place) == 1 or not is_inside_word(source.text, end), (finding, place)
        return outcome

    monkeypatch.setattr("urdfkit.lint.engine.run.run", checked)


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
