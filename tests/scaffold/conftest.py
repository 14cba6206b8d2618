import os
import shutil
import subprocess

import pytest

from urdfkit.resources import templates_dir
from urdfkit.scaffold import load_template


@pytest.fixture(scope="session")
def robot_template():
    return load_template(templates_dir() / "robot")


@pytest.fixture
def small_template(tmp_path):
    """A template of three questions and two layers, in a folder of its own."""
    folder = tmp_path / "template"
    (folder / "all/@name@/src").mkdir(parents=True)
    (folder / "all/@name@/src/@name@.txt").write_text(
        "@name@ is @size@ m: ${x} $(find @name@) user@example.com @ year @year@\n"
    )
    (folder / "blue").mkdir()
    (folder / "blue/COLOUR").write_text("blue")
    (folder / "template.toml").write_text(
        """
        summary = "a thing"
        asks_later = ["wings"]
        [[question]]
        name = "name"
        prompt = "Name"
        kind = "package"
        [[question]]
        name = "size"
        prompt = "Size"
        kind = "number"
        unit = "m"
        range = [0.1, 10]
        default = "1"
        [[question]]
        name = "twice"
        prompt = "Twice"
        kind = "number"
        default = "= 2*size"
        [[question]]
        name = "colour"
        prompt = "Colour"
        kind = "choice"
        choices = ["red", "blue"]
        default = "red"
        [[check]]
        holds = "twice >= size"
        otherwise = "--twice has to be at least --size"
        [[layer]]
        folder = "all"
        [[layer]]
        folder = "blue"
        into = ["@name@", "paint"]
        when = { colour = ["blue"] }
        [[next]]
        commands = ["look @into@/@name@"]
        [[next]]
        title = "in @colour@"
        commands = ["paint"]
        when = { colour = ["blue"] }
        """
    )
    return folder


@pytest.fixture
def debian(tmp_path):
    """Return what runs a shell command in `tmp_path` with Debian's tools and returns what it prints."""
    system = "/usr/sbin:/usr/bin:/sbin:/bin"  # a Python of the user's own breaks them

    def run(command):
        program = command.split()[0]
        if program != "." and shutil.which(program, path=system) is None:
            if os.environ.get("CI"):
                pytest.fail(f"{program} is not installed")
            pytest.skip(f"{program} is not installed")
        env = {"PATH": system, "HOME": str(tmp_path), "ROS_HOME": str(tmp_path / "ros"), "LANG": "C.UTF-8"}
        done = subprocess.run(
            ["/bin/bash", "-c", command], cwd=tmp_path, env=env, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
        return done.stdout + done.stderr

    return run
