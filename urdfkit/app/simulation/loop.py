"""Ride: the loop of a simulation that is driven: do what pages order, advance to now, show where everything is."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from urdfkit.app.page import note
from urdfkit.app.simulation.clock_rate import FRAME, Pace
from urdfkit.app.simulation.features.contact_forces import Forces
from urdfkit.app.simulation.features.feature import Part
from urdfkit.app.simulation.features.joint_sliders import Arms
from urdfkit.app.simulation.features.live_parameters import Screws
from urdfkit.app.simulation.features.playback import Transport
from urdfkit.app.simulation.features.plots import Curves
from urdfkit.app.simulation.features.pushing import Hands
from urdfkit.app.simulation.features.replay import Tape
from urdfkit.app.simulation.features.sensor_views import Sights
from urdfkit.app.simulation.features.teleop import command, command_topics, wheel
from urdfkit.app.simulation.features.topic_panel import Topics
from urdfkit.app.simulation.features.topic_stream import Listening
from urdfkit.app.simulation.features.world_objects import Objects
from urdfkit.app.simulation.scene_bodies import Figures
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.teleop import STOP, Motion, Teleop

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from urdfkit.app.simulation.features.feature import Done
    from urdfkit.sim.simulator import Simulator
    from urdfkit.view.protocol.page_requests import Order, Schema
    from urdfkit.view.server.server import Server

STATUS = 0.1
"""Seconds between status lines on the page."""
PATIENCE = 0.05
"""Seconds of a round that orders may take; what is left is done in the next."""
PARTS: tuple[type[Part], ...] = (Transport, Topics, Listening, Curves, Objects, Arms, Screws, Hands, Forces, Tape)
"""What the page can do beside driving; a test fails if one is missing here."""


class Ride:
    """The loop.

    Args:
        simulator: advanced by `run`, in the thread that calls it.
        server: the page.
        clock: wall clock [s].
        sleep: waits for so many seconds.

    Attributes:
        look: is called in every round.
        sights: what sensors see.
        pace: how simulated time keeps up with the clock.
        parts: what the page can do beside driving.
    """

    def __init__(
        self,
        simulator: Simulator,
        server: Server,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self.simulator, self.server = simulator, server
        self._clock, self._sleep = clock, sleep
        self._driven = ""
        self._failed = False
        self._orders: deque[Order] = deque()
        self._reported = -math.inf
        self._remarks: list[str] = []
        self._log, simulator._note = simulator._note, self._remark
        self.look: Callable[[], None] = lambda: None  # for topics that have come up, where there is a recording
        self.pace = Pace(simulator.dt, clock)
        self.sights = Sights(simulator, server, clock)
        self.figures = Figures(simulator, server)
        self.parts: tuple[Part, ...] = tuple(part(simulator, server, clock) for part in PARTS)
        self.tape = next(part for part in self.parts if isinstance(part, Tape))
        self._takes: dict[str, tuple[Schema, Callable[[Order], Done]]] = {}
        for part in self.parts:
            if isinstance(part, Transport):
                part.pace = self.pace
            self._takes.update(part.takes)
        server.orders.update({name: schema for name, (schema, _) in self._takes.items()})

    def show(self) -> None:
        """Put everything on the page, where it is, and tell what can be done."""
        self.figures.show()
        self.server.declare("teleop", **wheel(self.simulator))
        for part in self.parts:
            part.show()
        self.server.publish(self.simulator.t, self.figures.poses())

    def run(self) -> None:
        """Simulate for ever."""
        self.pace.begin(self.simulator.t)
        due = self._clock()
        try:
            while True:
                self.tick()
                due += FRAME
                if (wait := due - self._clock()) > 0:
                    self._sleep(wait)
                else:
                    due = self._clock()
        finally:
            self.tape.close()

    def tick(self) -> None:
        """Do one round: wishes, wheel, physics, picture."""
        wishes = self.server.inbox.take()
        for action in wishes.actions:
            self._act(action)
        self._orders.extend(wishes.orders)
        begin = self._clock()
        while self._orders and self._clock() - begin <= PATIENCE:
            self._do(self._orders.popleft())
        if not self.tape.playing:
            self._steer()
            if not self.simulator.paused:
                self._physics()
        self.look()
        self._report()

    def _act(self, action: str) -> None:
        simulator = self.simulator
        if action == "reset":
            simulator.reset()
            simulator.paused = self._failed = False
            self.server.declare("fault", message=None)
            for part in self.parts:
                part.forget()
            self.show()
        elif action == "stop":
            self._stop()
            return
        else:
            simulator.paused = action == "pause" or self._failed
        self.pace.restart(simulator.t)

    def _stop(self) -> None:
        """Send zero to everything that drives, whoever gave the last command, and take the wheel out of all hands."""
        self.server.driver.stop()
        self.server.tell("stop")
        self._driven = ""
        for name, robot in self.simulator.robots.items():
            if command_topics(robot):
                self._tell(name, STOP)

    def _do(self, order: Order) -> None:
        if self._failed:  # nothing in it is a number any more
            self.server.answer(order, "the simulation has diverged; Reset starts again")
            return
        self._remarks.clear()
        try:
            found = self._takes[order.name][1](order)
        except (UrdfkitError, OSError) as error:
            self.server.answer(order, str(error))
        else:
            answer: dict[str, Any] = dict(found or {})
            if self._remarks:
                answer["remarks"] = list(self._remarks)
            self.server.answer(order, **answer)
        # Who orders the same again is told the same again.
        self.simulator._noted.difference_update(self._remarks)
        self._remarks.clear()

    def _remark(self, text: str) -> None:
        """Say in the terminal, and on the page, what the user should know."""
        self._log(text)
        self._remarks.append(text)
        self.server.tell("notice", text=text, tone="warning")

    def _fail(self, error: SimulationError) -> None:
        self.simulator.paused = self._failed = True
        note(f"urdfkit: {error}")
        self.server.declare("fault", message=f"{error}; Reset starts again")

    def _physics(self) -> None:
        simulator, pace = self.simulator, self.pace
        steps = pace.steps(simulator.t)
        begin = self._clock()
        try:
            if steps > 0:
                simulator.step(steps)
        except SimulationError as error:
            self._fail(error)
        pace.took(steps, self._clock() - begin, simulator.t)

    def _steer(self) -> None:
        """Publish what the driver holds; once zero when nobody holds anything any more."""
        held, robots = self.server.driver.axes, self.simulator.robots
        driven, motion = "", None
        if held is not None:
            x, y, z, turn = held.axes
            driven = held.robot or self.simulator.name
            motion = Teleop(speed=held.speed, turn=held.turn).axes(x, turn, y, z)
        if motion is None:
            driven = ""
        if self._driven and self._driven != driven:
            self._tell(self._driven, STOP)
        self._driven = ""
        if motion is not None and driven in robots and command_topics(robots[driven]):
            self._tell(driven, motion)
            self._driven = driven

    def _tell(self, name: str, motion: Motion) -> None:
        if name in self.simulator.robots:
            command(self.simulator, self.simulator.robots[name], *motion)

    def _report(self) -> None:
        simulator, now = self.simulator, self._clock()
        if self._failed:
            return
        if simulator.revision != self.figures.revision:  # something came or went
            self.show()
        poses = self.figures.poses()
        if self.tape.playing:
            t, shown = self.tape.picture()
            self.server.publish(t, shown)
        else:
            self.server.publish(simulator.t, poses)
            self.tape.keep(simulator.t, poses, simulator.revision)
        self.pace.looked = self.sights.show()
        for part in self.parts:
            part.tick()
        if now - self._reported >= STATUS:
            self._reported = now
            self.pace.mark(simulator.t)
            self.server.tell("status", **self._status(poses))

    def _status(self, poses: NDArray[Any]) -> dict[str, Any]:
        simulator, factor = self.simulator, self.pace.factor
        robots = {}
        for name, robot in simulator.robots.items():
            if robot.has_plugins or name == simulator.name:
                velocity = robot.state.base_twist
                robots[name] = {**_pose(robot.state.base_pose), "speed": velocity[0], "turn": velocity[5]}
        return {
            "time": simulator.t,
            "paused": simulator.paused,
            "real_time_factor": self.pace.real_time_factor,
            "factor": None if factor == math.inf else factor,
            "dt": simulator.dt,
            "pose": _pose(poses[self.figures.root]),
            "speed": float(simulator.state.v[0]) if simulator.kinematics.floating_base else 0.0,
            "fixed": not simulator.kinematics.floating_base,
            "tip": self.figures.tip,
            "robots": robots,
            "odometry": {frame: [*pose[:2], _yaw(turn)] for frame, (pose, turn) in simulator.odometry().items()},
            "driver": self.server.driver.holder,
            "watchers": self.server.hub.watchers,
        }


def _pose(pose: Sequence[float]) -> dict[str, float]:
    return {"x": float(pose[0]), "y": float(pose[1]), "yaw": _yaw(pose[3:])}


def _yaw(quaternion: Sequence[float]) -> float:
    x, y, z, w = quaternion
    return math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
