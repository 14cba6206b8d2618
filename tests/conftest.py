"""What all tests share: settings of hypothesis, time limits, markers for system packages, the real sdformat."""

import gc
import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

from tests import system_packages
from urdfkit.description.sdf.model_library import FOLDER
from urdfkit.scene.gl.driver_probe import probe

pytest_plugins = ("tests.leftover_processes", "tests.slow_tests", "tests.time_limit")

# Machines are shared and noisy, so no example has a deadline. A developer's every run tries new examples; in CI
# the examples are the same each time, so that a change is judged by itself.
settings.register_profile("developer", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "developer")


def pytest_configure(config: pytest.Config) -> None:
    # pytest-xdist and some shells export the size of the terminal. Output would be wrapped for it.
    for name in ("COLUMNS", "LINES"):
        os.environ.pop(name, None)
    for group in system_packages.GROUPS:
        config.addinivalue_line("markers", f"{group}: needs the packages of this group in tests/system_packages.txt")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark the tests that use the real sdformat by its fixture, and those with programs that may fail by themselves.

    A test with a browser or with nodes of ROS runs a second time if it fails, since some of these programs have
    faults of their own on a busy machine; the summary names it, as a fault to look for.
    """
    for item in items:
        if "sdformat" in getattr(item, "fixturenames", ()):
            item.add_marker("sdformat")
        if item.nodeid.startswith("tests/bridges/") or item.get_closest_marker("browser"):
            item.add_marker(pytest.mark.flaky(reruns=1))


@pytest.hookimpl(trylast=True)
def pytest_collection_finish() -> None:
    """Leave all tests and imported modules out of further garbage collections, which took a second each."""
    gc.collect()
    gc.freeze()


@pytest.hookimpl(tryfirst=True)  # before the fixtures of the test
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Skip a test whose system packages are missing; in CI, where none may be missing, fail it."""
    if reason := reason_to_skip({mark.name for mark in item.iter_markers()}):
        if os.environ.get("CI") and reason.startswith("missing"):
            pytest.fail(reason, pytrace=False)
        pytest.skip(reason)


def reason_to_skip(markers: set[str]) -> str:
    """Return why a test with these markers cannot run here; an empty string if it can."""
    if "opengl" in markers:  # any driver will do
        found = probe()
        if found.works:
            markers = markers - {"opengl"}
        elif not system_packages.missing(["opengl"]):
            return f"OpenGL does not work: {found.name}"
    packages = system_packages.missing(markers)
    return system_packages.message(packages) if packages else ""


@pytest.fixture(autouse=True)
def _own_findings(monkeypatch: pytest.MonkeyPatch, tmp_path_factory: pytest.TempPathFactory) -> None:
    """Keep what lint remembers away from the user's."""
    monkeypatch.setenv("URDFKIT_CACHE_DIR", str(tmp_path_factory.getbasetemp() / "cache"))


@pytest.fixture(scope="session")
def sdformat(tmp_path_factory: pytest.TempPathFactory) -> Callable[..., list[list[str]]]:
    """Return what the real sdformat reads in files; see description/worlds/sdformat.cc."""
    asked = ["pkg-config", "--cflags", "--libs", "sdformat12"]
    flags = subprocess.run(asked, stdout=subprocess.PIPE, text=True, check=True).stdout
    program = tmp_path_factory.mktemp("sdformat") / "sdformat"
    source = Path(__file__).parent / "description" / "worlds" / "sdformat.cc"
    subprocess.run(["g++", "-O0", "-o", program, source, *flags.split()], check=True)

    def read(*files: Path) -> list[list[str]]:
        done = subprocess.run([program, FOLDER / "models", *files], capture_output=True, text=True, check=False)
        lines = [line.split("\t") for line in done.stdout.splitlines()]
        assert done.returncode == any(line[0] == "error" for line in lines), done.stderr
        return lines

    return read
