"""Discovery of a graph of ROS 2: nodes find each other one after the other, on a busy machine for several seconds."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from urdfkit.bridges.ros2.rclpy_node import DISCOVERY

SETTLED = 1.0
"""Seconds without a new name after which a graph is discovered."""
PERIOD = 0.05
"""Seconds between two checks."""
OF_EACH_NODE = ("/parameter_events", "/rosout", "/urdfkit/get_type_description")
"""Topics of every ROS 2 node, and the service of this one."""

Types = Mapping[str, Mapping[str, str]]
"""Kind, such as ``topics`` → name → type."""


@dataclass(frozen=True)
class Search:
    """The names that a command looks up on a graph.

    Attributes:
        kind: ``topics``, ``services`` or ``actions``.
        name: absolute name; None for all, or all of a type.
        type: of the topics; None for every type.
    """

    kind: str = "topics"
    name: str | None = None
    type: str | None = None

    def succeeds(self, types: Types) -> bool:
        """Return whether the name is found, or anything that not every node has."""
        found = types[self.kind]
        if self.name is not None:
            return self.name in found
        return any(self.type in (None, type) for name, type in found.items() if name not in OF_EACH_NODE)


def wait_for_discovery(
    find: Callable[[], Types],
    search: Search,
    *,
    clock: Callable[[], float] = time.monotonic,
    sleep: Callable[[float], None] = time.sleep,
) -> None:
    """Wait until a graph of ROS 2 is discovered.

    A search for one name ends when the name is found, and any other search when something is found and nothing new
    has appeared for some time. A search that finds nothing ends after `DISCOVERY`.

    Args:
        find: returns the names that are discovered so far; kinds that the library lacks are not searched.
        search: the names to look up.
        clock: wall clock [s].
        sleep: function that waits for a number of seconds.
    """
    begun = clock()
    count, new = 0, begun
    while (now := clock()) < begun + DISCOVERY and search.kind in (types := find()):
        before, count = count, sum(map(len, types.values()))
        new = now if count != before else new
        if search.succeeds(types) and (search.name is not None or now > new + SETTLED):
            return
        sleep(PERIOD)
