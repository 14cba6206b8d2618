"""Loop of a simulation driven from the page: execute requests, advance to the current time, publish the poses."""

import math
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import cached_property
from threading import Event
from typing import Any

from numpy.typing import NDArray

from urdfkit.app.page import note
from urdfkit.app.repair_findings import with_repairs
from urdfkit.app.simulation.bridging.action_requests import SimulationActions, action_requests
from urdfkit.app.simulation.bridging.service_requests import SimulationServices, service_requests
from urdfkit.app.simulation.bridging.services import simulation_services
from urdfkit.app.simulation.clock_rate import FRAME, ClockRate
from urdfkit.app.simulation.displays.displays import Displays
from urdfkit.app.simulation.displays.world_appearance import WorldLights, WorldPlanes
from urdfkit.app.simulation.features.contact_forces import ContactForces
from urdfkit.app.simulation.features.feature import Done, Feature
from urdfkit.app.simulation.features.joint_sliders import JointSliders
from urdfkit.app.simulation.features.live_parameters import LiveParameters
from urdfkit.app.simulation.features.playback import Playback
from urdfkit.app.simulation.features.plots import Plots
from urdfkit.app.simulation.features.pushing import Pushing
from urdfkit.app.simulation.features.replay import Replay
from urdfkit.app.simulation.features.robot_panels import RobotPanels
from urdfkit.app.simulation.features.sensor_views import SensorViews
from urdfkit.app.simulation.features.teleop import command, command_topics, drive_controls
from urdfkit.app.simulation.features.topic_panel import TopicPanel
from urdfkit.app.simulation.features.topic_stream import TopicStreams
from urdfkit.app.simulation.features.world_objects import WorldObjects
from urdfkit.app.simulation.scene_bodies import SceneBodies
from urdfkit.bridges.bridge import Bridges
from urdfkit.bridges.service import Service
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.sim.simulator import Simulator
from urdfkit.sim.state.quaternion import yaw_of
from urdfkit.teleop import STOP, Motion, Teleop
from urdfkit.view.protocol.page_requests import Request, Schema
from urdfkit.view.server.server import Server

SERVED = 0.002
"""Longest pause of the simulation while a bridge is open [s]."""
PROMPT = 0.01
"""Time after a call of a peer in which each step is taken when it is due: its effect is published at once [s]."""
STATUS = 0.1
"""Seconds between two status messages to the page."""
PATIENCE = 0.05
"""Seconds per iteration for requests; remaining requests are executed in the next iteration."""
FEATURES: tuple[type[Feature], ...] = (
    Playback,
    TopicPanel,
    TopicStreams,
    Plots,
    WorldObjects,
    WorldLights,
    WorldPlanes,
    JointSliders,
    LiveParameters,
    Pushing,
    ContactForces,
    Replay,
    RobotPanels,
    Displays,
)
"""Features of the page; a test fails if one is missing here."""


class DriveLoop:
    """Loop of a simulation that is driven from the page.

    Args:
        simulator: advanced by `run`, in the thread that calls it.
        server: the page.
        clock: wall clock [s].
        sleep: function that waits for a number of seconds.

    Attributes:
        lint: findings of the linter, as the page shows them.
        look: function that is called in every iteration, for a recording and the keys of a terminal.
        report: function that prints a warning.
        sensor_views: views of the sensors.
        pace: ratio of simulated time to the clock.
        features: features of the page.
        bridges: bridges whose peers are served between two steps.
        kernels: context in which the loop runs, see `LiveKernels.used`.
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
        self._requests: deque[Request] = deque()
        self._reported = self._prompt_until = -math.inf
        self._warnings: list[str] = []
        self.report, simulator.note.report = simulator.note.report, self._warn
        self.look: Callable[[], None] = lambda: None  # subscribes a recording to new topics
        self.lint: Mapping[str, Any] = {"findings": [], "rules": {}, "fault": None}
        self.bridges = Bridges()
        self.kernels: Callable[[], AbstractContextManager[None]] = nullcontext
        self.pace = ClockRate(simulator.dt, clock)
        self.sensor_views = SensorViews(simulator, server, clock)
        self.scene_bodies = SceneBodies(simulator, server)
        self.features: tuple[Feature, ...] = tuple(part(simulator, server, clock) for part in FEATURES)
        self.replay = next(part for part in self.features if isinstance(part, Replay))
        self.robot_panels = next(part for part in self.features if isinstance(part, RobotPanels))
        self._takes: dict[str, tuple[Schema, Callable[[Request], Done]]] = {}
        for part in self.features:
            if isinstance(part, Playback):
                part.pace = self.pace
            self._takes.update(part.takes)
        self._takes.update(service_requests(SimulationServices(lambda: self.services)))
        self._takes.update(action_requests(SimulationActions(simulator.bus)))
        server.requests.update({name: schema for name, (schema, _) in self._takes.items()})

    @cached_property
    def services(self) -> Mapping[str, Service]:
        """Services of the simulation by name."""
        return simulation_services(self.simulator, self)

    def add_request(self, name: str, schema: Schema, handler: Callable[[Request], Done]) -> None:
        """Accept another request of the page; `handler` returns the values of the answer."""
        self._takes[name] = schema, handler
        self.server.requests[name] = schema

    def show(self) -> None:
        """Show robots and bodies on the page, and publish the controls of all features."""
        self.scene_bodies.show()
        self.server.publish_latched("teleop", **drive_controls(self.simulator))
        for part in self.features:
            part.show()
        self.server.publish_latched("findings", **self.findings())
        self.server.publish(self.simulator.t, self.scene_bodies.poses())

    def findings(self) -> dict[str, Any]:
        """Return the findings of the linter with the repairs, for the page."""
        rows = [dict(row) for row in self.lint["findings"]]
        number = max((row["number"] for row in rows), default=0) + 1
        return {**self.lint, "findings": with_repairs(rows, self.simulator.repairs, first=number)}

    def run(self, stop: Event | None = None) -> None:
        """Simulate until an exception is raised.

        Args:
            stop: ends the loop when it is set.
        """
        stop = stop or Event()
        self.pace.begin(self.simulator.t)
        due = self._clock()
        try:
            with self.kernels():
                while not stop.is_set():
                    self.tick()
                    due += FRAME
                    if due > self._clock():
                        self._rest(due)
                    else:
                        due = self._clock()
        finally:
            self.replay.close()

    def _rest(self, due: float) -> None:
        """Wait until the next iteration is due; serve the peers of bridges meanwhile."""
        while (wait := due - (now := self._clock())) > 0:
            if not self.bridges:
                self._sleep(wait)
                continue
            is_prompt = now < self._prompt_until and self._is_running
            if self.bridges.calls.wait(min(wait, self.pace.wait(self.simulator.t) if is_prompt else SERVED)):
                self._prompt_until = self._clock() + PROMPT
            self.bridges.take()
            if self._is_running:
                self._physics()

    @property
    def _is_running(self) -> bool:
        return not self.replay.playing and not self.simulator.paused

    def tick(self) -> None:
        """Run one iteration: requests, drive commands, physics, poses."""
        self.bridges.take()
        inputs = self.server.inbox.take()
        for action in inputs.actions:
            self._act(action)
        if inputs.joints and self.simulator.paused and not self._failed:
            self.robot_panels.move(inputs.joints)
        self._requests.extend(inputs.requests)
        begin = self._clock()
        while self._requests and self._clock() - begin <= PATIENCE:
            self._do(self._requests.popleft())
        if not self.replay.playing:
            self._drive()
            if not self.simulator.paused:
                self._physics()
        self.look()
        self._report()

    def reset(self) -> None:
        """Reset the simulation, as the button does."""
        self._act("reset")

    def pause(self, paused: bool) -> None:
        """Pause or continue, as the buttons do."""
        self._act("pause" if paused else "play")

    def _act(self, action: str) -> None:
        simulator = self.simulator
        if action == "reset":
            simulator.reset()
            simulator.paused = self._failed = False
            self.server.publish_latched("fault", message=None)
            for part in self.features:
                part.forget()
            self.show()
        elif action == "stop":
            self.stop()
            return
        else:
            simulator.paused = action == "pause" or self._failed
        self.pace.restart(simulator.t)

    def stop(self) -> None:
        """Send zero velocity to every drive, whichever page drives, and release the controls of all pages."""
        self.server.drive_lock.release()
        self.server.broadcast("stop")
        self._driven = ""
        for name, robot in self.simulator.world.robots.items():
            if command_topics(robot):
                self._command(name, STOP)

    def _do(self, request: Request) -> None:
        if self._failed:  # its state is NaN
            self.server.answer(request, "the simulation has diverged; press Reset")
            return
        self._warnings.clear()
        try:
            values = self._takes[request.name][1](request)
        except (UrdfkitError, OSError) as error:
            self.server.answer(request, str(error))
        else:
            answer: dict[str, Any] = dict(values or {})
            if self._warnings:
                answer["warnings"] = list(self._warnings)
            self.server.answer(request, **answer)
        # A repeated request gets the same warnings again.
        self.simulator.note.forget(self._warnings)
        self._warnings.clear()

    def _warn(self, text: str) -> None:
        """Print a warning in the terminal and show it on the page."""
        self.report(text)
        self._warnings.append(text)
        self.server.broadcast("notice", text=text, tone="warning")

    def _fail(self, error: SimulationError) -> None:
        self.simulator.paused = self._failed = True
        note(f"urdfkit: {error}")
        self.server.publish_latched("fault", message=f"{error}; press Reset")

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

    def _drive(self) -> None:
        """Publish the command of the driver; zero once when the driver releases the controls."""
        held, robots = self.server.drive_lock.axes, self.simulator.world.robots
        driven, motion = "", None
        if held is not None:
            x, y, z, turn = held.axes
            driven = held.robot or self.simulator.name
            motion = Teleop(speed=held.speed, turn=held.turn).axes(x, turn, y, z)
        if motion is None:
            driven = ""
        if self._driven and self._driven != driven:
            self._command(self._driven, STOP)
        self._driven = ""
        if motion is not None and driven in robots and command_topics(robots[driven]):
            self._command(driven, motion)
            self._driven = driven

    def _command(self, name: str, motion: Motion) -> None:
        if name in self.simulator.world.robots:
            command(self.simulator, self.simulator.world.robots[name], *motion)

    def _report(self) -> None:
        simulator, now = self.simulator, self._clock()
        if self._failed:
            return
        if simulator.world.revision != self.scene_bodies.revision:  # an entity was spawned or removed
            self.show()
        poses = self.scene_bodies.poses()
        if self.replay.playing:
            t, shown = self.replay.picture()
            self.server.publish(t, shown)
        else:
            self.server.publish(simulator.t, poses)
            self.replay.keep(simulator.t, poses, simulator.world.revision)
        self.pace.looked = self.sensor_views.show()
        for part in self.features:
            part.tick()
        if now - self._reported >= STATUS:
            self._reported = now
            self.pace.mark(simulator.t)
            self.server.broadcast("status", **self._status(poses))

    def _status(self, poses: NDArray[Any]) -> dict[str, Any]:
        simulator, factor = self.simulator, self.pace.factor
        robots = {}
        for name, robot in simulator.world.robots.items():
            if robot.has_plugins or name == simulator.name:
                velocity = robot.state.base_twist
                robots[name] = {**_pose(robot.state.base_pose), "speed": velocity[0], "turn": velocity[5]}
        return {
            "time": simulator.t,
            "paused": simulator.paused,
            "real_time_factor": self.pace.real_time_factor,
            "factor": None if factor == math.inf else factor,
            "dt": simulator.dt,
            "pose": _pose(poses[self.scene_bodies.root]),
            "speed": float(simulator.state.v[0]) if simulator.kinematics.floating_base else 0.0,
            "fixed": not simulator.kinematics.floating_base,
            "tip": self.scene_bodies.tip,
            "robots": robots,
            "odometry": {frame: [*pose[:2], yaw_of(turn)] for frame, (pose, turn) in simulator.odometry().items()},
            "driver": self.server.drive_lock.holder,
            "watchers": self.server.hub.watchers,
        }


def _pose(pose: Sequence[float]) -> dict[str, float]:
    return {"x": float(pose[0]), "y": float(pose[1]), "yaw": yaw_of(pose[3:])}
