"""What every test shares: how hypothesis searches, and the real sdformat."""

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

from urdfkit.description.world.library import FOLDER

# Machines are shared and noisy, so no example has a deadline. A developer's every run tries new examples; in CI
# the examples are the same each time, so that a change is judged by itself.
settings.register_profile("developer", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "developer")


@pytest.fixture(autouse=True)
def _own_findings(monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Keep what lint remembers away from the user's."""
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path_factory.getbasetemp() / "cache"))


@pytest.fixture(scope="session")
def sdformat(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., list[list[str]]]:
    """Return what the real sdformat reads in files; see description/worlds/sdformat.cc."""
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
    source = Path(__file__).parent / "description" / "worlds" / "sdformat.cc"
    subprocess.run(["g++", "-O0", "-o", program, source, *flags.split()], check=True)

    def read(*files: Path) -> list[list[str]]:
        done = subprocess.run([program, FOLDER / "models", *files], capture_output=True, text=True, check=False)
        lines = [line.split("\t") for line in done.stdout.splitlines()]
        assert done.returncode == any(line[0] == "error" for line in lines), done.stderr
        return lines

    return read
