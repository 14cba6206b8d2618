"""Threads with which a driver draws on the processor."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from urdfkit.scene.gl import drawing_threads
from urdfkit.scene.gl.drawing_threads import COUNT, NICENESS, leave_a_core, lower_priority


@pytest.mark.parametrize(("cores", "threads"), [(8, "7"), (2, "1"), (1, "1"), (None, "1")])
def test_one_core_is_left_to_the_simulation(cores: int | None, threads: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(COUNT, "")
    monkeypatch.delenv(COUNT)
    monkeypatch.setattr(os, "cpu_count", lambda: cores)
    leave_a_core()
    assert os.environ[COUNT] == threads


def test_the_number_of_the_user_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(COUNT, "3")
    leave_a_core()
    assert os.environ[COUNT] == "3"


def test_only_drawing_threads_get_a_lower_priority(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for number, name in (("11", "python"), ("12", "llvmpipe-0"), ("13", "llvmpipe-1")):
        (tmp_path / number).mkdir()
        (tmp_path / number / "comm").write_text(f"{name}\n")
    (tmp_path / "14").mkdir()  # a thread that has ended
    lowered = list[tuple[int, int, int]]()
    monkeypatch.setattr(drawing_threads.os, "setpriority", lambda *values: lowered.append(values))
    lower_priority(tmp_path)
    assert sorted(lowered) == [(os.PRIO_PROCESS, 12, NICENESS), (os.PRIO_PROCESS, 13, NICENESS)]
    lower_priority(tmp_path / "missing")
