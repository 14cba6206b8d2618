"""Logical camera of gz sim: reports the models whose origin is in its frustum, without occlusion."""

from math import tan
from typing import Any

import numpy as np

from urdfkit.description.urdf.robot import SensorTag
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, inverse_placement, matmul
from urdfkit.messages import header, message_type
from urdfkit.messages.constructors import pose
from urdfkit.messages.sensors import GZ_LOGICAL_IMAGE, GZ_LOGICAL_MODEL
from urdfkit.scene.pose_matrices import pose_matrices
from urdfkit.sim.plugins.parameters import Parameters
from urdfkit.sim.plugins.sensors.scene_sensor import SceneSensor
from urdfkit.sim.plugins.sensors.sensor_values import number
from urdfkit.sim.plugins.setup import Setup
from urdfkit.sim.plugins.topic_names import Topics
from urdfkit.sim.scene_view import Layout
from urdfkit.sim.state.quaternion import from_matrix

Observation = tuple[float, Array, list[tuple[str, Array]]]
"""Time [s], placement of the camera, shape (4, 4), and name and placement of each model in the world."""


class GzLogicalCamera(SceneSensor):
    """Logical camera that looks along the x axis of its link."""

    kind = "gz_logical_camera"

    def _prepare(self, setup: Setup, sensor: SensorTag, read: Parameters, topics: Topics) -> None:
        inside = sensor.element.find("logical_camera")
        self._near, self._far = (
            number(inside, tag, default, least=0.0) for tag, default in (("near", 0.0), ("far", 1.0))
        )
        if self._near >= self._far:
            message = f"the range of a logical camera, {self._near:g} m to {self._far:g} m, is empty"
            raise SimulationError(message, position=(inside or sensor.element).origin.position)
        self._across = tan(number(inside, "horizontal_fov", 1.0, least=0.0) / 2)
        self._aspect = number(inside, "aspect_ratio", 1.0, least=1e-9)
        self.topics = (setup.bus.advertise(topics.resolve(read.text("topic")), GZ_LOGICAL_IMAGE),)

    def _observe(self, t: float, layout: Layout, frame: Array, random: np.random.Generator) -> Observation:
        seen: list[tuple[str, Array]] = []
        names = [model.name for model in layout.world.models]
        for name in names:
            pose = layout.bodies.get(name)
            if pose is None:
                pose = next((each for body, each in layout.bodies.items() if body.startswith(f"{name}::")), None)
            if pose is not None:
                seen.append((name, pose_matrices(np.array(pose))[0]))
        for name, _, moment in layout.robots:
            if name not in names and name != self._robot:
                seen.append((name, pose_matrices(moment.link_poses()[0])[0]))
        inside = [(name, placement) for name, placement in seen if self._holds(frame, placement[:3, 3])]
        return t, frame, inside

    def _holds(self, frame: Array, point: Array) -> bool:
        """Whether a point in the world is inside the frustum."""
        x, y, z = matmul(frame[:3, :3].T, point - frame[:3, 3])
        return bool(
            self._near <= x <= self._far and abs(y) <= x * self._across and abs(z) <= x * self._across / self._aspect
        )

    def message(self, observation: Observation) -> Any:
        """Return the LogicalCameraImage of an observation."""
        t, frame, seen = observation
        model = message_type(GZ_LOGICAL_MODEL)
        models = [model(name, _pose(matmul(inverse_placement(frame), placement))) for name, placement in seen]
        return message_type(GZ_LOGICAL_IMAGE)(header(t, self.frame), _pose(frame), models)


def _pose(placement: Array) -> Any:
    return pose(placement[:3, 3], from_matrix(placement[:3, :3]))
