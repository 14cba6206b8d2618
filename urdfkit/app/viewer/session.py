"""Session of the viewer: one robot on the page, whose joints, findings and files it follows."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from threading import Event
from typing import TYPE_CHECKING, Any, cast

from urdfkit.app.page import note
from urdfkit.errors import UrdfkitError

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from urdfkit.app.viewer.findings_panel import FindingsPanel
    from urdfkit.kinematics import Kinematics
    from urdfkit.resources import ModelArgument
    from urdfkit.scene import Scene
    from urdfkit.view.html_export import Recording
    from urdfkit.view.protocol.page_requests import Request, Schema
    from urdfkit.view.server.server import Server

CHECK_PERIOD = 0.15
"""Seconds between two checks of the files."""
KEEPALIVE_PERIOD = 2.0
"""Seconds between two keepalive messages; pages treat six seconds of silence as a lost connection."""
JOINT_STATES = "/joint_states"
CLICKED_POINT = "/clicked_point"
"""Topic of RViz's "Publish Point" tool (rviz_default_plugins, tools/point)."""
POINT_STAMPED = "geometry_msgs/msg/PointStamped"


def request_schemas() -> dict[str, Schema]:
    """Return the requests of the page: a fix by the number of its finding, a point in a link's frame."""
    from urdfkit.view.protocol.page_requests import Schema, numbers, text, whole

    return {
        "fix": Schema({"finding": whole()}),
        "point": Schema({"frame": text(), "position": numbers(3)}, changes=False),
    }


@dataclass(frozen=True)
class ShownRobot:
    """A robot with its kinematics and shapes."""

    kinematics: Kinematics
    scene: Scene
    files: tuple[Path, ...]

    @classmethod
    def read(cls, model: ModelArgument) -> ShownRobot:
        """Load a robot.

        Raises:
            UrdfkitError: the description is invalid.
        """
        from urdfkit.description import load
        from urdfkit.kinematics import Kinematics
        from urdfkit.scene import scene_of

        robot = load(model.path, arguments=model.arguments, package_path=model.package_path)
        return cls(Kinematics(robot), scene_of(robot), robot.files or (model.path,))


class Session:
    """One robot on the page: its joint positions, its findings, and its files."""

    def __init__(
        self, server: Server | Recording, model: ModelArgument, shown: ShownRobot, findings: FindingsPanel
    ) -> None:
        from urdfkit.bus import Bus
        from urdfkit.view.file_watch import FileWatch

        self.server = server
        self.model = model
        self.shown = shown
        self.findings = findings
        self.watch = FileWatch(shown.files)
        self.positions: dict[str, float] = {}
        self.bus = Bus()
        self.bus.subscribe(JOINT_STATES, "sensor_msgs/msg/JointState", self._place)

    def run(self, stop: Event | None = None) -> None:
        """Process slider changes, requests and changed files until interrupted.

        Args:
            stop: ends the session when it is set.
        """
        server, stop = cast("Server", self.server), stop or Event()
        self.lint()
        due = 0.0
        while not stop.is_set():
            if (now := time.monotonic()) >= due:
                server.broadcast("alive")
                due = now + KEEPALIVE_PERIOD
            inputs = server.inbox.wait(CHECK_PERIOD)
            if inputs.joints:
                self.move(inputs.joints)
            for request in inputs.requests:
                try:
                    server.answer(request, **self.execute(request))
                except UrdfkitError as error:
                    server.answer(request, str(error))
            self.check_files()

    def move(self, joints: Mapping[str, float]) -> None:
        """Set positions [rad or m] of existing joints; keep the last positions if they are invalid."""
        before = dict(self.positions)
        self.positions.update({name: at for name, at in joints.items() if name in self.positions})
        try:
            self._publish()
        except UrdfkitError:  # a floating joint whose quaternion is zero
            self.positions = before
            self._publish()

    def execute(self, request: Request) -> dict[str, Any]:
        """Execute a request of a page and return its response.

        Raises:
            UrdfkitError: the request cannot be executed.
        """
        if request.name == "fix":
            done = self.findings.apply_fix(request.values["finding"])
            note(f"fixed {done}")
            return {"done": done}
        frame, position = request.values["frame"], request.values["position"]
        self.shown.kinematics.frame(frame)
        self._publish_point(frame, position)
        return {}

    def lint(self, *, stale: bool = False) -> None:
        """Publish the findings; `stale` where the robot on the page differs from the files."""
        robot = None if stale else self.shown.kinematics.robot
        self.server.publish_latched("findings", **self.findings.lint(robot))

    def check_files(self) -> None:
        """Reload changed files, and report missing files."""
        missing_before = self.watch.missing
        if self.watch.changed():
            self._reload()
        elif (missing := self.watch.missing) and missing != missing_before:
            self._report_missing(missing)

    def _report_missing(self, missing: Sequence[Path]) -> None:
        """Report missing files; the robot on the page stays until they exist again."""
        names = ", ".join(str(path) for path in missing)
        text = f"{names} not found; the page shows the robot that was read last"
        note(f"urdfkit: {text}")
        self.server.publish_latched("fault", message=text)

    def _reload(self) -> None:
        """Read the files again; keep the last valid robot on an error."""
        try:
            self.shown = ShownRobot.read(self.model)
        except UrdfkitError as error:
            note(f"urdfkit: {error}")
            self.server.publish_latched("fault", message=str(error))
            self.lint(stale=True)
        else:
            self.watch.follow(self.shown.files)
            self.show()
            note(f"reloaded {self.model.path.name}")
            self.lint()

    def show(self) -> None:
        """Show the robot on the page, with the positions of joints that existed before."""
        from urdfkit.view.content.inspector import inspection
        from urdfkit.view.content.joint_panel import home, joint_rows
        from urdfkit.view.content.meshcat_objects import draw, link_path

        kinematics, scene = self.shown.kinematics, self.shown.scene
        self.positions = {name: self.positions.get(name, at) for name, at in home(kinematics).items()}
        q = kinematics.configuration(self.positions)
        positions = kinematics.positions(q) | self.positions
        self.server.show(
            name=kinematics.robot.name or self.model.name,
            nodes=[link_path(name) for name in kinematics.link_names],
            joints=joint_rows(kinematics, positions),
            root=kinematics.link_names.index(kinematics.root),
            draw=lambda server: draw(scene, server, server.geometries),
        )
        self.server.publish(0.0, kinematics.link_poses(q))  # before message types are loaded, which takes longer
        self.server.publish_latched("inspect", **inspection(kinematics))
        self.server.publish_latched("fault", message=None)
        self._publish()

    def _publish(self) -> None:
        """Publish the joint positions; the subscription moves the links."""
        from urdfkit.messages import JOINT_STATE, header, message_type

        kinematics = self.shown.kinematics
        positions = kinematics.positions(kinematics.configuration(self.positions)) | self.positions
        names, values = list(positions), list(positions.values())
        import numpy as np

        empty = np.zeros(0)
        message = message_type(JOINT_STATE)(header(0.0, ""), names, np.array(values), empty, empty)
        self.bus.publish(JOINT_STATES, JOINT_STATE, message)

    def _publish_point(self, frame: str, position: Sequence[float]) -> None:
        """Publish a point as RViz's tool does, and print it in the terminal."""
        from urdfkit.messages import header, message_type

        point = message_type("geometry_msgs/msg/Point")(*position)
        message = message_type(POINT_STAMPED)(header(0.0, frame), point)
        self.bus.publish(CLICKED_POINT, POINT_STAMPED, message)
        note(f"{CLICKED_POINT}: {' '.join(f'{x:.6g}' for x in position)} in {frame}")

    def _place(self, message: Any) -> None:
        """Move the links to the joint positions of a message."""
        kinematics = self.shown.kinematics
        own = set(kinematics.variable_names)
        positions = {n: float(p) for n, p in zip(message.name, message.position, strict=True)}
        q = kinematics.configuration({name: position for name, position in positions.items() if name in own})
        self.server.publish(0.0, kinematics.link_poses(q))
        self.server.broadcast("joints", positions=positions)
