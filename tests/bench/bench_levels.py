"""The same seed on other processors: same bytes, and at what speed, for every robot in a house and a heap of boxes.

Run it: ``python tests/bench/bench_levels.py [SCENE …] [--seconds 10] [--rounds 5] [--json]``. A scene is a
bundled robot, driven at random through `house`, or `heap`: 80 boxes that fall into a tray. Each run is a process of its
own that is told to do without instructions that this processor has: kernels, numpy, OpenBLAS and the C library alike.
Exit code 1 where two of the level that kernels are compiled for differ in the state at the end, or in any message.

The speed is that of the kernels alone: CPU time of the same steps, in turns with kernels compiled for this processor.
"""

from __future__ import annotations

import argparse
import hashlib
import json
import os
import statistics
import subprocess
import sys
import time
from math import sqrt
from pathlib import Path
from typing import Any

import numpy as np

TESTS = Path(__file__).parents[1]
HEAP = "heap"
THIS, NO_FMA, NATIVE = "this one", "no AVX, no FMA", "native kernels"
OTHERS = (NO_FMA, NATIVE)
"""Of `processors`, those that may differ: the one below the level of the kernels, and kernels for this one alone."""
LOOK = 0.05
"""Simulated seconds between commands, and looks for new topics."""


def processors() -> dict[str, dict[str, str]]:
    """Return what the environment has to say for each processor, this one first."""
    from llvmlite import binding
    from numpy._core import _multiarray_umath as built

    has = [name for name in built.__cpu_dispatch__ if built.__cpu_features__[name]]
    wide = [name for name in has if "512" in name or name == "X86_V4"]
    no_avx512 = "glibc.cpu.hwcaps=-AVX512F,-AVX512VL,-AVX512BW,-AVX512CD,-AVX512DQ"
    return {
        THIS: {},
        "no AVX-512": {
            "NPY_DISABLE_CPU_FEATURES": " ".join(wide),
            "OPENBLAS_CORETYPE": "Haswell",
            "GLIBC_TUNABLES": no_avx512,
        },
        "numpy without AVX": {"NPY_DISABLE_CPU_FEATURES": " ".join(has), "OPENBLAS_CORETYPE": "Nehalem"},
        NO_FMA: {
            "NUMBA_ENABLE_AVX": "0",
            "NPY_DISABLE_CPU_FEATURES": " ".join(has),
            "OPENBLAS_CORETYPE": "Nehalem",
            "GLIBC_TUNABLES": f"{no_avx512},-AVX2,-AVX,-FMA,-FMA4",
        },
        NATIVE: {"NUMBA_CPU_NAME": binding.get_host_cpu_name()},
    }


def run(scene: str, processor: dict[str, str], *options: str) -> dict[str, Any]:
    """Run a scene in a process of its own; return what `here` found."""
    command = [sys.executable, __file__, scene, "--here", *options]
    done = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, **processor})
    if done.returncode:
        raise RuntimeError(f"{' '.join(command)} with {processor}: {done.stderr}")
    return json.loads(done.stdout)  # type: ignore[no-any-return]


def here(scene: str, *, seconds: float, record: bool) -> dict[str, Any]:
    """Run a scene in this process; return its CPU time [s] and digests of its end and of all that was published."""
    from urdfkit.compilation.instruction_set import level

    if scene == HEAP:
        engine = heap()
        t = time.process_time()
        engine.step(round(seconds / engine.dt))
        return {"cpu": time.process_time() - t, "level": level(), "state": digest(engine), "topics": {}}
    sys.path.insert(0, str(TESTS / "bench"))
    from soak.driver import Driver

    from urdfkit.sim import Simulator

    simulator = Simulator(scene, world="house", note=lambda _: None)
    driver = Driver(simulator, np.random.default_rng([1]))
    heard: dict[str, Any] = {}
    steps = round(LOOK / simulator.dt)
    spent = 0.0
    for look in range(round(seconds / LOOK)):
        if record:
            listen(simulator.bus, heard)
        driver.drive(look * LOOK, resting=False)
        t = time.process_time()
        simulator.step(steps)
        spent += time.process_time() - t
    topics = {name: each.hexdigest()[:16] for name, each in sorted(heard.items())}
    return {"cpu": spent, "level": level(), "state": digest(simulator.world.builder.engine), "topics": topics}


def listen(bus: Any, heard: dict[str, Any]) -> None:
    """Keep a digest of what each topic carries from now on."""
    from urdfkit.messages import typestore

    for topic in bus.topics:
        if topic.name not in heard and "/msg/" in topic.type:
            heard[topic.name] = hashlib.sha256()

            def hear(message: Any, kind: str = topic.type, into: Any = heard[topic.name]) -> None:
                into.update(bytes(typestore().serialize_cdr(message, kind)))

            bus.subscribe(topic.name, topic.type, hear)


def digest(engine: Any) -> str:
    """Return a digest of positions and velocities."""
    return hashlib.sha256(b"".join(engine.arrays[name].tobytes() for name in ("s", "v"))).hexdigest()[:16]


def heap() -> Any:
    """Return 80 boxes above a tray."""
    sys.path.insert(0, str(TESTS.parent))
    from tests.bench.peers.engine_scene import NOBODY
    from tests.bench.peers.parsed_urdf import read
    from urdfkit.description.urdf.robot import Box
    from urdfkit.kinematics import Kinematics
    from urdfkit.scene import Shape
    from urdfkit.sim.engine import Body, Engine, Ground, Piece

    def body(name: str, pose: tuple[float, ...], size: tuple[float, float, float], **options: Any) -> Any:
        return Body(name, pose, [Piece(Shape("collision", "body", "collision", Box(size), np.eye(4)))], **options)

    bodies = [
        body(f"wall{k}", (0.425 * x, 0.425 * y, 0.25, 0.0, 0.0, 0.0, 1.0), size, static=True)
        for k, (x, y, size) in enumerate(
            ((1, 0, (0.05, 0.9, 2.5)), (-1, 0, (0.05, 0.9, 2.5)), (0, 1, (0.9, 0.05, 2.5)), (0, -1, (0.9, 0.05, 2.5)))
        )
    ]
    random = np.random.default_rng(0)
    for k in range(80):
        place = (0.18 * (k % 4 - 1.5), 0.18 * (k // 4 % 4 - 1.5), 0.15 + 0.21 * (k // 16))
        x, y, z, w = random.uniform(-1.0, 1.0, 4).tolist()
        length = sqrt(x * x + y * y + z * z + w * w)
        pose = (*place, x / length, y / length, z / length, w / length)
        bodies.append(body(f"box{k}", pose, (0.12,) * 3, mass=1.0, inertia=np.eye(3) * 0.12**2 / 6.0))
    return Engine(Kinematics(read(NOBODY)), (), dt=1e-3, gravity=(0.0, 0.0, -9.81), ground=Ground(), bodies=bodies)


def compare(scene: str, *, seconds: float, rounds: int) -> dict[str, Any]:
    """Run a scene on every processor; return where it differed from this one, and its speed over native kernels."""
    found = {name: run(scene, each, f"--seconds={seconds}", "--record") for name, each in processors().items()}
    first = found[THIS]
    differ = {
        name: [topic for topic in first["topics"] if first["topics"][topic] != each["topics"][topic]]
        + (["state"] if each["state"] != first["state"] else [])
        for name, each in found.items()
    }
    ratios: dict[str, list[float]] = {}
    for turn in range(rounds):
        names = [NATIVE, THIS, NO_FMA]
        names = names[turn % 3 :] + names[: turn % 3]
        times = {name: run(scene, kernels(name), f"--seconds={seconds}")["cpu"] for name in names}
        for name in names:
            ratios.setdefault(name, []).append(times[NATIVE] / times[name])
    speed = {name: round(statistics.median(each), 3) for name, each in ratios.items() if name != NATIVE}
    return {"scene": scene, "differ": differ, "topics": len(first["topics"]), "speed": speed}


def kernels(name: str) -> dict[str, str]:
    """Return what the environment has to say for the kernels alone."""
    return {key: value for key, value in processors()[name].items() if key.startswith("NUMBA")}


def main() -> int:
    """Run what the command line asks for."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("scenes", nargs="*", metavar="SCENE", help="all when left out")
    parser.add_argument("--seconds", type=float, default=10.0, help="simulated (default: 10; heap: 2)")
    parser.add_argument("--rounds", type=int, default=5, help="of turns for the speed; 0 leaves it out (default: 5)")
    parser.add_argument("--json", action="store_true", help="print one JSON value a scene")
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--record", action="store_true", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.here:
        print(json.dumps(here(arguments.scenes[0], seconds=arguments.seconds, record=arguments.record)))
        return 0
    from urdfkit.resources import robot_names

    wrong = False
    for scene in arguments.scenes or [*robot_names(), HEAP]:
        seconds = min(arguments.seconds, 2.0) if scene == HEAP else arguments.seconds
        found = compare(scene, seconds=seconds, rounds=arguments.rounds)
        wrong = wrong or any(each for name, each in found["differ"].items() if name not in OTHERS)
        print(json.dumps(found) if arguments.json else line(found), flush=True)
    return 1 if wrong else 0


def line(found: dict[str, Any]) -> str:
    """Return a row of the table in docs/performance.md."""
    differ = "; ".join(f"{name}: {', '.join(each)}" for name, each in found["differ"].items() if each)
    speed = " | ".join(str(each) for each in found["speed"].values())
    return f"| {found['scene']} | {found['topics']} | {differ or 'same'} | {speed} |"


if __name__ == "__main__":
    sys.exit(main())
