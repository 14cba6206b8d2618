"""Compiled functions in numba's cache."""

from __future__ import annotations

import os
import subprocess
import sys
from contextlib import nullcontext
from pathlib import Path

import numba
import numpy as np
import pytest

import urdfkit
from urdfkit.compilation import load, whole_program
from urdfkit.compilation.instruction_set import level

SCRIPT = """
import numba, numpy as np
from numba.core import event
from urdfkit.compilation import compile_or_load
from urdfkit.compilation.whole_program import EntryLibrary

@numba.njit
def half(value):
    if value < 0.0:
        raise ValueError("below zero")
    return value / 2.0

def work(values):
    return half(values[0])

class Listener(event.Listener):
    def on_start(self, event):
        print("compiling", event.data["dispatcher"].py_func.__name__)
    def on_end(self, event):
        pass

with event.install_listener("numba:compile", Listener()):
    compiled = compile_or_load(work, (numba.float64[::1],), digest="{digest}", options={{}})
print(compiled(np.array([3.0])))
try:
    compiled(np.array([-3.0]))
except ValueError as error:
    print(error)
"""


def run(folder: Path, digest: str, **settings: str) -> list[str]:
    script = folder / "probe.py"
    if not script.exists() or digest not in script.read_text():
        script.write_text(SCRIPT.format(digest=digest))
    paths = [str(Path(urdfkit.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    environment = {**os.environ, **settings, "PYTHONPATH": os.pathsep.join(filter(None, paths))}
    environment["NUMBA_CACHE_DIR"] = str(folder / "cache")
    command = [sys.executable, "-W", "error", str(script)]
    done = subprocess.run(command, capture_output=True, text=True, check=True, env=environment)
    return done.stdout.splitlines()


@pytest.mark.slow
def test_what_earlier_sources_were_compiled_to_is_removed(tmp_path):
    old, new = "0123456789abcdef", "fedcba9876543210"
    run(tmp_path, old)
    folder = next((tmp_path / "cache").iterdir())
    kept = [
        folder / f"other.work_x86_64_v3_{old}-1.py311.nbi",
        folder / f"probe.work_x86_64_v3_{old}-1.py27.nbi",
        folder / "probe.work.nbi",
    ]
    for path in kept:
        path.touch()
    stale = folder / f"probe.work_{old}-1.py{sys.version_info[0]}{sys.version_info[1]}.nbi"  # before levels had a name
    stale.touch()
    assert run(tmp_path, new)[0] == "compiling work"
    assert all(path.exists() for path in kept)
    there = {path.name for path in folder.iterdir()} - {path.name for path in kept}
    assert len(there) == 2
    assert all(f"probe.work_{level().replace('-', '_')}_{new}-" in name for name in there)


@pytest.mark.slow
def test_a_second_process_compiles_nothing(tmp_path):
    assert run(tmp_path, "one") == ["compiling work", "compiling half", "1.5", "below zero"]
    assert run(tmp_path, "one") == ["1.5", "below zero"]


@pytest.mark.slow
def test_what_was_compiled_for_more_than_the_processor_has_is_not_loaded(tmp_path):
    digest = "0123456789abcdef"
    assert run(tmp_path, digest)[0] == "compiling work"
    assert run(tmp_path, digest, NUMBA_ENABLE_AVX="0")[0] == ("1.5" if level() == "x86-64-v2" else "compiling work")
    # Both are kept.
    assert run(tmp_path, digest) == run(tmp_path, digest, NUMBA_ENABLE_AVX="0") == ["1.5", "below zero"]


def test_an_untested_version_of_numba_compiles_in_its_standard_way(monkeypatch, caplog):
    def doubled(values):
        return 2.0 * values[0]

    def refuse(entry):
        raise AssertionError(entry)

    monkeypatch.setattr(whole_program, "whole_program", refuse)
    monkeypatch.setattr(load, "TESTED_VERSIONS", ("0.1",))
    arguments = (numba.float64[::1],)
    with caplog.at_level("INFO", "urdfkit.compilation"):
        dispatcher = load._compile(doubled, arguments)
    assert dispatcher(np.array([1.5])) == 3.0
    assert "is untested" in caplog.text
    monkeypatch.setattr(load, "TESTED_VERSIONS", (numba.__version__,))
    asked = []
    monkeypatch.setattr(whole_program, "whole_program", lambda entry: asked.append(entry) or nullcontext())
    load._compile(doubled, arguments)
    assert len(asked) == 1
