"""`urdfkit sim teleop`: simulate a robot in real time and drive it in the browser."""

from __future__ import annotations

import argparse
import math
import time
from collections import deque
from typing import TYPE_CHECKING, Any

from urdfkit.cli.page import Page, add_page_options, note, require_page, until_interrupted
from urdfkit.cli.parser import add_model
from urdfkit.cli.sim.compiling import compile_kernel, compile_rays
from urdfkit.cli.sim.controllers import add_controllers
from urdfkit.cli.sim.distro import add_distro
from urdfkit.cli.sim.recording import add_record, recording
from urdfkit.cli.sim.renderer import add_renderer
from urdfkit.cli.unused import note_unused
from urdfkit.errors import SimulationError

if TYPE_CHECKING:
    from collections.abc import Callable

    from urdfkit.sim.simulator import Simulator
    from urdfkit.view.server import Server

FRAME = 1 / 60
"""Seconds between looks at the driver and pose frames."""
BEHIND = 0.1
"""Seconds the simulation may lag behind the clock before it gives up catching up."""
STATUS = 0.1
"""Seconds between status lines on the page."""
KEYS = """\
Drive with W A S D, the arrows, i j k l u o m , . or the pad; let go and the robot stops.
Shift strafes; q/z change both speeds by 10 %, e/c the turning speed. Ctrl-C ends."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_model(parser)
    parser.add_argument(
        "--world",
        default="empty",
        metavar="WORLD",
        help="a world we ship (empty, void, house, …) or an SDF file (default: empty)",
    )
    add_distro(parser)
    add_controllers(parser)
    add_renderer(parser)
    add_record(parser)
    add_page_options(parser)
    parser.epilog = "examples:\n  urdfkit sim teleop simpleton\n  urdfkit sim teleop simpleton --port 8080 --no-browser"


def run(arguments: argparse.Namespace) -> int:
    """Simulate and serve until interrupted."""
    require_page("sim teleop", "sim", beside=("numba", "rosbags"))
    from urdfkit.description import load
    from urdfkit.resources import find_model
    from urdfkit.sim import Simulator
    from urdfkit.view.server import Server

    with until_interrupted():
        model = find_model(arguments.model, package_path=arguments.package_path)
        robot = load(model.path, arguments=model.arguments, package_path=model.package_path)
        note_unused(model.arguments, robot.files, quiet=arguments.quiet)
        server = Server("sim", host=arguments.host, port=arguments.port)
        page = Page(server, host=arguments.host, browser=not arguments.no_browser)
        try:
            compile_kernel(server, page.open)
            simulator = Simulator(
                robot,
                world=arguments.world,
                ros_distro=arguments.ros_distro,
                controllers=arguments.controllers,
                renderer=arguments.renderer,
                note=lambda text: note(f"urdfkit: {text}"),
            )
            ride = Ride(simulator, server)
            if ride.sights.find():
                compile_rays(server, page.open)
                ride.sights.prepare()
            ride.show()
            page.open()
            with recording(simulator, arguments.record) as ride.look:
                note(KEYS if simulator.command_topics else "this robot has no drive that takes velocity commands")
                ride.run()
        finally:
            server.stop()
    return 0


def wheel(simulator: Simulator) -> dict[str, Any]:
    """Return what the page needs to drive: whether anything listens to commands, key tables and first speeds."""
    from urdfkit.teleop import HELD_LAYOUT, HELD_SPEEDS, Teleop

    start = Teleop()
    return {
        "drives": bool(simulator.command_topics),
        "moves": HELD_LAYOUT,
        "factors": HELD_SPEEDS,
        "speed": start.speed,
        "turn": start.turn,
    }


class Ride:
    """The loop of a simulation that is driven: look at the driver, advance to now, show where everything is.

    Args:
        simulator: advanced by `run`, in the thread that calls it.
        server: the page.
        clock: wall clock [s].
        sleep: waits for so many seconds.
    """

    def __init__(
        self,
        simulator: Simulator,
        server: Server,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        from urdfkit.cli.sim.sights import Sights

        self.simulator = simulator
        self.server = server
        self._clock = clock
        self._sleep = sleep
        self._moving = False
        self._start = (0.0, 0.0)
        self._step_cost = 0.0
        self._reported = -math.inf
        self._marks: deque[tuple[float, float]] = deque(maxlen=round(1 / STATUS))
        kinematics = simulator.kinematics
        self._root = kinematics.link_names.index(kinematics.root)
        self.look: Callable[[], None] = lambda: None  # for topics that have come up, where there is a recording
        self._drawn: tuple[str, ...] = ()
        self._revision = -1
        self.sights = Sights(simulator, server, clock)
        self._looked = 0.0

    def show(self) -> None:
        """Put the robot and what else the world holds on the page, where they are."""
        from dataclasses import replace

        from urdfkit.scene import Scene
        from urdfkit.view.nodes import draw, link_path

        simulator = self.simulator
        self._drawn, self._revision = tuple(simulator.body_poses()), simulator.revision
        # No link has a slash where a body of the world has its first.
        bodies = (*simulator.kinematics.link_names, *(f"world/{name}" for name in self._drawn))
        looks = (replace(shape, body=f"world/{shape.body}") for shape in simulator.looks())
        scene = Scene(bodies, (*simulator.scene.shapes, *looks))
        self.server.show(
            name=simulator.name,
            nodes=[link_path(name) for name in bodies],
            root=self._root,
            draw=lambda server: draw(scene, server, server.geometries),
        )
        self.server.declare("teleop", **wheel(simulator))
        self.server.publish(simulator.t, self._poses())

    def _poses(self) -> Any:
        """Return where everything on the page is; shape (bodies, 7), the robot's links first."""
        import numpy as np

        poses = self.simulator.link_poses()
        if not self._drawn:
            return poses
        others = self.simulator.body_poses()
        return np.vstack([poses, np.array([others[name] for name in self._drawn])])

    def run(self) -> None:
        """Simulate in real time for ever."""
        self._keep_pace_from_here()
        due = self._clock()
        while True:
            self.tick()
            due += FRAME
            if (wait := due - self._clock()) > 0:
                self._sleep(wait)
            else:
                due = self._clock()

    def tick(self) -> None:
        """Do one round: wishes, wheel, physics, picture."""
        for action in self.server.inbox.take().actions:
            self._act(action)
        self._steer()
        if not self.simulator.paused:
            try:
                self._advance()
            except SimulationError as error:
                self.simulator.paused = True
                note(f"urdfkit: {error}")
                self.server.declare("fault", message=f"{error}; Reset starts again")
        self.look()
        self._report()

    def _act(self, action: str) -> None:
        if action == "reset":
            self.simulator.reset()
            self.simulator.paused = False
            self.server.declare("fault", message=None)
        else:
            self.simulator.paused = action == "pause"
        self._marks.clear()
        self._keep_pace_from_here()

    def _steer(self) -> None:
        """Publish what the driver holds; once zero when nobody holds anything any more."""
        from urdfkit.teleop import STOP, Teleop

        if not self.simulator.command_topics:
            return
        held = self.server.driver.axes
        motion = None
        if held is not None:
            x, y, z, turn = held.axes
            motion = Teleop(speed=held.speed, turn=held.turn).axes(x, turn, y, z)
        if motion is not None:
            self.simulator.command(*motion)
        elif self._moving:
            self.simulator.command(*STOP)
        self._moving = motion is not None

    def _advance(self) -> None:
        """Bring simulated time up to the clock; where that takes too long, let the clock go."""
        wall, t = self._start
        simulator = self.simulator
        behind = self._clock() - wall - (simulator.t - t)
        limit = BEHIND + self._looked  # what sensors see took its time, which the simulation can make up for
        steps = round(min(behind, limit) / simulator.dt)
        if self._step_cost > 0:
            steps = min(steps, max(1, round(BEHIND / self._step_cost)))
        if steps > 0:
            begin = self._clock()
            simulator.step(steps)
            self._step_cost = (self._clock() - begin) / steps
        if behind > limit:
            self._keep_pace_from_here()

    def _keep_pace_from_here(self) -> None:
        self._start = self._clock(), self.simulator.t

    def _report(self) -> None:
        simulator, now = self.simulator, self._clock()
        if simulator.revision != self._revision:  # something came or went
            self.show()
        poses = self._poses()
        self.server.publish(simulator.t, poses)
        self._looked = self.sights.show()
        if now - self._reported < STATUS:
            return
        self._reported = now
        self._marks.append((now, simulator.t))
        (wall, t), root = self._marks[0], poses[self._root]
        x, y, z, w = root[3:]
        self.server.tell(
            "status",
            time=simulator.t,
            paused=simulator.paused,
            real_time_factor=max(0.0, (simulator.t - t) / (now - wall)) if now > wall else 1.0,
            pose={
                "x": float(root[0]),
                "y": float(root[1]),
                "yaw": math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
            },
            speed=float(simulator.state.v[0]) if simulator.kinematics.floating_base else 0.0,
            driver=self.server.driver.holder,
        )
