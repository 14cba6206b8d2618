"""What all runs of a sweep share, and one run of it: this is what workers receive and do."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from urdfkit.app.simulation.runs.expression import Expression, state_values
from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.app.sweeps.metrics import Measurement, commanded_path
from urdfkit.app.sweeps.parameters import options_with, robot_with, tune
from urdfkit.app.sweeps.variations import WORLD, XACRO, SweepRun
from urdfkit.description import Robot
from urdfkit.description.sdf import World
from urdfkit.errors import SimulationError
from urdfkit.sim.simulator import Simulator

Arguments = tuple[tuple[str, str], ...]
"""Names and values of xacro arguments."""


@dataclass(frozen=True)
class RunOutcome:
    """Result of a run.

    Attributes:
        number: number of the run.
        metrics: name → value; not a number after an error.
        error: why the simulation ended before its time; empty if it did not.
    """

    number: int
    metrics: Mapping[str, float]
    error: str = ""


@dataclass(frozen=True)
class Scenario:
    """Robots, worlds, options and metrics of a sweep.

    Attributes:
        robots: xacro arguments that vary → the robot.
        worlds: name → world; one without a name if the world does not vary.
        options: options of each run, but for its parameters.
        duration: simulated time [s].
        until: expression at which a run ends early; None without one.
        metrics: name → expression.
    """

    robots: Mapping[Arguments, Robot]
    worlds: Mapping[str, World]
    options: RunOptions
    duration: float
    until: str | None
    metrics: Mapping[str, str]

    def prepared(self, run: SweepRun) -> tuple[Simulator, Measurement]:
        """Return the simulator of a run before its first step, and its measurement.

        Raises:
            UrdfkitError: a parameter or metric is invalid.
        """
        from dataclasses import replace

        options = options_with(replace(self.options, seed=run.seed), run.values)
        robot = robot_with(self.robots[arguments_of(run)], run.values)
        world = self.worlds[str(run.values.get(WORLD, ""))]
        simulator = options.build(robot, world, lambda text: None)
        tune(simulator, run.values)
        options.schedule(simulator)
        path = None if options.command is None else commanded_path(options.command, options.ramp)
        return simulator, Measurement(simulator, dict(self.metrics), path)

    def simulate(self, run: SweepRun) -> RunOutcome:
        """Simulate a run; a simulation that fails is an outcome.

        Raises:
            UrdfkitError: a parameter or metric is invalid.
        """
        simulator, measurement = self.prepared(run)
        try:
            self._advance(simulator)
        except SimulationError as error:
            return RunOutcome(run.number, dict.fromkeys(self.metrics, math.nan), str(error))
        return RunOutcome(run.number, measurement.results())

    def _advance(self, simulator: Simulator) -> None:
        total = round(self.duration / simulator.dt)
        if self.until is None:
            simulator.step(total)
            return
        joints = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
        condition = Expression(self.until, joints)
        while simulator.state.step < total and not condition(simulator.state, state_values(simulator.state)):
            simulator.step()


def arguments_of(run: SweepRun) -> Arguments:
    """Return the xacro arguments of a run."""
    return tuple((name[len(XACRO) :], str(value)) for name, value in run.values.items() if name.startswith(XACRO))
