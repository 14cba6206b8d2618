"""`urdfkit sim sweep`: simulate a robot with many combinations of parameters, on all cores or a cluster."""

from __future__ import annotations

import argparse
import json
import math
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.app.page import require_packages
from urdfkit.app.termination import ended_by_signals
from urdfkit.cli.progress_line import ProgressLine
from urdfkit.cli.sim.run_options import (
    add_run_options,
    check_run_options,
    duration_of,
    load_robot_of_run,
    run_options_of,
)
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.sweeps.results import Sweep
    from urdfkit.description import Robot

PERIOD = 0.5
"""Wall seconds between lines of progress."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_run_options(parser)
    group = parser.add_argument_group("options of the sweep")
    add = group.add_argument
    add(
        "--vary",
        action="append",
        default=[],
        metavar="NAME=VALUES",
        help="values of a parameter: V1,V2,…, FIRST:LAST:COUNT, or LOW..HIGH, from which each seed draws a value "
        "(repeatable; all combinations are simulated)",
    )
    add(
        "--seeds",
        type=int,
        default=1,
        metavar="N",
        help="runs of each combination, with the seeds 0, 1, … (default: 1)",
    )
    add(
        "--metric",
        action="append",
        default=[],
        metavar="[NAME=]EXPR",
        help='expression of the final state, or of the run, e.g. path_error or "tilt=highest(abs(roll))" (repeatable)',
    )
    add("--output", "-o", type=Path, metavar="DIR", help="folder of the results (default: sweep-ROBOT)")
    add("--restart", action="store_true", help="discard the runs in the folder instead of continuing the sweep")
    add("--workers", type=int, metavar="N", help="processes on this machine (default: one for each core)")
    add("--scheduler", metavar="ADDRESS", help="simulate on the workers of a Dask scheduler, e.g. tcp://10.0.0.1:8786")
    parser.add_argument("--json", action="store_true", help="print one JSON value")
    parser.epilog = (
        "examples:\n"
        "  urdfkit sim sweep simpleton --for 5 --cmd-vel 0.5,0,0.5 \\\n"
        "      --vary chassis.mass=1:3:5 --metric path_error\n"
        "  urdfkit sim sweep simpleton --for 5 --cmd-vel 0.5,0,0.5 \\\n"
        "      --vary left_wheel.mu=0.2..1 --seeds 20 --metric odometry_error"
    )


@ended_by_signals()
def run(arguments: argparse.Namespace) -> int:
    """Simulate all runs and print the table; exit code 1 if a simulation failed."""
    check_run_options(arguments, "sim sweep")
    from urdfkit.app.sweeps.variations import parse_variation

    vary = dict(parse_variation(text) for text in arguments.vary)
    if len(vary) < len(arguments.vary):
        raise UsageError("--vary has a parameter twice")
    if arguments.workers is not None and arguments.scheduler is not None:
        raise UsageError("--workers is the number of processes on this machine; omit it with --scheduler")
    from urdfkit.app.sweeps.sweep import PACKAGES, sweep

    require_packages("sim sweep", "sweep", PACKAGES)
    from dataclasses import fields

    from urdfkit.app.simulation.kernel_compilation import prepare_kernel
    from urdfkit.description.xml.cost_limit import loading_limit

    prepare_kernel(sys.stderr)
    options = run_options_of(arguments)

    def load(more: Mapping[str, str]) -> Robot:
        with loading_limit():
            return load_robot_of_run(arguments, more)

    with _progress() as progress:
        found = sweep(
            "",
            load=load,
            vary=vary,
            metrics=arguments.metric,
            duration=duration_of(arguments),
            seeds=arguments.seeds,
            world=arguments.world,
            until=arguments.until,
            output=arguments.output,
            restart=arguments.restart,
            workers=arguments.workers,
            scheduler=arguments.scheduler,
            progress=progress,
            **{field.name: getattr(options, field.name) for field in fields(options)},
        )
    print(json.dumps(_as_json(found)) if arguments.json else found.summary())
    if not arguments.quiet:
        message = f"urdfkit: {len(found.rows)} runs in {found.folder}: results.csv, results.parquet and plots"
        print(message, file=sys.stderr)
        if found.failed:
            first = found.failed[0]
            message = f"urdfkit: warning: {len(found.failed)} runs failed; run {first['run']}: {first['error']}"
            print(message, file=sys.stderr)
    return 1 if found.failed else 0


def _as_json(found: Sweep) -> list[dict[str, object]]:
    """Return a row for each run; values that are not finite as null."""
    return [
        {name: None if isinstance(value, float) and not math.isfinite(value) else value for name, value in row.items()}
        for row in found.rows
    ]


@contextmanager
def _progress() -> Iterator[Callable[[int, int], None]]:
    """Show progress and the remaining time on a terminal; yield a function that gets finished and all runs."""
    start, first = time.monotonic(), 0
    with ProgressLine(period=PERIOD) as line:

        def show(finished: int, total: int) -> None:
            nonlocal first
            first = first or finished - 1
            left = (total - finished) * (time.monotonic() - start) / (finished - first)
            line(f"{finished} of {total} runs, {left:.0f} s left")

        yield show
