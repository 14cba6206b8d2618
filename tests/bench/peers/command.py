"""Compare the speed of urdfkit's engine with MuJoCo and PyBullet in the same scenes."""

from __future__ import annotations

import argparse
import json
import os
import sys
from typing import TYPE_CHECKING

from urdfkit.cli.sim import option_values
from urdfkit.errors import SimulationError, did_you_mean

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from tests.bench.peers.peer_engines import Peer
    from tests.bench.peers.report import Report

SCALING, MEMORY = "scaling", "memory"
ALSO = {
    SCALING: "cost per robot among 2, 10 and 50 in one world",
    MEMORY: "memory of a running house simulation",
}
"""Measurements in addition to the scenes."""
INSTALL = "pip install 'urdfkit[bench]'"
"""Command that installs the other engines."""
THREADS = ("NUMBA_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Variables that set the number of threads of libraries: one, so that CPU seconds are those of one core."""


def main(argv: Sequence[str] | None = None) -> int:
    """Measure and report; return 1 where urdfkit's engine fails a check, else 0."""
    for name in THREADS:
        os.environ.setdefault(name, "1")
    names = {**_scenes(), **ALSO}
    parser = _parser()
    arguments = parser.parse_args(argv)
    for name in arguments.scene:
        if name not in names:
            parser.error(f"unknown scene `{name}`{did_you_mean(name, names)}")
    if arguments.list:
        print(json.dumps(names, indent=1) if arguments.json else _listing(names))
        return 0
    wanted = list(dict.fromkeys(arguments.scene)) or list(names)
    report = measure(wanted, seconds=arguments.seconds, rounds=arguments.rounds, quiet=arguments.quiet)
    from tests.bench.peers.report import as_json
    from tests.bench.peers.table import table

    print(json.dumps(as_json(report), indent=1) if arguments.json else table(report, color=arguments.color))
    return 0 if report.right else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m tests.bench.peers", description=__doc__, allow_abbrev=False)
    add = parser.add_argument
    scenes = "measure only this scene (repeatable; --list prints all names)"
    add("--scene", action="append", default=[], metavar="NAME", help=scenes)
    cpu = "CPU seconds of each measurement (default: 0.3)"
    add("--seconds", type=option_values.positive, default=0.3, metavar="S", help=cpu)
    add("--rounds", type=_count, default=5, metavar="N", help="rounds of all measurements (default: 5)")
    add("--list", action="store_true", help="list the scenes and exit")
    add("--json", action="store_true", help="print one JSON value")
    add("--quiet", action="store_true", help="print no progress")
    add("--color", choices=("auto", "always", "never"), default="auto", help="colours of the table (default: auto)")
    return parser


def measure(names: Sequence[str], *, seconds: float, rounds: int, quiet: bool = False) -> Report:
    """Measure scenes.

    Args:
        names: names of scenes, or of `ALSO`.
        seconds: CPU seconds of a measurement.
        rounds: rounds of all measurements.
        quiet: print no progress.
    """
    prepare(names)
    from tests.bench.peers import memory_use
    from tests.bench.peers.comparison import OURS, Comparison
    from tests.bench.peers.machine_description import machine
    from tests.bench.peers.peer_engines import PEERS
    from tests.bench.peers.report import Report
    from tests.bench.peers.scenes import SCENES
    from urdfkit import __version__

    engines, missing = {OURS: __version__}, {}
    peers: list[Peer] = []
    for peer in PEERS if set(names) != {MEMORY} else ():
        try:
            engines[peer.name] = peer.version()
            peers.append(peer)
        except ImportError:
            missing[peer.name] = INSTALL
            print(f"urdfkit: {peer.label} is not installed and is skipped; install it with {INSTALL}", file=sys.stderr)
    print_progress = _progress(quiet=quiet)
    held = None
    if MEMORY in names:
        print_progress("memory: driving through the house")
        try:
            held = memory_use.measure()
        except SimulationError as error:
            print_progress("")
            print(f"urdfkit: memory is skipped: {error}", file=sys.stderr)
    comparison = Comparison(peers, seconds=seconds, rounds=rounds, say=print_progress)
    scenes = [comparison.compare(scene) for scene in SCENES if scene.name in names]
    scaling = comparison.scale() if SCALING in names else ()
    print_progress("")
    return Report(machine(), engines, missing, seconds, rounds, scenes, scaling, held)


def prepare(names: Sequence[str]) -> None:
    """Compile the needed kernels, so that no measurement includes a compilation."""
    from urdfkit.app.simulation.kernel_compilation import prepare_kernel

    prepare_kernel(sys.stderr)
    from tests.bench.peers.scenes import SCENES

    worlds = {SCALING, MEMORY, *(scene.name for scene in SCENES if scene.loose or len(scene.things) > 1)}
    if worlds & set(names):
        prepare_kernel(sys.stderr, world=True)


def _scenes() -> dict[str, str]:
    from tests.bench.peers.scenes import SCENES

    return {scene.name: scene.title for scene in SCENES}


def _listing(names: dict[str, str]) -> str:
    width = max(map(len, names))
    return "\n".join(f"{name:{width}}  {title}" for name, title in names.items())


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"`{text}` must be a whole number, one or more")
    return int(text)


def _progress(*, quiet: bool) -> Callable[[str], None]:
    """Return a function that prints the progress: one updated line on a terminal, else lines; "" clears the line."""
    terminal = sys.stderr.isatty()

    def print_progress(text: str) -> None:
        if quiet:
            return
        if terminal:
            print(f"\r\x1b[K{text}" + " …" * bool(text), end="", file=sys.stderr, flush=True)
        elif text:
            print(text, file=sys.stderr, flush=True)

    return print_progress
