"""The page of a robot with both modes: the viewer, and a simulation that starts from it and returns to it."""

from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from threading import Event
from typing import Any

from urdfkit.app.page import Page, note
from urdfkit.app.simulation.loop import DriveLoop
from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.app.simulation.simulation_handle import driving
from urdfkit.app.viewer.shown_robot import ShownRobot
from urdfkit.app.viewer.viewing import viewing
from urdfkit.errors import UrdfkitError
from urdfkit.resources import ModelArgument
from urdfkit.view.protocol.page_requests import Request, Schema, choice

WORLD = "empty"
"""World of the simulation until the page names another."""


@dataclass
class _Switch:
    """Ends the loop of a mode when the page requests the other one."""

    world: str = WORLD
    stop: Event = field(default_factory=Event)

    def take(self, request: Request) -> dict[str, Any]:
        self.world = request.values.get("world", self.world)
        self.stop.set()
        return {}


def view_and_simulate(page: Page, model: ModelArgument, shown: ShownRobot, *, strict: bool = False) -> None:
    """Serve the viewer of a robot, and its simulation while the page requests it, until interrupted.

    Args:
        page: the page, not opened yet, in mode ``view``.
        model: the robot as it was given.
        shown: the robot.
        strict: refuse what needs a repair.

    Raises:
        UrdfkitError: the robot cannot be shown.
    """
    page.kept, fault, world = True, "", WORLD
    try:
        while True:
            shown, world = _view(page, model, shown, fault, world, strict=strict)
            page.server.change_mode("sim")
            fault = ""
            try:
                _simulate(page, model, world, strict=strict)
            except UrdfkitError as error:
                fault = f"{model.name} cannot be simulated in world {world}: {error}"
                note(f"urdfkit: {fault}")
            page.server.change_mode("view")
            shown = _read_again(model, shown, strict=strict)
    finally:
        page.kept = False
        page.close()


def _view(
    page: Page, model: ModelArgument, shown: ShownRobot, fault: str, world: str, *, strict: bool
) -> tuple[ShownRobot, str]:
    """Serve the viewer until the page requests a simulation; return the robot of then, and the world."""
    from urdfkit.description.sdf.model_library import world_names

    switch, worlds = _Switch(world), world_names()
    with viewing(page, model, shown, strict=strict) as session:
        if can_simulate():
            session.add_request("simulate", Schema({}, {"world": choice(*worlds)}, changes=False), switch.take)
            page.server.publish_latched("modes", other="sim", worlds=worlds, world=world)
        if fault:
            page.server.publish_latched("fault", message=fault)
        session.run(switch.stop)
        return session.shown, switch.world


def _simulate(page: Page, model: ModelArgument, world: str, *, strict: bool) -> None:
    """Serve a simulation until the page requests the viewer."""
    from urdfkit.app.viewer.findings_panel import FindingsPanel
    from urdfkit.description.loading import load_repaired, load_valid
    from urdfkit.description.sdf import load_world

    switch = _Switch()
    robot = load_valid(model) if strict else load_repaired(model)
    options = RunOptions(strict=strict)
    simulation: AbstractContextManager[DriveLoop] = driving(page, robot, load_world(world), options, note=note)
    with simulation as loop:
        loop.add_request("view", Schema(changes=False), switch.take)
        page.server.publish_latched("modes", other="view", worlds=[], world=world)
        loop.lint = FindingsPanel(model, may_write=False).lint(robot)
        page.server.publish_latched("findings", **loop.findings())
        loop.run(switch.stop)


def _read_again(model: ModelArgument, shown: ShownRobot, *, strict: bool) -> ShownRobot:
    """Return the robot of the present files; the last one while they are invalid."""
    try:
        return ShownRobot.read(model, strict=strict, loader=shown.loader)
    except UrdfkitError:
        return shown


def can_simulate() -> bool:
    """Return whether the packages of the simulation are installed."""
    from importlib.util import find_spec

    return find_spec("numba") is not None
