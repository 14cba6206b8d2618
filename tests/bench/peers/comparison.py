"""The comparison: every engine on every scene, in turns."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from statistics import median

from tests.bench.peers.engine_scene import InUrdfkit
from tests.bench.peers.peer_engines import GLANCE, Choice, Peer, Trial, choose, rate
from tests.bench.peers.scene import Check, Running, Scene
from tests.bench.peers.scenes import robots
from tests.bench.peers.simulator_scene import InSimulator, fits

OURS, WHOLE = "urdfkit", "Simulator"
"""Our engine by itself, and in a `Simulator` that also publishes what a robot's topics tell."""
COUNTS = (2, 10, 50)
"""Robots in one world, for the cost of each."""
SCALING = 1.3
"""How many times a robot's cost among the fewest its cost among the most may be."""

Say = Callable[[str], None]


@dataclass(frozen=True, slots=True)
class Speed:
    """How fast an engine ran a scene.

    Attributes:
        engine: its name.
        settings: how it computed.
        checks: whether the scene went as it must, after all was measured.
        asleep: how many things slept, where the engine tells.
        single: steps per CPU second of each round, one in a call.
        many: the same, `CALL` in a call.
        faster: settings of the engine that are faster but wrong.
    """

    engine: str
    settings: str
    checks: tuple[Check, ...]
    asleep: int | None
    single: tuple[float, ...]
    many: tuple[float, ...]
    faster: Trial | None = None

    @property
    def right(self) -> bool:
        """Whether all went as it must."""
        return all(check.ok for check in self.checks)


@dataclass(frozen=True, slots=True)
class Compared:
    """A scene and how fast each engine ran it, ours first."""

    scene: Scene
    speeds: tuple[Speed, ...]

    def ratio(self, engine: str, *, at_once: bool) -> float:
        """Return the median over the rounds of our speed by that of an engine in the same round."""
        ours, theirs = self.speeds[0], next(speed for speed in self.speeds if speed.engine == engine)
        pairs = zip(ours.many, theirs.many, strict=True) if at_once else zip(ours.single, theirs.single, strict=True)
        return median(a / b for a, b in pairs)


@dataclass(frozen=True, slots=True)
class Scaled:
    """What a robot costs an engine among more and more of its kind.

    Attributes:
        engine: its name.
        settings: how it computed.
        right: whether all robots drove as they must, whatever their number.
        costs: CPU seconds a step per robot, for each of `COUNTS`.
    """

    engine: str
    settings: str
    right: bool
    costs: tuple[float, ...]

    @property
    def growth(self) -> float:
        """Cost per robot among the most by that among the fewest."""
        return self.costs[-1] / self.costs[0]


class Comparison:
    """Compares engines.

    Args:
        peers: those installed.
        seconds: CPU seconds of a measurement.
        rounds: how often each is repeated.
        say: told what is being done.
    """

    def __init__(self, peers: Sequence[Peer], *, seconds: float, rounds: int, say: Say) -> None:
        self._peers = peers
        self._seconds = seconds
        self._rounds = rounds
        self._say = say
        self._choices: dict[tuple[str, str], Choice] = {}

    def compare(self, scene: Scene) -> Compared:
        """Measure our engine and the peers, each at its best settings, on a scene."""
        runnings: dict[str, Running] = {OURS: InUrdfkit(scene)}
        if fits(scene):
            runnings[WHOLE] = InSimulator(scene)
        for peer in self._peers:
            choice = self._choice(peer, scene)
            runnings[peer.name] = peer.build(scene)(choice.best.settings)
        for running in runnings.values():
            scene.check(running)  # into its steady state
        self._say(f"{scene.name}: measuring")
        single = self._in_turns(runnings, at_once=False)
        many = self._in_turns(runnings, at_once=True)
        # Looked at again, because what goes well at first may go wrong later.
        checks = {name: scene.check(running) for name, running in runnings.items()}
        asleep = {name: running.asleep() for name, running in runnings.items()}
        for running in runnings.values():
            running.close()
        speeds = []
        for name in runnings:
            chosen = self._choices.get((name, scene.name))
            settings, faster = ("", None) if chosen is None else (str(chosen.best.settings), chosen.faster)
            speeds.append(Speed(name, settings, checks[name], asleep[name], single[name], many[name], faster))
        return Compared(scene, tuple(speeds))

    def scale(self) -> tuple[Scaled, ...]:
        """Measure the cost per robot of each engine at `COUNTS`; the peers with their settings for ten."""
        scenes = [robots(count) for count in COUNTS]
        makers: dict[str, tuple[str, Callable[[Scene], Running]]] = {OURS: ("", InUrdfkit)}
        for peer in self._peers:
            settings = self._choice(peer, robots(10)).best.settings
            makers[peer.name] = (str(settings), partial(_built, peer, settings))
        found = []
        for engine, (settings, make) in makers.items():
            self._say(f"scaling: {engine}")
            runnings = {scene.name: make(scene) for scene in scenes}
            right = all(check.ok for scene in scenes for check in scene.check(runnings[scene.name]))
            rates = self._in_turns(runnings, at_once=True)
            for running in runnings.values():
                running.close()
            costs = tuple(
                1.0 / (median(rates[scene.name]) * count) for scene, count in zip(scenes, COUNTS, strict=True)
            )
            found.append(Scaled(engine, settings, right, costs))
        return tuple(found)

    def _choice(self, peer: Peer, scene: Scene) -> Choice:
        key = (peer.name, scene.name)
        if key not in self._choices:
            self._say(f"{scene.name}: best settings of {peer.label}")
            self._choices[key] = choose(peer, scene, seconds=min(GLANCE, self._seconds))
        return self._choices[key]

    def _in_turns(self, runnings: Mapping[str, Running], *, at_once: bool) -> dict[str, tuple[float, ...]]:
        """Return the rates of each round; in every round another one begins."""
        names = list(runnings)
        rates: dict[str, list[float]] = {name: [] for name in names}
        for k in range(self._rounds):
            turn = k % len(names)
            for name in names[turn:] + names[:turn]:
                rates[name].append(rate(runnings[name], self._seconds, at_once=at_once))
        return {name: tuple(found) for name, found in rates.items()}


def _built(peer: Peer, settings: object, scene: Scene) -> Running:
    return peer.build(scene)(settings)
