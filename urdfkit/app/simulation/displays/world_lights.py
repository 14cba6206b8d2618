"""Lights of the world, for a page that shows the scene as the simulated cameras do."""

from urdfkit.app.simulation.features.feature import Feature
from urdfkit.scene.lights import lighting_of

FARTHEST = 1e6
"""Largest range of a light that is sent [m]: JSON has no infinity."""


class WorldLights(Feature):
    """Lights, ambient light and background of the world."""

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
