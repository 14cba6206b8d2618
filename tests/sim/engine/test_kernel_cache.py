"""Compiling and caching of the kernel."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

import urdfkit.sim.engine
from urdfkit.sim.engine import warmup
from urdfkit.sim.engine.kernel_cache import KERNEL_MODULES, WORLD_FOLDERS, load_compiled, sources_digest, world_digest
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.simulation_memory import At

FOLDER = Path(urdfkit.sim.engine.__file__).parent


def tiny(floats, integers):
    return integers[0] + 1


def second_mass(floats, integers):
    return world(floats, integers).mass[1]


def test_a_second_warmup_has_nothing_to_compile():
    warmup()
    told = []
    assert warmup(told.append) is False
    assert told == []


@pytest.mark.slow
@pytest.mark.parametrize("surroundings", ["", ", world='house'"])
def test_a_simulation_with_compiled_kernels_imports_no_compiler(surroundings: str) -> None:
    warmup(world=bool(surroundings))
    heavy = "numba", "scipy", "trimesh", "tornado", "rosbags"
    code = (
        f"import sys; from urdfkit.sim import Simulator; Simulator('simpleton'{surroundings}).run(0.01); "
        f"print([name for name in {heavy} if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def compiled_below(name: str) -> set[str]:
    """Return the modules with compiled functions that a module of the engine imports, itself included."""
    found, waiting = set(), [name]
    while waiting:
        path = FOLDER / f"{(name := waiting.pop())}.py"
        text = path.read_text() if path.is_file() else ""
        if name not in found and ("@inlined" in text or "@compiled" in text or "def advance(" in text):
            found.add(name)
            imported = re.findall(r"^from urdfkit\.sim\.engine\.([\w.]+) import", text, re.M)
            waiting += [module.replace(".", "/") for module in imported]
    return found


def test_every_module_with_compiled_functions_is_in_the_digest():
    robot, world = compiled_below("stepping/robot_step"), compiled_below("stepping/world_step")
    assert len(robot) > 15
    assert len(world) > 40
    assert robot <= set(KERNEL_MODULES)
    assert {name for name in world if name.rpartition("/")[0] not in WORLD_FOLDERS} <= set(KERNEL_MODULES)


def test_another_digest_means_another_cache():
    one = load_compiled(tiny, ("floats", "integers"), digest="one")
    other = load_compiled(tiny, ("floats", "integers"), digest="other")
    assert one is not other
    assert one.__qualname__ != other.__qualname__


def test_a_call_goes_straight_to_what_was_compiled():
    # numba's dispatcher looks at the types of all arguments in each call.
    assert not hasattr(load_compiled(tiny, ("floats", "integers"), digest="straight"), "overloads")


def test_digest_follows_the_sources():
    assert len(sources_digest()) == len(world_digest()) == 64
    assert sources_digest() != world_digest()


SCRIPT = """
import sys, warnings
warnings.simplefilter("error")
from urdfkit.sim.engine.kernel_cache import load_compiled
import numpy as np
def tiny(floats, integers):
    return integers[0] + 1
sys.modules["__main__"].__dict__["tiny"] = tiny
told = load_compiled(tiny, ("floats", "integers"), digest="x")
print(told(np.zeros(1), np.array([41])))
"""


@pytest.mark.slow
@pytest.mark.skipif(os.name != "posix", reason="needs a folder that cannot be written")
def test_a_cache_that_cannot_be_written_is_no_failure(tmp_path):
    script = tmp_path / "probe.py"
    script.write_text(SCRIPT)
    environment = {**os.environ, "NUMBA_CACHE_DIR": "/proc/nowhere", "HOME": "/proc/nowhere"}
    done = subprocess.run([sys.executable, str(script)], capture_output=True, text=True, env=environment, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == "42"
    assert done.stderr == ""


def test_a_field_begins_where_the_sizes_say():
    import numpy as np

    integers = np.zeros(200, dtype=np.int64)
    integers[At.mass], integers[At.mass + 1] = 3, 5
    read = load_compiled(second_mass, ("floats", "integers"), digest="field")
    assert read(np.arange(9.0), integers) == 4.0
