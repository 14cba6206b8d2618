"""Nodes that read the topic on which they publish, so that their messages go round in a loop.

The topics are those of nav2_velocity_smoother, depthimage_to_laserscan, pointcloud_to_laserscan and
imu_filter_madgwick; only the first were compared with the source (velocity_smoother.cpp).
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.nodes.started import launched_nodes
from urdfkit.lint.facts.topics.graph import remapped
from urdfkit.lint.model.model import Model

_NODES = {
    "velocity_smoother": ("cmd_vel", "cmd_vel_smoothed"),
    "depthimage_to_laserscan_node": ("depth", "scan"),
    "pointcloud_to_laserscan_node": ("cloud_in", "scan"),
    "imu_filter_madgwick_node": ("imu/data_raw", "imu/data"),
}
"""Program → topic that it reads, and the one on which it publishes the result."""


def self_readers(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the new name and the message of each remapping that closes a loop."""
    for node in launched_nodes(model):
        if node.program not in _NODES:
            continue
        read, written = _NODES[node.program]
        for old, new in node.remappings:
            name = old.name.removeprefix("~").strip("/")
            if name in (read, written) and remapped(node, read) == remapped(node, written):
                if not re.search(r"\$|[{}]", new.name):
                    yield (
                        node.source,
                        new,
                        f"`{node.program}` publishes on `{new.name}` and subscribes to it, and reads its own output",
                    )
                break
