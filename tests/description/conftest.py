from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.description.world.library import FOLDER

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


@pytest.fixture(scope="session")
def sdformat(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., list[list[str]]]:
    """Return what the real sdformat reads in files; see worlds/sdformat.cc."""
    flags = ""
    if shutil.which("pkg-config") and shutil.which("g++"):
        asking = ["pkg-config", "--cflags", "--libs", "sdformat12"]
        asked = subprocess.run(asking, capture_output=True, text=True, check=False)
        flags = "" if asked.returncode else asked.stdout
    if not flags:
        if os.environ.get("CI"):
            pytest.fail("g++, pkg-config or libsdformat-dev is not installed")
        pytest.skip("g++, pkg-config or libsdformat-dev is not installed")
    program = tmp_path_factory.mktemp("sdformat") / "sdformat"
    source = Path(__file__).parent / "worlds" / "sdformat.cc"
    subprocess.run(["g++", "-O0", "-o", program, source, *flags.split()], check=True)

    def read(*files: Path) -> list[list[str]]:
        done = subprocess.run([program, FOLDER / "models", *files], capture_output=True, text=True, check=False)
        lines = [line.split("\t") for line in done.stdout.splitlines()]
        assert done.returncode == any(line[0] == "error" for line in lines), done.stderr
        return lines

    return read
