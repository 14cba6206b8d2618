"""Odometer: wheel odometry that the engine integrates, one per robot."""

from collections.abc import Sequence
from typing import NamedTuple

from urdfkit.linear_algebra import Array
from urdfkit.sim.engine import simulation_memory as memory
from urdfkit.sim.engine.simulation_memory import Arrays
from urdfkit.sim.state.periodic_steps import PeriodicSteps


class Encoder(NamedTuple):
    """Joint whose position odometry measures, and the effect of a change of its position.

    Attributes:
        joint: name of the joint.
        forward: displacement to the front [m/rad].
        left: displacement to the left [m/rad].
        turn: change of heading [1].
        angle: share of its position in the steering angle of a bicycle [1].
    """

    joint: str
    forward: float = 0.0
    left: float = 0.0
    turn: float = 0.0
    angle: float = 0.0


class OdometerReading(NamedTuple):
    """Odometry at its last update.

    Attributes:
        step: step of the update.
        steps: number of steps since the update before.
        positions: positions of the joints at the update [rad] or [m].
        pose: x [m], y [m] and heading [rad].
        moved: displacement since the update before: forward [m], to the left [m], turned [rad].
        distance: length of the displacement [m].
    """

    step: int
    steps: int
    positions: tuple[float, ...]
    pose: tuple[float, float, float]
    moved: tuple[float, float, float]
    distance: float


class Odometer:
    """Odometry of one robot in the engine.

    Args:
        arrays: the engine's arrays.
        tree: number of the robot among the engine's.
    """

    def __init__(self, arrays: Arrays, tree: int) -> None:
        self._ints, self._floats, self._encoders = (arrays[name][tree] for name in ("odometer", "odometry", "encoder"))
        self._s = arrays["s"][slice(*arrays["tree_s"][tree : tree + 2].tolist())]

    @property
    def runs(self) -> bool:
        """Whether odometry is being integrated."""
        return bool(self._ints[0])

    def start(
        self,
        step: int,
        encoders: Sequence[Encoder],
        coordinates: Sequence[int],
        ticks: PeriodicSteps,
        *,
        axles: float,
        follows_arc: bool,
    ) -> None:
        """Start at the origin, heading along x, at the present positions.

        Args:
            step: the present step.
            encoders: the joints, at most `ENCODERS`.
            coordinates: their coordinates among those of the robot in the engine.
            ticks: steps of the updates.
            axles: distance between the axles of a bicycle [m]; zero for other drives.
            follows_arc: follow the exact arc; else the chord at the mid-point heading.
        """
        self._floats[:] = 0.0
        self._floats[memory.PERIOD], self._floats[memory.AXLES] = ticks.steps, axles
        for k, (encoder, at) in enumerate(zip(encoders, coordinates, strict=True)):
            self._encoders[k] = self._s[at], *encoder[1:]
            self._ints[memory.FIRST_COORDINATE + k] = at
        self._ints[0], self._ints[memory.FOLLOWS_ARC] = len(encoders), follows_arc
        self._ints[memory.LAST_UPDATE] = self._ints[memory.BEFORE] = step
        self._ints[memory.NEXT_UPDATE] = ticks.after(step)

    def read(self) -> OdometerReading:
        """Return the odometry at its last update."""
        count, floats = int(self._ints[0]), self._floats.tolist()
        step, before = int(self._ints[memory.LAST_UPDATE]), int(self._ints[memory.BEFORE])
        positions: Array = self._encoders[:count, memory.LAST_POSITION]
        x, y, heading, forward, left, turned = floats[:6]
        return OdometerReading(
            step, step - before, tuple(positions.tolist()), (x, y, heading), (forward, left, turned),
            floats[memory.DISTANCE],
        )  # fmt: skip
