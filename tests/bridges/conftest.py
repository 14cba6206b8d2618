"""A graph of topics and services without a simulation, whose thread is the test."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import pytest

from tests.time_limit import PATIENCE
from urdfkit.bridges.bridge import CallQueue
from urdfkit.bridges.graph import Graph
from urdfkit.bridges.service import Service, response
from urdfkit.bus import Bus
from urdfkit.errors import UsageError
from urdfkit.messages import from_fields


@dataclass
class Simulated:
    """Bus and graph; `until` runs what peers send, as a simulation does between two steps."""

    bus: Bus = field(default_factory=Bus)
    calls: CallQueue = field(default_factory=CallQueue)
    deleted: list[str] = field(default_factory=list)
    t: float = 2.5

    def __post_init__(self) -> None:
        def delete(request: Any) -> Any:
            if request.model_name == "ground":
                raise UsageError("`ground` cannot be deleted")
            self.deleted.append(request.model_name)
            return response("gazebo_msgs/srv/DeleteModel", success=True)

        service = Service("/delete", "gazebo_msgs/srv/DeleteModel", delete)
        self.bus.advertise("/odom", "nav_msgs/msg/Odometry")
        self.bus.advertise("/gazebo/delete_model", "gazebo_msgs/srv/DeleteModel_Request")
        self.graph = Graph(
            self.bus, self.calls, lambda: self.t, {service.name: service}, {"/robot_description": "<robot/>"}
        )

    def publish(self, topic: str, type: str, fields: Any) -> None:
        """Publish on the bus, as the simulation does."""
        self.bus.publish(topic, type, from_fields(type, fields))

    def until(self, condition: Callable[[], Any], seconds: float = PATIENCE) -> Any:
        """Run what peers send until the condition holds; return its value."""
        end = time.monotonic() + seconds
        while not (found := condition()):
            assert time.monotonic() < end, "the condition did not become true in time"
            self.calls.wait(0.01)
            self.calls.take()
        return found


@pytest.fixture
def simulated() -> Simulated:
    return Simulated()
