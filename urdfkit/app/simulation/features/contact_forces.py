"""Contact forces on robots as arrows, and slip velocities at their contacts; sent while a page shows them."""

import numpy as np

from urdfkit.app.simulation.features.feature import Feature
from urdfkit.view.protocol.websocket_messages import ARROWS

FORCES, SLIPS = "contacts", "slip"
"""Keys of the streams."""
PERIOD = 1 / 30
"""Seconds between two messages."""
MOST = 400
"""Maximum number of arrows in a message; the largest are sent."""


class ContactForces(Feature):
    """Sends the contacts of the last step."""

    def tick(self) -> None:
        """Send forces and slip velocities to pages that are ready for them."""
        hub = self.server.hub
        forces, slides = hub.accepts(FORCES), hub.accepts(SLIPS)
        if not (forces or slides) or not self.is_due(PERIOD):
            return
        simulator = self.simulator
        links = self._links()
        contacts = tuple(each for each in simulator.state.contacts if each.a in links or each.b in links)
        if forces:
            rows = np.array([(*each.position, *each.force) for each in contacts]).reshape(-1, 6)
            self.server.sense(FORCES, 0, simulator.t, ARROWS, _packed(rows))
        if slides:
            from urdfkit.sim.world.slip_velocity import slips

            found = slips(simulator.world, contacts)
            rows = np.array([(*each.position, *each.velocity) for each in found]).reshape(-1, 6)
            self.server.sense(SLIPS, 1, simulator.t, ARROWS, _packed(rows))
            fastest: dict[str, float] = {}
            for each in found:
                fastest[each.link] = max(fastest.get(each.link, 0.0), each.speed)
            self.server.send_to_subscribers(
                SLIPS, SLIPS, rows=[[link, round(v, 5)] for link, v in sorted(fastest.items())]
            )

    def _links(self) -> set[str]:
        """Return the names of the links of robots in contacts: without the robot's name for the first robot."""
        robots = list(self.simulator.world.robots.values())
        found = set(robots[0].kinematics.link_names)
        for robot in robots[1:]:
            if robot.has_plugins:
                found.update(f"{robot.name}::{link}" for link in robot.kinematics.link_names)
        return found


def _packed(rows: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> bytes:
    if len(rows) > MOST:
        rows = rows[np.argsort(-np.linalg.norm(rows[:, 3:], axis=1))[:MOST]]
    return bytes(rows.astype("<f4").tobytes())
