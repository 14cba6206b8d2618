"""Panels of the viewer in the simulation: properties of links and joints, and posing while it is paused."""

from collections.abc import Mapping

from urdfkit.app.simulation.features.feature import Feature
from urdfkit.errors import UrdfkitError
from urdfkit.view.content.inspector import inspection

KEY = "joints"
"""Key of the stream of joint positions."""
PERIOD = 0.1
"""Seconds between two messages."""


class RobotPanels(Feature):
    """Properties and joint positions of the first robot."""

    _shown = False

    def show(self) -> None:
        """Publish the properties of links and joints, once: they do not change."""
        if not self._shown:
            self._shown = True
            self.server.publish_latched("inspect", **inspection(self.simulator.kinematics))

    def tick(self) -> None:
        """Send the positions of the joints."""
        if KEY in self.server.hub.subscribed_keys and self.is_due(PERIOD):
            self.server.send_to_subscribers(KEY, KEY, positions=self.positions())

    def positions(self) -> Mapping[str, float]:
        """Return joint → position [rad or m]."""
        return self.simulator.kinematics.positions(self.simulator.state.q)

    def move(self, positions: Mapping[str, float]) -> None:
        """Set joint positions [rad or m] of the paused robot; invalid ones are reported on the page."""
        try:
            self.simulator.world.robots[self.simulator.name].place_joints(positions)
        except UrdfkitError as error:
            self.server.broadcast("notice", text=str(error), tone="error")
