"""What was measured, as JSON; docs/performance.md describes it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from statistics import median
from typing import Any

from tests.bench.peers.comparison import COUNTS, OURS, SCALING, WHOLE, Compared, Scaled, Speed
from tests.bench.peers.memory_use import MOST, ROBOT, WORLD, Memory
from tests.bench.peers.scene import CALL, DT, Check


@dataclass(frozen=True, slots=True)
class Report:
    """All that was measured.

    Attributes:
        machine: what it was measured on.
        engines: name → version of those that took part.
        missing: name → what to install, of those that did not.
        seconds: CPU seconds of a measurement.
        rounds: how often each was repeated.
        scenes: what came of the scenes.
        scaling: cost per robot, by engine; empty where it was not asked for.
        memory: of a running house simulation; None where it was not asked for.
    """

    machine: Mapping[str, str | int]
    engines: Mapping[str, str]
    missing: Mapping[str, str]
    seconds: float
    rounds: int
    scenes: Sequence[Compared]
    scaling: Sequence[Scaled]
    memory: Memory | None

    @property
    def right(self) -> bool:
        """Whether our engine did all scenes as it must, by itself and in a `Simulator`."""
        ours = [speed for compared in self.scenes for speed in compared.speeds if speed.engine in (OURS, WHOLE)]
        return all(speed.right for speed in ours) and all(row.right for row in self.scaling if row.engine == OURS)


def as_json(report: Report) -> dict[str, Any]:
    """Return the report as JSON values."""
    memory, scaling = report.memory, report.scaling
    return {
        "dt": DT,
        "steps_per_call": CALL,
        "seconds": report.seconds,
        "rounds": report.rounds,
        "machine": dict(report.machine),
        "engines": dict(report.engines),
        "missing": dict(report.missing),
        "scenes": [_compared(compared) for compared in report.scenes],
        "scaling": _scaling(scaling) if scaling else None,
        "memory": None
        if memory is None
        else {"robot": ROBOT, "world": WORLD, **asdict(memory), "target": MOST, "met": memory.peak < MOST},
    }


def _compared(compared: Compared) -> dict[str, Any]:
    ratios: dict[str, Any] = {}
    for speed in compared.speeds[1:]:
        single, many = (compared.ratio(speed.engine, at_once=at_once) for at_once in (False, True))
        target = compared.scene.targets.get(speed.engine)
        met = None if target is None else {"single": single >= target, "many": many >= target}
        ratios[speed.engine] = {"single": single, "many": many, "target": target, "met": met}
    return {
        "scene": compared.scene.name,
        "title": compared.scene.title,
        "engines": {speed.engine: _speed(speed) for speed in compared.speeds},
        "ratios": ratios,
    }


def _speed(speed: Speed) -> dict[str, Any]:
    faster = speed.faster
    return {
        "settings": speed.settings,
        "right": speed.right,
        "checks": [_check(check) for check in speed.checks],
        "asleep": speed.asleep,
        "steps_per_cpu_second": {"single": median(speed.single), "many": median(speed.many)},
        "rounds": {"single": list(speed.single), "many": list(speed.many)},
        "faster_but_wrong": None
        if faster is None
        else {
            "settings": str(faster.settings),
            "steps_per_cpu_second": faster.rate,
            "checks": [_check(check) for check in faster.checks],
        },
    }


def _check(check: Check) -> dict[str, Any]:
    return {**asdict(check), "ok": check.ok}


def _scaling(rows: Sequence[Scaled]) -> dict[str, Any]:
    return {
        "robots": list(COUNTS),
        "target": SCALING,
        "engines": {
            row.engine: {
                "settings": row.settings,
                "right": row.right,
                "microseconds_per_robot": [1e6 * cost for cost in row.costs],
                "growth": row.growth,
                "met": row.growth <= SCALING,
            }
            for row in rows
        },
    }
