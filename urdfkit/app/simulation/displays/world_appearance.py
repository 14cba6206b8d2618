"""Lights of the world, and planes among the visuals of its static bodies, such as its ground, for the page."""

from typing import Any

from urdfkit.app.simulation.features.feature import Feature
from urdfkit.description.sdf import Plane
from urdfkit.linear_algebra import matmul
from urdfkit.scene.colors import DEFAULT
from urdfkit.scene.lights import lighting_of
from urdfkit.scene.pose_matrices import pose_matrix, upright
from urdfkit.scene.world_shapes import color_of
from urdfkit.sim.construction.rigid_bodies import parts_of

FARTHEST = 1e6
"""Largest range of a light that is sent [m]: JSON has no infinity."""


class WorldLights(Feature):
    """Lights, ambient light and background, for a page that shows the scene as the simulated cameras do."""

    _shown = False

    def show(self) -> None:
        """Publish them, once: they do not change."""
        if self._shown:
            return
        self._shown = True
        lighting = lighting_of(self.simulator.world.description)
        self.server.publish_latched(
            "lights",
            lights=lighting.lights.clip(-FARTHEST, FARTHEST).tolist(),
            ambient=lighting.ambient,
            background=lighting.background,
        )


class WorldPlanes(Feature):
    """Pose, size and colour of the planes. They are no bodies of the scene: views are not fitted to them."""

    _sent: list[dict[str, Any]] | None = None

    def show(self) -> None:
        """Publish them, if they have changed."""
        found = []
        for model in self.simulator.world.description.models:
            around = pose_matrix(model.pose)
            for _, static, links in parts_of(model):
                for _, pose, link in links if static else ():
                    for shape in link.visuals:
                        if not isinstance(shape.geometry, Plane):
                            continue
                        placed = matmul(matmul(around, pose_matrix(pose)), pose_matrix(shape.pose))
                        placed[:3, :3] = matmul(placed[:3, :3], upright(shape.geometry.normal))
                        color = color_of(shape) or (*DEFAULT[:3], 1.0 - shape.transparency)
                        found.append({"pose": placed.ravel().tolist(), "size": shape.geometry.size, "color": color})
        if found != self._sent:
            self._sent = found
            self.server.publish_latched("planes", planes=found)
