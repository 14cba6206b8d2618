"""Output of the benchmark: a table that fits narrow terminals and pipes."""

from __future__ import annotations

import os
import sys
import textwrap
from statistics import median
from typing import TYPE_CHECKING, Any

from tests.bench.peers.report import as_json
from urdfkit.cli.parser import columns

if TYPE_CHECKING:
    from tests.bench.peers.report import Report

LABELS = {"urdfkit": "urdfkit", "Simulator": "in a Simulator", "mujoco": "MuJoCo", "pybullet": "PyBullet"}
GREEN, RED, BOLD = "\x1b[32m", "\x1b[31m", "\x1b[1m"
RESET = "\x1b[0m"
NUMBER_COLUMNS = 54
"""Width of the numbers of a line [columns]; notes follow them, or are below where the terminal is too narrow."""
NOTE_COLUMNS = 40
"""Minimum width of notes that follow the numbers [columns]."""


def table(report: Report, *, color: str = "auto", width: int | None = None) -> str:
    """Return the report as text.

    Args:
        report: the measurements.
        color: ``auto``, ``always`` or ``never``.
        width: width in columns; that of the terminal when None, unlimited without a terminal.
    """
    return "\n".join(_Table(color, width if width is not None else columns()).lines(as_json(report)))


class _Table:
    def __init__(self, color: str, width: int | None) -> None:
        allowed = sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"
        self._colored = color == "always" or (color == "auto" and allowed)
        self._width = width

    def lines(self, report: dict[str, Any]) -> list[str]:
        lines = []
        if report["scenes"]:
            many = f"{report['steps_per_call']} a call"
            lines.append(f"{'steps per CPU s':18}{'1 a call':>9}{many:>11}{'ours/theirs':>14}")
        for scene in report["scenes"]:
            lines += [self._styled(f"{scene['scene']}: {scene['title']}", BOLD), *self._scene(scene)]
        if report["scaling"]:
            lines += ["", *self._scaling(report["scaling"])]
        if report["memory"]:
            memory = report["memory"]
            text = f"{memory['peak'] / 1e6:.0f} MB (target: under {memory['target'] / 1e6:.0f})"
            title = self._styled(f"memory: {memory['robot']} driving in {memory['world']}", BOLD)
            lines += ["", title, "  " + self._judged(text, memory["met"])]
        machine = report["machine"]
        versions = ", ".join(f"{LABELS[name]} {version}" for name, version in report["engines"].items())
        about = f"{machine['processor']}, {machine['cores']} cores, Python {machine['python']}"
        lines += ["", *self._wrapped(f"{versions}, numba {machine['numba']}; {about}")]
        medians = f"medians of {report['rounds']} rounds of {report['seconds']:g} CPU s in turns"
        lines += self._wrapped(f"{medians}; step {report['dt']:g} s; ratios are medians of the rounds' ratios")
        return lines

    def _scene(self, scene: dict[str, Any]) -> list[str]:
        lines = []
        for engine, speed in scene["engines"].items():
            rates = speed["steps_per_cpu_second"]
            line = f"  {LABELS[engine]:16}{_rate(rates['single']):>9}{_rate(rates['many']):>11}"
            ratio, notes = scene["ratios"].get(engine), [_checks(speed)]
            if ratio is not None:
                met = ratio["met"] or {}
                pair = (self._judged(f"{ratio[way]:>6.2f}", met.get(way)) for way in ("single", "many"))
                line += "  " + "".join(pair)
                if ratio["target"] is not None:
                    notes.insert(0, f"target {ratio['target']:g}")
                notes.insert(0, speed["settings"] or "ours: without topics and plugins")
                notes += _ratio_of_simulator(scene["engines"], engine)
            lines += self._with_notes(line, "; ".join(notes), met=None if speed["right"] else False)
            if faster := speed["faster_but_wrong"]:
                text = f"faster but wrong: {faster['settings']} at {_rate(faster['steps_per_cpu_second'])}"
                lines += self._wrapped(f"{text}, {_checks({**faster, 'right': False})}", indent=4)
        return lines

    def _scaling(self, scaling: dict[str, Any]) -> list[str]:
        counts = "".join(f"{count:>10}" for count in scaling["robots"])
        lines = [self._styled("scaling: CPU µs per step and robot", BOLD), f"  {'robots':16}{counts}"]
        for engine, row in scaling["engines"].items():
            ours = engine == "urdfkit"
            costs = "".join(f"{cost:>10.2f}" for cost in row["microseconds_per_robot"])
            text = f"grows {row['growth']:.2f} times" + f", target: at most {scaling['target']}" * ours
            text += "" if row["right"] else "; WRONG: not all drive as they must"
            met = row["right"] and (row["met"] if ours else None)
            lines += self._with_notes(f"  {LABELS[engine]:16}{costs}", text, met=met)
        return lines

    def _with_notes(self, line: str, notes: str, *, met: bool | None) -> list[str]:
        if self._width is None or self._width - NUMBER_COLUMNS >= NOTE_COLUMNS:
            room = 10_000 if self._width is None else self._width - NUMBER_COLUMNS
            first, *others = textwrap.wrap(notes, room)
            plain = len(line.replace(GREEN, "").replace(RED, "").replace(RESET, ""))
            gap = " " * max(2, NUMBER_COLUMNS - plain)
            return [
                line + gap + self._judged(first, met),
                *(" " * NUMBER_COLUMNS + self._judged(o, met) for o in others),
            ]
        return [line, *(self._judged(text, met) for text in self._wrapped(notes, indent=4))]

    def _wrapped(self, text: str, *, indent: int = 0) -> list[str]:
        before = " " * indent
        if self._width is None:
            return [before + text]
        return textwrap.wrap(text, max(20, self._width), initial_indent=before, subsequent_indent=before)

    def _judged(self, text: str, met: bool | None) -> str:
        return text if met is None else self._styled(text, GREEN if met else RED)

    def _styled(self, text: str, style: str) -> str:
        return f"{style}{text}{RESET}" if self._colored else text


def _ratio_of_simulator(engines: dict[str, Any], peer: str) -> list[str]:
    """Return the speed of a whole `Simulator` relative to another engine, with one and with many steps a call."""
    whole = engines.get("Simulator")
    if whole is None or peer == "Simulator":
        return []
    pairs = [zip(whole["rounds"][way], engines[peer]["rounds"][way], strict=True) for way in ("single", "many")]
    single, many = (median(ours / theirs for ours, theirs in pair) for pair in pairs)
    return [f"a Simulator has {single:.2f} and {many:.2f} times its speed"]


def _rate(steps: float) -> str:
    if steps >= 1e6:
        return f"{steps / 1e6:.2f}M"
    return f"{steps / 1e3:.0f}k" if steps >= 1e4 else f"{steps / 1e3:.1f}k"


def _checks(speed: dict[str, Any]) -> str:
    results = [_check(check) for check in speed["checks"]]
    if speed.get("asleep"):
        results.append(f"{speed['asleep']} asleep")
    return ("right: " if speed["right"] else "WRONG: ") + ", ".join(results)


def _check(check: dict[str, Any]) -> str:
    must = f" of {check['ideal']:.4g}" if check["ideal"] else ""
    return f"{check['what']} {check['value']:.3g}{must} {check['unit']}"
