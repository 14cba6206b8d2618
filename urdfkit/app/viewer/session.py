"""Session of the viewer: one robot on the page, whose joints, findings and files it follows."""

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from threading import Event
from typing import Any, cast

from urdfkit.app.page import note
from urdfkit.app.repair_findings import note_repairs, with_repairs
from urdfkit.app.viewer.findings_panel import FindingsPanel
from urdfkit.app.viewer.link_solver import LinkSolver
from urdfkit.app.viewer.reach_layer import ReachLayer
from urdfkit.app.viewer.shown_robot import MissingMeshes, ShownRobot
from urdfkit.errors import UrdfkitError
from urdfkit.resources import ModelArgument
from urdfkit.view.html_export import Recording
from urdfkit.view.protocol.page_requests import Request, Schema, numbers, text, whole
from urdfkit.view.server.request_inbox import PageInput
from urdfkit.view.server.server import Server

CHECK_PERIOD = 0.05
"""Seconds between two checks of the files, which take 0.3 % of a core; a changed file is read if two checks agree."""
SAVE_TIME = 0.3
"""Seconds for which a saved file may be invalid before its error is reported."""
KEEPALIVE_PERIOD = 2.0
"""Seconds between two keepalive messages; pages treat six seconds of silence as a lost connection."""
JOINT_STATES = "/joint_states"
CLICKED_POINT = "/clicked_point"
"""Topic of RViz's "Publish Point" tool (rviz_default_plugins, tools/point)."""
POINT_STAMPED = "geometry_msgs/msg/PointStamped"


def request_schemas() -> dict[str, Schema]:
    """Return the requests of the page: a fix by its finding's number, a point in a link's frame, a link's pose."""
    from urdfkit.app.viewer import link_solver

    return {
        "fix": Schema({"finding": whole()}),
        "point": Schema({"frame": text(), "position": numbers(3)}, changes=False),
        **link_solver.request_schemas(),
    }


class Session:
    """One robot on the page: its joint positions, its findings, and its files."""

    def __init__(
        self,
        server: Server | Recording,
        model: ModelArgument,
        shown: ShownRobot,
        findings: FindingsPanel,
        *,
        strict: bool = False,
    ) -> None:
        from urdfkit.bus import Bus
        from urdfkit.view.file_watch import FileWatch

        self.server = server
        self.model = model
        self.shown = shown
        self.findings = findings
        self.strict = strict
        self.watch = FileWatch(shown.files, shown.meshes)
        self._missing = MissingMeshes(model, shown.missing)
        self._noted = {repair.message for repair in shown.repairs}
        self._failure: tuple[float, UrdfkitError] | None = None
        self.positions: dict[str, float] = {}
        self._solver = LinkSolver(shown.kinematics.robot)
        self._reach = ReachLayer(cast("Server", server))
        self._handlers: dict[str, Callable[[Request], Mapping[str, Any]]] = {}
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
            self.process(server.inbox.wait(CHECK_PERIOD))
            self.check_files()

    def add_request(self, name: str, schema: Schema, handler: Callable[[Request], Mapping[str, Any]]) -> None:
        """Accept another request of the page; `handler` returns the values of the answer."""
        self._handlers[name] = handler
        cast("Server", self.server).requests[name] = schema

    def process(self, inputs: PageInput) -> None:
        """Move the joints and execute the requests of pages."""
        server = cast("Server", self.server)
        if inputs.joints:
            self.move(inputs.joints)
        for request in inputs.requests:
            try:
                server.answer(request, **self.execute(request))
            except UrdfkitError as error:
                server.answer(request, str(error))

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
        if request.name in self._handlers:
            return dict(self._handlers[request.name](request))
        if request.name == "fix":
            done = self.findings.apply_fix(request.values["finding"])
            note(f"fixed {done}")
            return {"done": done}
        if request.name == "ik":
            return self._solver.answer(request.values, self.positions)
        if request.name == "reach":
            return self._reach.start(self._solver.chain(request.values["link"], self.positions))
        frame, position = request.values["frame"], request.values["position"]
        self.shown.kinematics.frame(frame)
        self._publish_point(frame, position)
        return {}

    def lint(self, *, stale: bool = False) -> None:
        """Publish the findings and repairs; `stale` where the robot on the page differs from the files."""
        found = self.findings.lint(None if stale else self.shown.kinematics.robot)
        rows = found["findings"]
        if not stale:
            number = max((row["number"] for row in rows), default=0) + 1
            rows = with_repairs(rows, self.shown.repairs, first=number)
        self.server.publish_latched("findings", **{**found, "findings": rows})

    def check_files(self) -> None:
        """Reload changed files, and report missing files."""
        missing_before = self.watch.missing
        if self.watch.changed() or self._missing.found():
            self._reload()
        elif (missing := self.watch.missing) and missing != missing_before:
            self._report_missing(missing)
        elif self._failure is not None and not self.watch.unsettled and time.monotonic() >= self._failure[0]:
            self._report_failure(self._failure[1])

    def _report_missing(self, missing: Sequence[Path]) -> None:
        """Report missing files; the robot on the page stays until they exist again."""
        names = ", ".join(str(path) for path in missing)
        text = f"{names} not found; the page shows the last robot that was read"
        note(f"urdfkit: {text}")
        self.server.publish_latched("fault", message=text)

    def _reload(self) -> None:
        """Read the files again; keep the last valid robot on an error.

        Editors that truncate a file before they write it leave it invalid for a moment, so an error is reported only
        if it lasts.
        """
        try:
            self.shown = ShownRobot.read(self.model, strict=self.strict, loader=self.shown.loader)
        except UrdfkitError as error:
            due = time.monotonic() + SAVE_TIME if self._failure is None else self._failure[0]
            self._failure = (due, error)
        else:
            self._failure = None
            self.watch.follow(self.shown.files, self.shown.meshes)
            self._missing = MissingMeshes(self.model, self.shown.missing)
            self.show()
            note(f"reloaded {self.model.path.name}")
            self._noted = note_repairs(self.shown.repairs, self._noted)
            self.lint()

    def _report_failure(self, error: UrdfkitError) -> None:
        """Report an error of the files; the robot on the page stays until they are valid again."""
        self._failure = None
        note(f"urdfkit: {error}")
        self.server.publish_latched("fault", message=str(error))
        self.lint(stale=True)

    def show(self) -> None:
        """Show the robot on the page, with the positions of joints that existed before."""
        from urdfkit.view.content.inspector import inspection
        from urdfkit.view.content.joint_panel import home, joint_rows
        from urdfkit.view.content.meshcat_objects import draw, link_path

        kinematics, scene = self.shown.kinematics, self.shown.scene
        self._solver = LinkSolver(kinematics.robot)
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
