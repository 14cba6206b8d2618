"""The browser app: a server that shows a scene and takes wishes. Knows nothing of the simulator.

`Server` runs in a thread of its own; `draw_scene` puts a `urdfkit.scene.Scene` on it. Whoever owns the robot publishes
poses and drains `Server.inbox` and `Server.driver` in their own thread.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from urdfkit.errors import MissingDependencyError

if TYPE_CHECKING:
    from urdfkit.view.server import Server

__all__ = ["require"]


def require() -> None:
    """Check that what the browser app needs is installed.

    Raises:
        MissingDependencyError: naming what is missing and the command to run.
    """
    from importlib.util import find_spec

    missing = [shown for module, shown in (("meshcat", "meshcat"), ("tornado", "tornado")) if find_spec(module) is None]
    if missing:
        raise MissingDependencyError(f"view needs {' and '.join(missing)}: pip install 'urdfkit[view]'")
