"""Metrics of a run: expressions of the final state, and of the whole run by `highest`, `lowest` and `mean`."""

import ast
import math
import re
from collections.abc import Callable, Sequence
from typing import Any

from urdfkit.app.simulation.runs.expression import NAMES, Expression, parsed, state_values
from urdfkit.errors import UsageError
from urdfkit.sim.simulator import Simulator

PERIOD = 0.01
"""Simulated time between two samples of `highest`, `lowest` and `mean` [s]."""
PATH, ODOMETRY, KINETIC, POTENTIAL = "path_error", "odometry_error", "kinetic_energy", "potential_energy"
MORE = (PATH, ODOMETRY, KINETIC, POTENTIAL)
"""Names in addition to those of ``--until``."""
OVER_TIME = {"highest": max, "lowest": min, "mean": None}
Planar = tuple[float, float, float]
"""Position x, y [m] and yaw [rad]."""


def parse_metric(text: str) -> tuple[str, str]:
    """Return name and expression of ``EXPR`` or ``NAME=EXPR``.

    Raises:
        UsageError: the expression is not one.
    """
    found = re.fullmatch(r"\s*([A-Za-z_]\w*)\s*=(?!=)(.*)", text, re.DOTALL)
    name, expression = (found[1], found[2]) if found else (text.strip(), text)
    parsed(expression, "--metric")
    return name, expression.strip()


class Metric:
    """One metric of one run.

    Args:
        text: the expression.
        joints: joints that it may name.

    Raises:
        UsageError: the expression is invalid.
    """

    def __init__(self, text: str, joints: Sequence[str]) -> None:
        names = (*NAMES, *MORE)

        def expression(tree: ast.expr, more: Sequence[str] = ()) -> Expression:
            return Expression(tree, joints, option="--metric", names=(*names, *more))

        self._over_time: list[tuple[str, Expression, list[float]]] = []
        tree = parsed(text, "--metric")

        class SampleReplacement(ast.NodeTransformer):
            """Replaces `highest(EXPR)` by a name, whose value is known at the end."""

            def visit_Call(_, node: ast.Call) -> ast.expr:  # noqa: N805
                if isinstance(node.func, ast.Name) and node.func.id in OVER_TIME:
                    if len(node.args) != 1 or node.keywords:
                        raise UsageError(f"--metric: `{ast.unparse(node)}` needs one expression")
                    inner = expression(node.args[0])
                    self._over_time.append((node.func.id, inner, []))
                    return ast.Name(f"_{len(self._over_time)}", ast.Load())
                node.args = [self_visit(each) for each in node.args]
                return node

        replacement = SampleReplacement()
        self_visit = replacement.visit
        outer: ast.expr = self_visit(tree)
        self._names = tuple(f"_{k + 1}" for k in range(len(self._over_time)))
        self._outer = expression(outer, self._names)
        used = {node.id for node in ast.walk(parsed(text, "--metric")) if isinstance(node, ast.Name)}
        self.more = tuple(name for name in MORE if name in used)

    @property
    def is_over_time(self) -> bool:
        """Whether it needs samples during the run."""
        return bool(self._over_time)

    def sample(self, simulator: Simulator, values: dict[str, float]) -> None:
        """Evaluate the expressions of `highest`, `lowest` and `mean` now."""
        for _, inner, samples in self._over_time:
            samples.append(float(inner(simulator.state, values)))

    def result(self, simulator: Simulator, values: dict[str, float]) -> float:
        """Return the value at the end of the run."""
        for (kind, _, samples), name in zip(self._over_time, self._names, strict=True):
            reduce: Any = OVER_TIME[kind]
            values[name] = math.fsum(samples) / len(samples) if reduce is None else reduce(samples)
        return float(self._outer(simulator.state, values))


class Measurement:
    """The metrics of one run.

    Args:
        simulator: in its initial state; samples are scheduled on it.
        metrics: name → expression.
        path: position that the velocity command describes at a time; None without a command.

    Raises:
        UsageError: an expression is invalid, or a value does not exist in this simulation.
    """

    def __init__(
        self, simulator: Simulator, metrics: dict[str, str], path: Callable[[float], Planar] | None = None
    ) -> None:
        joints = (*simulator.kinematics.joint_names, *simulator.kinematics.mimic_names)
        self._metrics = {name: Metric(text, joints) for name, text in metrics.items()}
        self._simulator, self._path = simulator, path
        used = {name for metric in self._metrics.values() for name in metric.more}
        if PATH in used and path is None:
            raise UsageError(f"--metric: {PATH} is the distance to the path of a velocity command: add --cmd-vel")
        if ODOMETRY in used and not simulator.odometry():
            raise UsageError(f"--metric: {ODOMETRY}: robot `{simulator.name}` publishes no odometry")
        self._used = used
        self._start = planar(simulator.state.base_pose)
        self._odometry_start = self._odometry() if ODOMETRY in used else (0.0, 0.0, 0.0)
        self._over_time = [metric for metric in self._metrics.values() if metric.is_over_time]
        if self._over_time:
            simulator.every(PERIOD, self._sample)

    def results(self) -> dict[str, float]:
        """Return name → value at the end of the run."""
        if self._over_time:
            self._sample()
        values = self._values()
        return {name: metric.result(self._simulator, values) for name, metric in self._metrics.items()}

    def _sample(self) -> None:
        values = self._values()
        for metric in self._over_time:
            metric.sample(self._simulator, values)

    def _values(self) -> dict[str, float]:
        simulator = self._simulator
        values = state_values(simulator.state)
        x, y = values["x"], values["y"]
        if PATH in self._used and self._path is not None:
            ideal = after(self._start, self._path(simulator.t))
            values[PATH] = math.hypot(ideal[0] - x, ideal[1] - y)
        if ODOMETRY in self._used:
            moved = after(self._start, between(self._odometry_start, self._odometry()))
            values[ODOMETRY] = math.hypot(moved[0] - x, moved[1] - y)
        if {KINETIC, POTENTIAL} & self._used:
            values[KINETIC], values[POTENTIAL] = simulator.state.energy
        return values

    def _odometry(self) -> Planar:
        position, quaternion = next(iter(self._simulator.odometry().values()))
        return planar((*position, *quaternion))


def planar(pose: Sequence[float]) -> Planar:
    """Return position and yaw of a pose: x y z [m] and quaternion x y z w."""
    x, y, z, w = pose[3:7]
    return pose[0], pose[1], math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))


def after(first: Planar, second: Planar) -> Planar:
    """Return the pose `second`, which is relative to `first`, in the frame of `first`."""
    c, s = math.cos(first[2]), math.sin(first[2])
    return first[0] + c * second[0] - s * second[1], first[1] + s * second[0] + c * second[1], first[2] + second[2]


def between(first: Planar, second: Planar) -> Planar:
    """Return the pose `second` relative to `first`."""
    c, s = math.cos(first[2]), math.sin(first[2])
    x, y = second[0] - first[0], second[1] - first[1]
    return c * x + s * y, -s * x + c * y, second[2] - first[2]


def commanded_path(command: Planar, ramp: float) -> Callable[[float], Planar]:
    """Return the pose of a base that moves exactly at a velocity command which increases linearly from zero.

    Args:
        command: VX, VY [m/s], WZ [rad/s].
        ramp: duration of the increase [s].
    """
    vx, vy, wz = command

    def pose(t: float) -> Planar:
        # Speed and turning rate increase together, so the path is an arc, of which `passed` seconds are covered.
        passed = 0.5 * t * t / ramp if t < ramp else t - 0.5 * ramp
        turn = wz * passed
        if abs(turn) < 1e-9:
            return vx * passed, vy * passed, turn
        along, across = math.sin(turn) / wz, (1.0 - math.cos(turn)) / wz
        return vx * along - vy * across, vx * across + vy * along, turn

    return pose
