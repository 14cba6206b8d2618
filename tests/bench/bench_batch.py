"""Compare batches of worlds with ``mujoco.rollout``: diff drives, arms and quadrupeds, with as many threads.

Run it as ``python tests/bench/bench_batch.py [--worlds N] [--threads N] [--rounds N] [SCENE]…``. Both step the same
robots with the same targets, in turns in one process. The times are CPU seconds, all threads together. An action lasts
`PERIOD` steps; targets change with each. MuJoCo uses the fastest of its settings with which the scene of
``tests.bench.peers`` or ``tests.bench.contact_rich`` passes its checks.
"""

from __future__ import annotations

import argparse
import os
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from typing import Any

for _name in ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(_name, "1")
sys.path.insert(0, str(Path(__file__).parents[2]))

import numpy as np  # noqa: E402
from numpy.typing import NDArray  # noqa: E402

from tests.bench.contact_rich.command import CANDIDATES  # noqa: E402
from tests.bench.contact_rich.scenes import cases  # noqa: E402
from tests.bench.peers.mujoco_scene import Built, InMujoco, Settings  # noqa: E402
from tests.bench.peers.scene import DT, Running, Scene, Thing  # noqa: E402
from tests.bench.peers.scenes import SCENES  # noqa: E402
from urdfkit.sim import Spawn  # noqa: E402
from urdfkit.sim.batch import Batch, Servo  # noqa: E402

PERIOD, PERIODS = 20, 25
"""Steps of an action, and actions of a measurement."""
SPREAD = 0.01
"""Random share by which the targets of the worlds differ, so that no world repeats another."""
TARGETS = {"diff-drive": 2.0, "arm": 2.0, "quadruped-trotting": 1.0}


@dataclass(frozen=True)
class Targets:
    """Targets of all worlds, one row for each action of a cycle; shape (actions, worlds, joints)."""

    joints: tuple[str, ...]
    values: NDArray[np.float64]


def targets_of(thing: Thing, turn: float, worlds: int) -> Targets:
    """Return the targets of a scene's robot, different in each world."""
    joints = (*thing.motors, *thing.servos)
    speeds = [motor.speed for motor in thing.motors.values()]
    rows = []
    each = round(turn / (PERIOD * DT)) or 1
    for k in range(each * max(1, len(thing.poses))):
        pose = thing.poses[k // each] if thing.poses else {}
        rows.append([*speeds, *(pose[joint] for joint in thing.servos)])
    spread = 1.0 + SPREAD * np.random.default_rng(0).uniform(-1.0, 1.0, (1, worlds, len(joints)))
    return Targets(joints, np.array(rows)[:, None, :] * spread)


class OurWorlds:
    """Worlds in a batch."""

    def __init__(self, scene: Scene, targets: Targets, threads: int) -> None:
        thing, self._targets, self._action = scene.things[0], targets.values, 0
        control: dict[str, str | Servo] = dict.fromkeys(thing.motors, "velocity")
        control |= {joint: Servo(each.stiffness, each.damping) for joint, each in thing.servos.items()}
        efforts = {joint: each.effort for joint, each in (*thing.motors.items(), *thing.servos.items())}
        vary: dict[str, Any] = {f"{joint}.effort": (effort, effort) for joint, effort in efforts.items()}
        urdf = thing.urdf
        for link in thing.slippery:
            vary[f"{link}.mu"] = (0.0, 0.0)
        with TemporaryDirectory() as folder:
            path = Path(folder) / "robot.urdf"
            path.write_text(urdf)
            x, y, z = thing.at
            spawn = Spawn(x=x, y=y, z=z, joints=thing.poses[0] if thing.poses else {})
            self.batch = Batch(
                path, targets.values.shape[1], control=control, vary=vary, threads=threads, dt=DT, spawn=spawn,
                fixed_base=thing.bolted, ranges=dict.fromkeys(control, (-1e9, 1e9)),
            )  # fmt: skip

    def advance(self) -> None:
        """Advance by `PERIODS` actions and read the state after each."""
        for _ in range(PERIODS):
            self.batch.step(self._targets[self._action % len(self._targets)], PERIOD)
            self._action += 1

    def heights(self) -> NDArray[np.float64]:
        """Return the heights of the root links [m]."""
        return self.batch.base_pose[:, 2].copy()


class TheirWorlds:
    """Worlds in ``mujoco.rollout``."""

    def __init__(self, scene: Scene, targets: Targets, threads: int, settings: Settings) -> None:
        import mujoco
        import mujoco.rollout

        running = InMujoco(Built(scene), settings)
        self._model, data = running.model, running.state
        self._data = [mujoco.MjData(self._model) for _ in range(threads)]
        kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
        start = np.zeros(mujoco.mj_stateSize(self._model, kind))
        mujoco.mj_getState(self._model, data, start, kind)
        worlds = targets.values.shape[1]
        self._state = np.tile(start, (worlds, 1))
        columns = [self._model.actuator(f"0/{joint}").id for joint in targets.joints]
        self._controls = np.zeros((len(targets.values), worlds, 1, self._model.nu))
        self._controls[..., columns] = targets.values[:, :, None, :]
        self._rollout = mujoco.rollout.Rollout(nthread=threads)
        self._action = 0

    def advance(self) -> None:
        """Advance by `PERIODS` actions; the state after each is known."""
        for _ in range(PERIODS):
            controls = self._controls[self._action % len(self._controls)]
            self._action += 1
            repeated = np.broadcast_to(controls, (len(controls), PERIOD, controls.shape[-1]))
            states, _ = self._rollout.rollout(self._model, self._data, self._state, np.ascontiguousarray(repeated))
            self._state = states[:, -1]

    def heights(self) -> NDArray[np.float64]:
        """Return the heights of the root links [m]."""
        found: NDArray[np.float64] = self._state[:, 3].copy()
        return found


def fastest_settings(scene: Scene, settle: float) -> Settings:
    """Return MuJoCo's fastest settings with which a scene passes its checks."""
    built, found = Built(scene), []
    for settings in CANDIDATES:
        settings = replace(settings, gain=1.0 if settings.integrator == "Euler" else settings.gain)
        running: Running = InMujoco(built, settings)
        running.advance(round(settle / DT))
        start = time.process_time()
        running.advance(1000)
        cost = time.process_time() - start
        found.append((not all(check.ok for check in scene.check(running)), cost, settings))
    return min(found, key=lambda each: each[:2])[2]


def compare(scene: Scene, settle: float, worlds: int, threads: int, rounds: int) -> str:
    """Return the line of a scene."""
    settings = fastest_settings(scene, settle)
    targets = targets_of(scene.things[0], scene.turn, worlds)
    engines = OurWorlds(scene, targets, threads), TheirWorlds(scene, targets, threads, settings)
    costs: tuple[list[float], list[float]] = ([], [])
    for each in engines:
        for _ in range(max(1, round(settle / DT / PERIOD / PERIODS))):
            each.advance()
    for _ in range(rounds):
        for each, times in zip(engines, costs, strict=True):
            start = time.process_time()
            each.advance()
            times.append((time.process_time() - start) / (worlds * PERIOD * PERIODS))
    ours, theirs = (1e6 * median(times) for times in costs)
    ratio = median(b / a for a, b in zip(*costs, strict=True))
    heights = " ".join(f"{np.mean(each.heights()):.3f}" for each in engines) if not scene.things[0].bolted else "-"
    target = TARGETS[scene.name]
    missed = "  missed" if ratio < target else ""
    return f"{scene.name:20s} {ours:8.2f} {theirs:8.2f} {ratio:7.2f} {target:7.1f}   {heights:13s} {settings}{missed}"


def main(argv: Sequence[str] | None = None) -> int:
    """Measure the named scenes, or all."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scene", nargs="*", help="names; all scenes without any")
    parser.add_argument("--worlds", type=int, default=1024)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--rounds", type=int, default=5)
    options = parser.parse_args(argv)
    scenes = {scene.name: (scene, 0.2) for scene in SCENES} | {each.scene.name: (each.scene, 1.0) for each in cases()}
    print(f"{options.worlds} worlds, {options.threads} threads, actions of {PERIOD} steps")
    print("µs per step and world  urdfkit  MuJoCo   ratio  target   heights [m]   settings", flush=True)
    for name in options.scene or TARGETS:
        print(compare(*scenes[name], options.worlds, options.threads, options.rounds), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
