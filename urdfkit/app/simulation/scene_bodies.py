"""Scene of the page: robots and bodies of the world; only added and removed bodies are sent again."""

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description import Robot
from urdfkit.description.urdf.queries import tree_order
from urdfkit.scene import Shape
from urdfkit.sim.simulator import Simulator
from urdfkit.view.content.display_interface import Display

BODY = "world/"
"""Prefix of the names of the world's bodies; no name of a link begins with it."""


class SceneBodies:
    """Drawn bodies and their poses.

    Args:
        simulator: the simulation to show.
        server: the page.

    Attributes:
        revision: revision of the simulation that was shown last.
        tip: link with the most moving joints between it and the root, e.g. the end of an arm.
    """

    def __init__(self, simulator: Simulator, server: Display) -> None:
        self._simulator, self._server = simulator, server
        self._drawn: tuple[str, ...] = ()
        self._shown: dict[str, tuple[Any, ...]] = {}
        self.revision = -1
        kinematics = simulator.kinematics
        self._root = kinematics.link_names.index(kinematics.root)
        self.tip = _tip(kinematics.robot)

    def show(self) -> None:
        """Show the robots and bodies of the world in their current poses."""
        from urdfkit.scene import Scene
        from urdfkit.view.content.joint_panel import joint_rows
        from urdfkit.view.content.meshcat_objects import draw, draw_more, forget_others, link_path

        simulator, first = self._simulator, self.revision < 0
        drawn = tuple(simulator.world.body_poses())
        shapes: dict[str, list[Shape]] = {}
        for shape in simulator.world.body_shapes():
            shapes.setdefault(shape.body, []).append(replace(shape, body=f"{BODY}{shape.body}"))
        looks = {name: tuple(map(_look, shapes.get(name, ()))) for name in drawn}
        same = drawn == self._drawn and looks == self._shown
        before, self._drawn, self.revision = self._shown, drawn, simulator.world.revision
        self._shown = looks
        if same and not first:  # only poses of static bodies have changed
            return
        bodies = (*simulator.kinematics.link_names, *(BODY + name for name in drawn))
        if first:
            scene = Scene(bodies, (*simulator.scene.shapes, *(each for some in shapes.values() for each in some)))

            def picture(server: Display) -> None:
                draw(scene, server, server.geometries)

        else:
            removed = [name for name in before if name not in looks or looks[name] != before[name]]
            added = [name for name in drawn if looks[name] != before.get(name)]

            def picture(server: Display) -> None:
                draw_more(
                    [shape for name in added for shape in shapes.get(name, ())],
                    server,
                    server.geometries,
                    instead_of=[BODY + name for name in removed],
                )
                if removed:
                    rest = (each for some in shapes.values() for each in some)
                    forget_others((*simulator.scene.shapes, *rest), server.geometries)

        self._server.show(
            name=simulator.name,
            nodes=[link_path(name) for name in bodies],
            joints=joint_rows(simulator.kinematics, simulator.kinematics.positions(simulator.state.q)),
            root=self._root,
            draw=picture,
        )

    def poses(self) -> NDArray[np.float64]:
        """Return the poses of all bodies on the page; shape (bodies, 7), the robot's links first."""
        poses = self._simulator.link_poses()
        if not self._drawn:
            return poses
        others = self._simulator.world.body_poses()
        return np.vstack([poses, np.array([others[name] for name in self._drawn])])

    @property
    def root(self) -> int:
        """Row of the robot's root link."""
        return self._root


def _tip(robot: Robot) -> str:
    """Return the first link with the most moving joints between it and the root."""
    moved = {robot.roots()[0].name: 0}
    for joint in tree_order(robot):
        moved[str(joint.child)] = moved[str(joint.parent)] + (joint.type != "fixed")
    return max(moved, key=lambda name: moved[name])


def _look(shape: Shape) -> tuple[Any, ...]:
    """Return a key that is equal for shapes with the same appearance."""
    mesh = None if shape.mesh is None else shape.mesh.hash
    placement = np.asarray(shape.placement, dtype=float).tobytes()
    return shape.role, shape.geometry, placement, shape.rgba, shape.has_color, mesh
