"""One robot, so many minutes."""

from __future__ import annotations

import gc
import hashlib
import os
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from soak.driver import Driver
from soak.found import Found
from soak.watch import LOOK, Watch
from tests.bench.contact_rich import models
from urdfkit import Robot
from urdfkit.description import load
from urdfkit.errors import SimulationError
from urdfkit.resources import find_model
from urdfkit.sim import Simulator

ENOUGH = threading.Event()
"""Set by Ctrl-C: report what was covered."""
REST = (50.0, 60.0)
"""Seconds of each minute in which nothing is commanded."""
SETTLED = 4.0
"""Seconds of rest after which nothing may speed up."""
GROWTH = 2 * 1024 * 1024
"""How much memory may grow from the second minute to the end [B]."""


LEGGED: dict[str, Callable[[], str]] = {
    "quadruped": models.quadruped,
    "humanoid_25": lambda: models.humanoid(25),
    "humanoid_42": lambda: models.humanoid(42),
}
"""Robots of the scenes with many contacts, as URDF; no topic moves them."""


def loaded(name: str) -> Robot:
    """Return a legged robot, or the robot that a command would load by this name or path."""
    if name in LEGGED:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"{name}.urdf"
            path.write_text(LEGGED[name]())
            return load(path)
    model = find_model(name.split())
    return load(model.path, arguments=model.arguments)


def soak(robot: str, *, minutes: float, seed: int, world: str = "house") -> Found:
    """Drive a robot for so long."""
    found = Found(robot)
    simulator = Simulator(loaded(robot), world=world, seed=seed, note=lambda _: None)
    driver = Driver(simulator, np.random.default_rng([seed, len(robot), *robot.encode()]))
    watch = Watch(simulator, found)
    digest = hashlib.sha256()
    memory = 0
    looks, passed = round(1.0 / LOOK), 0.0
    cpu = time.process_time()
    for second in range(round(60.0 * minutes)):
        if ENOUGH.is_set():
            break
        found.simulated = second + 1.0
        resting = REST[0] <= second % 60 < REST[1]
        for part in range(looks):
            passed = second + part * LOOK
            driver.drive(passed, resting=resting)
            try:
                for _ in range(watch.glances):
                    simulator.step(round(LOOK / watch.glances / simulator.dt))
                    if watch.glances > 1:
                        watch.glance()
            except SimulationError as error:
                found.fault("diverged", passed, str(error))
                found.factor = found.simulated / (time.process_time() - cpu)
                return found
            watch.look(quiet=resting and second % 60 - REST[0] >= SETTLED)
        watch.check()
        if second < 60:
            for values in (
                simulator.state.q,
                simulator.state.v,
                *(b.pose + b.twist for b in simulator.world.bodies.values()),
            ):
                digest.update(np.array(values).tobytes())
        if watch.is_lost(may_lie=driver.by_motors) and not resting:
            found.returned += 1
            simulator.reset()
            driver.start_again()
            watch.begin()
        if second == 119:
            memory = resident()
    found.factor = found.simulated / max(1e-9, time.process_time() - cpu)
    found.digest = digest.hexdigest()
    if memory:
        found.growth = resident() - memory
        if found.growth > GROWTH:
            found.fault("memory", passed, f"{found.growth / 2**20:.1f} MiB since the second minute")
    return found


def resident() -> int:
    """Return the memory of this process [B]."""
    gc.collect()
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")
