"""`urdfkit view`: a robot in the browser, with a slider for every joint; saving the file shows the change."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from urdfkit.cli.page import Page, add_page_options, note, require_page, until_interrupted
from urdfkit.cli.parser import add_model
from urdfkit.cli.unused import note_unused
from urdfkit.errors import UrdfkitError

if TYPE_CHECKING:
    from pathlib import Path

    from urdfkit.kinematics import Kinematics
    from urdfkit.resources import ModelArgument
    from urdfkit.scene import Scene
    from urdfkit.view.server import Server

LOOK = 0.15
"""Seconds between looks at the files."""
JOINT_STATES = "/joint_states"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    add_model(parser)
    add_page_options(parser)
    parser.epilog = (
        "examples:\n  urdfkit view simpleton\n  urdfkit view urdf/robot.urdf.xacro use_camera:=true --port 8080"
    )


def run(arguments: argparse.Namespace) -> int:
    """Serve until interrupted."""
    require_page("view", "view", beside=("rosbags",))
    from urdfkit.resources import find_model
    from urdfkit.view.server import Server

    model = find_model(arguments.model, package_path=arguments.package_path)
    with until_interrupted():
        figure = Figure.read(model)
        note_unused(model.arguments, figure.files, quiet=arguments.quiet)
        server = Server("view", host=arguments.host, port=arguments.port)
        page = Page(server, host=arguments.host, browser=not arguments.no_browser)
        try:
            session = Session(server, model, figure)
            session.show()
            page.open()
            session.run()
        finally:
            server.stop()
    return 0


@dataclass(frozen=True)
class Figure:
    """A robot ready to be shown."""

    kinematics: Kinematics
    scene: Scene
    files: tuple[Path, ...]

    @classmethod
    def read(cls, model: ModelArgument) -> Figure:
        """Load a robot.

        Raises:
            UrdfkitError: the description cannot be read as a robot.
        """
        from urdfkit.description import load
        from urdfkit.kinematics import Kinematics
        from urdfkit.scene import scene_of

        robot = load(model.path, arguments=model.arguments, package_path=model.package_path)
        return cls(Kinematics(robot), scene_of(robot), robot.files or (model.path,))


class Session:
    """One robot being looked at: joint positions, what is on the page, and the files it came from."""

    def __init__(self, server: Server, model: ModelArgument, figure: Figure) -> None:
        from urdfkit.bus import Bus
        from urdfkit.view.files import Watch

        self.server = server
        self.model = model
        self.figure = figure
        self.watch = Watch(figure.files)
        self.positions: dict[str, float] = {}
        self.bus = Bus()
        self.bus.subscribe(JOINT_STATES, "sensor_msgs/msg/JointState", self._place)

    def run(self) -> None:
        """Follow sliders and files for ever."""
        while True:
            wishes = self.server.inbox.wait(LOOK)
            if wishes.joints:
                self.positions.update({j: p for j, p in wishes.joints.items() if j in self.positions})
                self._publish()
            if self.watch.changed():
                self._reload()

    def _reload(self) -> None:
        """Read the files again; a robot that cannot be read leaves the last good one where it is."""
        try:
            self.figure = Figure.read(self.model)
        except UrdfkitError as error:
            note(f"urdfkit: {error}")
            self.server.declare("fault", message=str(error))
            return
        self.watch.follow(self.figure.files)
        self.show()
        note(f"reloaded {self.model.path.name}")

    def show(self) -> None:
        """Put the robot on the page, its joints where they were by name."""
        from urdfkit.view.joints import home, joint_rows
        from urdfkit.view.nodes import draw, link_path

        kinematics, scene = self.figure.kinematics, self.figure.scene
        self.positions = {name: self.positions.get(name, at) for name, at in home(kinematics).items()}
        positions = kinematics.positions(kinematics.configuration(self.positions)) | self.positions
        self.server.show(
            name=kinematics.robot.name or self.model.name,
            nodes=[link_path(name) for name in kinematics.link_names],
            joints=joint_rows(kinematics, positions),
            root=kinematics.link_names.index(kinematics.root),
            draw=lambda server: draw(scene, server, server.geometries),
        )
        self.server.declare("fault", message=None)
        self._publish()

    def _publish(self) -> None:
        """Publish the joint positions; what hears them moves the links."""
        from urdfkit.messages import JOINT_STATE, header, message_type

        kinematics = self.figure.kinematics
        positions = kinematics.positions(kinematics.configuration(self.positions)) | self.positions
        names, values = list(positions), list(positions.values())
        import numpy as np

        empty = np.zeros(0)
        message = message_type(JOINT_STATE)(header(0.0, ""), names, np.array(values), empty, empty)
        self.bus.publish(JOINT_STATES, JOINT_STATE, message)

    def _place(self, message: Any) -> None:
        """Move the links to the joint positions of a message."""
        kinematics = self.figure.kinematics
        own = set(kinematics.joint_names)
        positions = {n: float(p) for n, p in zip(message.name, message.position, strict=True)}
        q = kinematics.configuration({name: position for name, position in positions.items() if name in own})
        self.server.publish(0.0, kinematics.link_poses(q))
        self.server.tell("joints", positions=positions)
