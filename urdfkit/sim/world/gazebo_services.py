"""Gazebo's services and topics for spawning, removing, placing and pushing entities, as topics of the bus.

The bus has no services: the topic with the name of a service carries its requests. A request that fails is reported to
the user and has no other effect, like a service that returns an error.
"""

from collections.abc import Callable, Sequence
from typing import Any

from urdfkit.bus import Bus
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.messages import message_type, vector
from urdfkit.messages.constructors import pose as pose_message
from urdfkit.messages.simulation import (
    CLEAR,
    CREATE,
    DELETE,
    ENTITY,
    MODEL_STATE,
    MODEL_STATES,
    SET_POSE,
    SPAWN,
    WRENCH,
    WRENCH_ENTITY,
)
from urdfkit.sim.plugins.builtin_publishers import Publication
from urdfkit.sim.state.poses import pose_from
from urdfkit.sim.state.quaternion import rotate
from urdfkit.sim.state.robot_state import State
from urdfkit.sim.world.live_world import LiveWorld
from urdfkit.sim.world.pose_messages import composed, point_in_frame, seven_of, six_of, three
from urdfkit.sim.world.spawn_requests import SpawnRequest, spawn_request, spawn_request_of_text

Note = Callable[[str], None]

MODEL_STATES_RATE = 100.0
"""Publication rate [Hz]; Gazebo publishes in every step."""


def listen(
    bus: Bus, world: LiveWorld, call_at: Callable[[float, Callable[[], None]], None], note: Note
) -> dict[str, Callable[[Any], None]]:
    """Subscribe to the topics of the services; return topic → the function that executes a request.

    Args:
        bus: of the simulation.
        world: to change.
        call_at: calls a function at a simulated time [s].
        note: reports a failed request to the user.
    """
    heard = _Services(world, call_at)
    prefix = f"/world/{world.name}"
    acts: dict[str, Callable[[Any], None]] = {}
    for topic, type, act in (
        ("/gazebo/set_model_state", MODEL_STATE, heard.set_model_state),
        ("/gazebo/spawn_sdf_model", SPAWN, heard.spawn_model),
        ("/gazebo/spawn_urdf_model", SPAWN, heard.spawn_model),
        ("/gazebo/delete_model", DELETE, heard.delete_model),
        ("/gazebo/apply_body_wrench", WRENCH, heard.apply_body_wrench),
        ("/gazebo/clear_body_wrenches", CLEAR, heard.clear_body_wrenches),
        (f"{prefix}/create", CREATE, heard.create),
        (f"{prefix}/remove", ENTITY, heard.remove),
        (f"{prefix}/set_pose", SET_POSE, heard.set_pose),
        (f"{prefix}/wrench", WRENCH_ENTITY, heard.wrench),
        (f"{prefix}/wrench/persistent", WRENCH_ENTITY, heard.persistent_wrench),
        (f"{prefix}/wrench/clear", ENTITY, heard.clear_wrench),
    ):
        bus.subscribe(topic, type, _reporting(note, topic, act))
        acts[topic] = act
    return acts


def _reporting(note: Note, topic: str, act: Callable[[Any], None]) -> Callable[[Any], None]:
    def receive(message: Any) -> None:
        try:
            act(message)
        except UrdfkitError as error:
            note(f"{topic}: {error}")

    return receive


class _Services:
    def __init__(self, world: LiveWorld, call_at: Callable[[float, Callable[[], None]], None]) -> None:
        self._world, self._call_at = world, call_at

    def set_model_state(self, message: Any) -> None:
        """Place a model with a velocity, in the frame of a model or link if one is named."""
        pose, twist = seven_of(message.pose), six_of(message.twist)
        frame = message.reference_frame
        if frame not in ("", "world", "map"):
            around = self._pose(frame)
            turn = around[3:]
            pose = composed(around, pose)
            twist = (*rotate(turn, twist[:3]), *rotate(turn, twist[3:]))
        self._world.place(message.model_name, pose_from(pose), twist)

    def spawn_model(self, message: Any) -> None:
        """Spawn the model of a document."""
        request = spawn_request_of_text(message.model_xml, self._world.package_path)
        pose = seven_of(message.initial_pose)
        if message.reference_frame not in ("", "world", "map"):
            pose = composed(self._pose(message.reference_frame), pose)
        self._spawn(request, message.model_name, pose)

    def delete_model(self, message: Any) -> None:
        """Remove a model."""
        self._world.remove(message.model_name)

    def apply_body_wrench(self, message: Any) -> None:
        """Push a body from a given time for a given duration, in the axes and at a point of a named frame."""
        world, frame = self._world, message.reference_frame
        force, torque, point = (
            three(message.wrench.force),
            three(message.wrench.torque),
            three(message.reference_point),
        )
        body = self._pose(message.body_name)
        if frame not in ("", "world", "map"):
            around = self._pose(frame)
            force, torque = rotate(around[3:], force), rotate(around[3:], torque)
            point_in_world = composed(around, (*point, 0.0, 0.0, 0.0, 1.0))
            point = point_in_frame(body, point_in_world[:3])
        elif any(point):
            # Without a frame, gazebo_ros interprets the point relative to the body's origin, in world axes.
            point = rotate((-body[3], -body[4], -body[5], body[6]), point)
        seconds = message.duration.sec + 1e-9 * message.duration.nanosec
        if seconds == 0:
            return
        start = message.start_time.sec + 1e-9 * message.start_time.nanosec
        duration = None if seconds < 0 else seconds

        def push() -> None:
            world.push(message.body_name, force, torque, at=point, for_seconds=duration)

        if start > world.builder.engine.t:
            self._call_at(start, push)
        else:
            push()

    def clear_body_wrenches(self, message: Any) -> None:
        """End the pushes on a body."""
        self._world.release(message.body_name)

    def create(self, message: Any) -> None:
        """Spawn an SDF or URDF model from text or a file."""
        if message.relative_to not in ("", "world"):
            raise SimulationError("`relative_to` is not supported; use a pose in the world frame")
        if not (message.sdf or message.sdf_filename):
            raise SimulationError("`sdf` and `sdf_filename` are empty; cloning is not supported")
        folders = self._world.package_path
        request = (
            spawn_request_of_text(message.sdf, folders) if message.sdf else spawn_request(message.sdf_filename, folders)
        )
        name = message.name or request.source.name
        if message.allow_renaming:
            name = self._world.free_name(name)
        self._spawn(request, name, seven_of(message.pose))

    def remove(self, message: Any) -> None:
        """Remove a model."""
        self._world.remove(message.name)

    def set_pose(self, message: Any) -> None:
        """Place a model; its velocity is unchanged, as in gz."""
        self._world.place(message.entity.name, pose_from(seven_of(message.pose)))

    def wrench(self, message: Any) -> None:
        """Push a link for one step."""
        self._push(message, self._world.builder.engine.dt)

    def persistent_wrench(self, message: Any) -> None:
        """Push a link until the wrench is cleared."""
        self._push(message, None)

    def clear_wrench(self, message: Any) -> None:
        """End the pushes on a link."""
        self._world.release(message.name)

    def _push(self, message: Any, seconds: float | None) -> None:
        force, torque = three(message.wrench.force), three(message.wrench.torque)
        self._world.push(message.entity.name, force, torque, for_seconds=seconds)

    def _spawn(self, request: SpawnRequest, name: str, pose: Sequence[float]) -> None:
        self._world.spawn(request, pose_from(pose), name=name or None)

    def _pose(self, name: str) -> Sequence[float]:
        """Return the pose of a model, robot, body or link."""
        return self._world.pose(name) if name in self._world.names else self._world.link_pose(name)


class ModelStates(Publication):
    """``/gazebo/model_states``: pose and velocity of every model and robot, if the topic has subscribers."""

    def __init__(self, bus: Bus, dt: float, world: LiveWorld) -> None:
        super().__init__(bus.advertise("/gazebo/model_states", MODEL_STATES), MODEL_STATES_RATE, dt)
        self._world = world

    def act(self, state: State) -> None:
        """Publish the messages that are due, if there are subscribers."""
        if self.topics[0].subscribers:
            super().act(state)
        else:
            self.reset(state.step)

    def message(self, state: State) -> Callable[[], Any]:
        """Return what builds the message of this moment, also later."""
        world = self._world
        names = world.names
        states = [(world.pose(name), world.twist(name)) for name in names]

        def build() -> Any:
            poses = [pose_message(each[:3], each[3:]) for each, _ in states]
            twist = message_type("geometry_msgs/msg/Twist")
            twists = [twist(vector(each[:3]), vector(each[3:])) for _, each in states]
            return message_type(MODEL_STATES)(list(names), poses, twists)

        return build
