"""Handle to one rigid body of the world; stays valid while other entities are spawned or removed."""

from collections.abc import Sequence

from urdfkit.description.urdf.robot import Pose
from urdfkit.sim.engine import Body
from urdfkit.sim.state.poses import pose_of
from urdfkit.sim.world.entity_poses import AT_REST, move_body
from urdfkit.sim.world.external_forces import ZERO, ExternalForces
from urdfkit.sim.world.world_builder import WorldBuilder


class RigidBody:
    """Rigid body of the world.

    Args:
        builder: the world's.
        forces: the world's.
        name: of the body.
    """

    def __init__(self, builder: WorldBuilder, forces: ExternalForces, name: str) -> None:
        self._builder, self._forces = builder, forces
        self.name = name

    def __repr__(self) -> str:
        """Return name and position, or that the body was removed."""
        if self.name not in self._builder.body_names:
            return f"<RigidBody {self.name}: removed>"
        x, y, z = self.pose[:3]
        return f"<RigidBody {self.name} at {x:.3g} {y:.3g} {z:.3g} m>"

    @property
    def body(self) -> Body:
        """Mass, inertia, shapes and initial pose, as the engine got them.

        Raises:
            UnknownNameError: the body was removed.
        """
        return self._builder.body(self.name)

    @property
    def pose(self) -> tuple[float, ...]:
        """Pose in the world: x y z [m] and quaternion x y z w."""
        free = self._builder.free_bodies
        return free[self.name].pose if self.name in free else tuple(self.body.pose)

    @property
    def twist(self) -> tuple[float, ...]:
        """Velocity of the body's origin [m/s] and angular velocity [rad/s], along the world's axes."""
        free = self._builder.free_bodies
        if self.name in free:
            return free[self.name].twist
        self.body  # noqa: B018 - raises if the body was removed
        return AT_REST

    @property
    def asleep(self) -> bool:
        """Whether the body is free to move, but at rest and not simulated until something wakes it."""
        free = self._builder.free_bodies
        return self.name in free and free[self.name].asleep

    def place(self, pose: Pose | Sequence[float], twist: Sequence[float] = AT_REST) -> None:
        """Place the body, see `LiveWorld.place`."""
        move_body(self._builder, self.name, pose_of(pose), twist)

    def push(
        self,
        force: Sequence[float] = ZERO,
        torque: Sequence[float] = ZERO,
        *,
        at: Sequence[float] = ZERO,
        for_seconds: float | None = None,
    ) -> None:
        """Push the body, see `LiveWorld.push`."""
        self._forces.push(self.name, force, torque, at=at, for_seconds=for_seconds)

    def release(self) -> None:
        """End all pushes on the body."""
        self._forces.release(self.name)
