"""Reach maps for the page: as a message, and computed in a thread on request."""

import base64
from threading import Thread
from typing import Any

from urdfkit.errors import KinematicsError, UrdfkitError
from urdfkit.kinematics import Chain, ReachMap
from urdfkit.view.server.server import Server

RESOLUTION, ORIENTATIONS = 0.1, 20
"""Edge of a cell [m] and orientations of a map on request, which takes a few seconds."""


class ReachLayer:
    """Computes reach maps, one at a time, and sends them to the pages.

    Args:
        server: of the page.
    """

    def __init__(self, server: Server) -> None:
        self._server = server
        self._thread: Thread | None = None

    def start(self, chain: Chain) -> dict[str, Any]:
        """Start the computation; the answer to the request.

        Raises:
            KinematicsError: another map is being computed.
        """
        if self._thread is not None and self._thread.is_alive():
            raise KinematicsError("another reach map is being computed")
        self._thread = Thread(target=self._compute, args=(chain,), name="reach", daemon=True)
        self._thread.start()
        return {"resolution": RESOLUTION, "orientations": ORIENTATIONS}

    def _compute(self, chain: Chain) -> None:
        from urdfkit.kinematics import reach_map

        try:
            found = reach_map(
                chain, resolution=RESOLUTION, orientations=ORIENTATIONS, position_only=len(chain.joint_names) < 6
            )
            self._server.publish_latched("reach", **reach_message(found))
        except UrdfkitError as error:
            self._server.broadcast("notice", text=str(error), tone="error")


def reach_message(found: ReachMap) -> dict[str, Any]:
    """Return the message `reach` of the page; see docs/protocol.md."""
    from urdfkit.kinematics.reach.map_files import COLOURS

    return {
        "base": found.base,
        "tip": found.tip,
        "origin": found.origin.tolist(),
        "resolution": found.resolution,
        "shape": list(found.score.shape),
        "scores": base64.b64encode((255.0 * found.score).round().astype("u1").tobytes()).decode(),
        "colours": COLOURS.tolist(),
    }
