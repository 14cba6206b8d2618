"""sweep: simulate a robot with many combinations of parameters."""

import hashlib
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from urdfkit import __version__
from urdfkit.app.page import require_packages
from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.app.sweeps.execution import execute
from urdfkit.app.sweeps.journal import Journal
from urdfkit.app.sweeps.metrics import parse_metric
from urdfkit.app.sweeps.parameters import require_valid_names
from urdfkit.app.sweeps.plots import write_plots
from urdfkit.app.sweeps.results import Sweep, tabulate
from urdfkit.app.sweeps.scenario import Scenario, arguments_of
from urdfkit.app.sweeps.variations import WORLD, Interval, Variation, combine, parse_variation, variation
from urdfkit.description import Robot
from urdfkit.description.sdf import World
from urdfkit.errors import UsageError

PACKAGES = {"distributed": "distributed", "pyarrow": "pyarrow", "matplotlib": "matplotlib", "numba": "numba"}
"""Module → package."""


def sweep(
    robot: Robot | str | Path,
    *,
    vary: Mapping[str, Variation | Sequence[Any] | str],
    metrics: Sequence[str],
    duration: float,
    seeds: int = 1,
    world: World | str | Path = "empty",
    arguments: Mapping[str, str] | None = None,
    until: str | None = None,
    output: str | Path | None = None,
    restart: bool = False,
    workers: int | None = None,
    scheduler: str | None = None,
    progress: Callable[[int, int], None] | None = None,
    load: Callable[[Mapping[str, str]], Robot] | None = None,
    **options: Any,
) -> Sweep:
    """Simulate a robot with every combination of parameters, as ``urdfkit sim sweep`` does.

    A sweep that ended early continues if it is called again. In a script, call it below ``if __name__ == "__main__":``,
    because each worker process imports the script; with one worker this is not necessary.

    Args:
        robot: a file, a package folder, the name of a bundled robot, or a loaded robot.
        vary: parameter → its values, an `Interval` from which each seed draws a value, or both as text:
            ``1:3:9``, ``0.2,0.5`` or ``0.2..0.5``.
        metrics: expressions, such as ``path_error`` or ``tilt = highest(abs(roll))``.
        duration: simulated time of a run [s].
        seeds: number of runs with each combination of parameters; their seeds are 0, 1, …
        world: a world, the name of a bundled world, or an SDF file.
        arguments: xacro arguments.
        until: expression at which a run ends early.
        output: folder of the results; ``sweep-ROBOT`` when None.
        restart: discard the runs in the folder.
        workers: number of processes; one for each processor core when None.
        scheduler: address of a Dask scheduler whose workers simulate, such as ``tcp://10.0.0.1:8786``.
        progress: called with the numbers of finished and of all runs.
        load: loads the robot with further xacro arguments, in place of `robot` and `arguments`.
        options: see `RunOptions`: ``dt``, ``spawn``, ``gravity``, ``command``, ``ramp``, ``joint_targets``, …

    Returns:
        The results; also written to the folder as ``results.csv``, ``results.parquet`` and a plot for each metric.

    Raises:
        MissingDependencyError: the extra ``sweep`` is not installed.
        UsageError: a parameter, metric or option is invalid, or the folder has another sweep.
        UrdfkitError: the robot or the world cannot be loaded or simulated.

    Examples:
        >>> import urdfkit
        >>> results = urdfkit.sweep(
        ...     "simpleton", vary={"cmd.vx": "0.2,0.5"}, metrics=["x"], duration=0.5, output="results", workers=1
        ... )
        >>> [row["cmd.vx"] for row in results.rows]
        [0.2, 0.5]
    """
    require_packages("sweep", "sweep", PACKAGES)
    from urdfkit.description.loading import load_repaired

    checked = {name: _checked(name, values) for name, values in vary.items()}
    require_valid_names(checked)
    expressions = dict(parse_metric(text) for text in metrics)
    if not expressions:
        raise UsageError("a sweep needs a metric, such as --metric path_error or --metric x")
    if workers is not None and workers < 1:
        raise UsageError(f"invalid number of workers {workers}; use 1 or more")
    runs = combine(checked, seeds)
    own = dict(arguments or {})
    found = load or (lambda more: load_repaired(robot, arguments={**own, **more}))
    robots = {xacro: found(dict(xacro)) for xacro in dict.fromkeys(map(arguments_of, runs))}
    names = dict.fromkeys(str(run.values.get(WORLD, "")) for run in runs)
    scenario = Scenario(
        robots, {name: _world(name or world) for name in names}, RunOptions(**options), duration, until, expressions
    )
    scenario.prepared(runs[0])  # raises for names that this robot does not have, before workers start
    first = next(iter(robots.values()))
    folder = Path(output if output is not None else f"sweep-{first.name or 'robot'}")
    with Journal(folder, _definition(scenario, checked, seeds), restart=restart) as journal:
        left = [run for run in runs if run.number not in journal.outcomes]
        for outcome in execute(scenario, left, workers=workers or _cores(), scheduler=scheduler):
            journal.add(outcome)
            if progress is not None:
                progress(len(journal.outcomes), len(runs))
    results = tabulate(runs, journal.outcomes, expressions, folder)
    results.write()
    write_plots(results)
    return results


def _world(world: World | str | Path) -> World:
    from urdfkit.description.sdf import load_world

    return world if isinstance(world, World) else load_world(world)


def _checked(name: str, values: Variation | Sequence[Any] | str) -> Variation:
    return parse_variation(f"{name}={values}")[1] if isinstance(values, str) else variation(name, values)


def _definition(scenario: Scenario, vary: Mapping[str, Variation], seeds: int) -> dict[str, Any]:
    """Return the values that determine the results, by the names of the options."""
    digest = hashlib.sha256()
    for robot in scenario.robots.values():
        for file in robot.files:
            digest.update(file.read_bytes())
    for controllers in scenario.options.controllers:
        digest.update(Path(controllers).read_bytes())
    return {
        "version": __version__,
        "robot": digest.hexdigest(),
        "world": {name: hashlib.sha256(repr(world).encode()).hexdigest() for name, world in scenario.worlds.items()},
        "options": repr(scenario.options),
        "duration": scenario.duration,
        "until": scenario.until,
        "vary": {
            name: {"low": each.low, "high": each.high} if isinstance(each, Interval) else list(each)
            for name, each in vary.items()
        },
        "seeds": seeds,
        "metrics": dict(scenario.metrics),
    }


def _cores() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
