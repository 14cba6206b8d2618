"""Peers: the other engines, and how the fastest settings of one are found for a scene."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from statistics import median
from typing import Any, Protocol

from tests.bench.peers.mujoco_scene import Mujoco
from tests.bench.peers.pybullet_scene import Pybullet
from tests.bench.peers.scene import CALL, Check, Running, Scene

GLANCE = 0.05
"""CPU seconds for which settings are tried."""
FINALISTS, HEATS, RUN_IN = 4, 5, 10
"""How many of the fastest settings are compared again, how often, and after how many glances: gaits may change late."""


class Peer(Protocol):
    """An engine to compare with; settings are its own affair, but for what ``str`` states of them."""

    name: str
    label: str

    def version(self) -> str:
        """Return the version; raise ImportError where it is not installed."""

    def settings(self, scene: Scene) -> Iterator[Any]:
        """Yield settings to try for a scene."""

    def refined(self, settings: Any) -> Iterator[Any]:
        """Yield variations of the settings that were fastest."""

    def build(self, scene: Scene) -> Callable[[Any], Running]:
        """Return what sets a scene up with given settings."""


PEERS: tuple[Peer, ...] = (Mujoco(), Pybullet())


@dataclass(frozen=True, slots=True)
class Trial:
    """A scene computed with some settings.

    Attributes:
        settings: of the peer.
        checks: whether it went as it must.
        asleep: how many things slept at the end, where the engine tells.
        rate: steps per CPU second, many in a call.
    """

    settings: Any
    checks: tuple[Check, ...]
    asleep: int | None
    rate: float

    @property
    def right(self) -> bool:
        """Whether all went as it must."""
        return all(check.ok for check in self.checks)


@dataclass(frozen=True, slots=True)
class Choice:
    """The settings a peer is measured with.

    Attributes:
        best: the fastest that are right, or the fastest of all where none are.
        faster: the fastest of all, where they are wrong and others are not.
    """

    best: Trial
    faster: Trial | None


def rate(running: Running, seconds: float, *, at_once: bool = True) -> float:
    """Return steps per CPU second over at least so many CPU seconds."""
    start, steps = time.process_time(), 0
    while True:
        running.advance(CALL, at_once=at_once)
        steps += CALL
        spent = time.process_time() - start
        if spent >= seconds:
            return steps / spent


def attempt(run: Callable[[Any], Running], settings: Any, scene: Scene, seconds: float) -> Trial:
    """Run a scene from its start, look at how it went, then time it."""
    running = run(settings)
    try:
        checks = scene.check(running)
        return Trial(settings, checks, running.asleep(), rate(running, seconds))
    finally:
        running.close()


def choose(peer: Peer, scene: Scene, *, seconds: float = GLANCE) -> Choice:
    """Find the fastest settings of a peer that are right for a scene.

    Args:
        peer: whose.
        scene: what for.
        seconds: CPU seconds for which each is tried.
    """
    run = peer.build(scene)
    trials = [attempt(run, settings, scene, seconds) for settings in peer.settings(scene)]
    first = _fastest(trials)
    trials += [attempt(run, settings, scene, seconds) for settings in peer.refined(first.settings)]
    right = [trial for trial in trials if trial.right] or trials
    finalists = sorted(right, key=lambda trial: -trial.rate)[:FINALISTS]
    best = _winner(run, finalists, scene, seconds) if len(finalists) > 1 else finalists[0]
    fastest = max(trials, key=lambda trial: trial.rate)
    return Choice(best, None if fastest.right or not best.right else fastest)


def _fastest(trials: list[Trial]) -> Trial:
    """Return the fastest trial that is right, or the fastest of all where none is."""
    return max([trial for trial in trials if trial.right] or trials, key=lambda trial: trial.rate)


def _winner(run: Callable[[Any], Running], finalists: list[Trial], scene: Scene, seconds: float) -> Trial:
    """Let finalists run in turns; return the one with the best median of those that stay right, or of all."""
    runnings = [run(trial.settings) for trial in finalists]
    for running in runnings:
        scene.check(running)
        rate(running, RUN_IN * seconds)
    heats = [[rate(running, seconds) for running in runnings] for _ in range(HEATS)]
    medians = [median(column) for column in zip(*heats, strict=True)]
    right = [all(check.ok for check in scene.check(running)) for running in runnings]
    for running in runnings:
        running.close()
    order = sorted(range(len(finalists)), key=lambda k: (right[k], medians[k]))
    return finalists[order[-1]]
