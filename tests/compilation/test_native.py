"""Machine code in files of its own: loaded without numba, for these sources only, and left alone if it is damaged."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import urdfkit
from urdfkit.compilation.native import cache_folders

SCRIPT = """
import gc
import sys
import weakref
from pathlib import Path
import numpy as np
from urdfkit.compilation import native
from urdfkit.compilation.native import NativeCode, bind, write_native

native.BUNDLED = Path("bundled")
code = NativeCode("total", [Path("source.py")], [Path("/proc/nowhere"), Path("cache")])
found = code.load()
if found is None:
    import numba
    from urdfkit.compilation import compile_or_load

    namespace = {{}}
    exec(Path("source.py").read_text(), namespace)
    kinds = numba.float64[::1], numba.int64[::1], numba.int64, numba.boolean
    options = {{"error_model": "numpy", "_nrt": False, "nogil": True}}
    dispatcher = compile_or_load(namespace["total"], kinds, digest="x", options=options, cache=False)
    write_native(code, dispatcher, arrays=2)
    found = code.load()
    print("compiled")
floats, integers = np.arange(5.0), np.array([1, 2])
print(found(floats, integers, 10, True), integers[0], found(floats, integers, -3, False))
bound = bind(found, floats, integers)
floats[0] = 100.0
print(bound(1, False), bound(True, 0), {check})
try:
    bound(1)
except TypeError:
    print("refused")
kept = weakref.ref(found)
del found
gc.collect()
print(kept() is not None, bound(2, False))
"""
SOURCE = """
def total(floats, integers, count, flag):
    result = 0.0
    for k in range(len(floats)):
        result += floats[k] % 7.0
    if flag:
        integers[0] = 40
    if count > 1000:
        raise IndexError("more than 1000")
    return int(result) + count
"""


def run(folder: Path, check: str = "0") -> list[str]:
    (folder / "probe.py").write_text(SCRIPT.format(check=check))
    root = str(Path(urdfkit.__file__).parents[1])
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, (root, os.environ.get("PYTHONPATH", ""))))}
    command = [sys.executable, "-W", "error", "probe.py"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@pytest.fixture(scope="module")
def _compiled_once(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("compiled")
    (folder / "source.py").write_text(SOURCE)
    assert run(folder)[0] == "compiled"
    return folder


@pytest.fixture
def compiled(_compiled_once: Path, tmp_path: Path) -> Path:
    """Return a folder of the test with the source and its machine code."""
    return shutil.copytree(_compiled_once, tmp_path, dirs_exist_ok=True)


RESULT = ["20 40 7", "13 13 {}", "refused", "True 14"]


@pytest.mark.slow
def test_code_is_loaded_without_numba_until_the_syntax_of_its_sources_changes(compiled: Path) -> None:
    source = compiled / "source.py"
    without = [line.format(False) for line in RESULT]
    assert run(compiled, '"numba" in sys.modules') == without
    source.write_text(f'"""Documented."""\n# a comment\n{SOURCE}\n')
    assert run(compiled, '"numba" in sys.modules') == without
    files = sorted((compiled / "cache").iterdir())
    assert [path.suffix for path in files].count(".o") == 1
    source.write_text(SOURCE.replace("7.0", "70.0"))
    assert run(compiled)[0] == "compiled"
    assert [path.suffix for path in (compiled / "cache").iterdir()].count(".o") == 1


@pytest.mark.slow
@pytest.mark.parametrize(
    "damage", [lambda content: content[:-20], lambda _: b"", lambda _: b"{}\ncode", lambda _: b"[]\n"]
)
def test_damaged_code_is_compiled_again(compiled: Path, damage) -> None:
    (code,) = (compiled / "cache").glob("*.o")
    code.write_bytes(damage(code.read_bytes()))
    assert run(compiled)[0] == "compiled"
    assert run(compiled)[0] == RESULT[0]


@pytest.mark.slow
def test_code_of_a_wheel_is_used_without_being_copied(compiled: Path) -> None:
    (compiled / "cache").rename(compiled / "bundled")
    assert run(compiled)[0] == RESULT[0]
    assert not (compiled / "cache").exists()
    (compiled / "source.py").write_text(SOURCE.replace("7.0", "70.0"))
    assert run(compiled)[0] == "compiled"
    assert len(list((compiled / "bundled").iterdir())) == 2


def test_folders_for_machine_code(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path))
    assert cache_folders(Path("/a")) == (tmp_path / "urdfkit",)
    monkeypatch.delenv("NUMBA_CACHE_DIR")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert cache_folders(Path("/a")) == (Path("/a/__pycache__"), tmp_path / "urdfkit" / "kernels")
