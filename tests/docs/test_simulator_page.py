"""The code on the simulator's page runs, block after block, and states what the page states."""

from __future__ import annotations

import re
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from urdfkit import Simulator

PAGE = Path(__file__).parents[2] / "docs" / "simulator.md"


def blocks(language: str = "python") -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)


@pytest.mark.slow
def test_every_block_runs(capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)  # one of them writes a file
    names: dict[str, Any] = {}
    assert len(blocks()) >= 8
    reported = ""
    for block in blocks():
        exec(compile(block, str(PAGE), "exec"), names)
        reported += capsys.readouterr().out
        if block == blocks()[0]:
            assert reported.endswith(blocks("text")[0])
    assert "did you mean `simpleton`?" in reported
    assert "one and a half seconds" in reported


def test_ten_lines_are_enough() -> None:
    assert len(blocks()[0].splitlines()) <= 10


def drive(turn: float) -> bytes:
    simulator = Simulator("mybot", world="house", note=lambda _: None)
    simulator.command((0.6, 0.0, 0.0), (0.0, 0.0, turn))
    simulator.run(3.0)
    return simulator.state.q.tobytes() + simulator.state.v.tobytes()


@pytest.mark.slow
def test_threads_give_the_same_bytes_as_one_after_the_other() -> None:
    turns = [-0.5, 0.0, 0.3, 0.7]
    one_by_one = [drive(turn) for turn in turns]
    assert len(set(one_by_one)) == len(turns)
    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(drive, turns)) == one_by_one


def test_the_kernel_lets_go_of_the_lock() -> None:
    """Where threads are never switched by force, another one runs during a call of the engine only if that lets it."""
    simulator = Simulator("simpleton", note=lambda _: None)
    simulator.command((0.5, 0, 0), (0, 0, 0.2))
    simulator.run(0.1)

    def runs_meanwhile() -> bool:
        begun, done = Event(), Event()

        def advance() -> None:
            begun.set()
            simulator.step(100_000)
            done.set()

        before = sys.getswitchinterval()
        sys.setswitchinterval(1000.0)
        try:
            thread = Thread(target=advance)
            thread.start()
            begun.wait()
            return not done.is_set()
        finally:
            sys.setswitchinterval(before)
            thread.join()
            assert done.is_set()

    assert any(runs_meanwhile() for _ in range(10))  # a busy machine may have no processor for it at once
