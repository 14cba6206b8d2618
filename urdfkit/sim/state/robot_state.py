"""State of a robot: configuration, velocity, efforts and contacts; read-only, for plugins, subscribers and users."""

from collections.abc import Callable, Sequence

from urdfkit.errors import SimulationError, UnknownNameError, did_you_mean
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import Array
from urdfkit.sim.engine import Contact, Engine
from urdfkit.sim.engine.articulation import Articulation
from urdfkit.sim.engine.scalar_views import numbers
from urdfkit.sim.state.configuration_snapshot import Snapshot
from urdfkit.sim.state.odometer import Odometer
from urdfkit.sim.state.poses_and_energy import energy_of, in_the_world, pose_and_twist

MOST_SHOWN = 6
"""Joints in the `repr` of a state."""
_SET_POSITIONS = (
    "state.q is read-only: set positions with Simulator(…, spawn=Spawn(joints=…)) "
    "at the start, or with simulator.world.robots[NAME].place_joints(…)"
)
_SET_VELOCITIES = "state.v is read-only: set velocities with Simulator(…, spawn=Spawn(twist=…, velocities=…))"


class State:
    """Read-only view of the present state of a robot in the simulation.

    Args:
        kinematics: the robot's model.
        engine: the physics engine.
        base: pose of the root link of a robot with a fixed base; None for a floating base.
        articulation: the engine's articulation of this robot; the first one when None.

    Attributes:
        step: number of steps since the start.
        odometer: the wheel odometry that the engine integrates.

    Examples:
        >>> import urdfkit
        >>> simulator = urdfkit.Simulator("simpleton")
        >>> state, start = simulator.state, simulator.state.snapshot()
        >>> simulator.command(linear=(0.5, 0.0, 0.0))
        >>> simulator.run(2.0)
        >>> state.t, round(state.position("left_wheel_joint"), 2), round(state.velocity("left_wheel_joint"), 2)
        (2.0, 9.64, 5.0)
        >>> abs(state.effort("left_wheel_joint")) < 1e-6  # at a constant velocity
        True
        >>> round(state.base_pose[0], 2), round(state.base_twist[0], 2), round(state.base_velocity[0], 2)
        (0.96, 0.5, 0.5)
        >>> (state.link_poses() - start.link_poses())[0, :1].round(2)  # way of the root link along x [m]
        array([0.96])
        >>> sorted({contact.a for contact in state.contacts})
        ['caster', 'left_wheel', 'right_wheel']
        >>> [round(energy, 2) for energy in state.energy]
        [0.22, 2.03]
        >>> state.q.shape, state.v.shape, state.tau.shape
        ((11,), (8,), (8,))
    """

    def __init__(
        self, kinematics: Kinematics, engine: Engine, base: Array | None, articulation: Articulation | None = None
    ) -> None:
        self._kinematics = kinematics
        self._base = base
        self.step = 0
        names = (*kinematics.joint_names, *kinematics.mimic_names)
        self._index = {name: kinematics.velocity_index(name) for name in names}
        self.attach(engine, articulation)

    def __repr__(self) -> str:
        """Return time, base position and joint positions."""
        x, y, z = self._shown_position()
        joints = "".join(f", {name} {self.position(name):.3g}" for name in list(self._index)[:MOST_SHOWN])
        more = ", …" if len(self._index) > MOST_SHOWN else ""
        return f"<State at t = {self.t:g} s: base at {x:.3g} {y:.3g} {z:.3g} m{joints}{more}>"

    def _repr_html_(self) -> str:
        """Return a table of the joints, for notebooks."""
        from html import escape

        rows = "".join(
            f"<tr><td>{escape(name)}</td><td>{self.position(name):.4g}</td><td>{self.velocity(name):.4g}</td>"
            f"<td>{self.effort(name):.4g}</td></tr>"
            for name in self._index
        )
        x, y, z = self._shown_position()
        return (
            f"<p>t = {self.t:g} s, base at {x:.4g} {y:.4g} {z:.4g} m</p><table><tr><th>joint</th>"
            f"<th>position [rad, m]</th><th>velocity [rad/s, m/s]</th><th>effort [N·m, N]</th></tr>{rows}</table>"
        )

    def _shown_position(self) -> tuple[float, ...]:
        return tuple(round(value, 9) + 0.0 for value in self.base_pose[:3])  # no -5.562e-17 of a robot on the ground

    def attach(self, engine: Engine, articulation: Articulation | None = None) -> None:
        """Read from another engine from now on, which simulates the same robot in a changed world.

        Examples:
            >>> import urdfkit
            >>> simulator = urdfkit.Simulator("simpleton")
            >>> simulator.state.attach(simulator.world.builder.engine)  # as the world does when an entity is spawned
        """
        self._engine = engine
        self._articulation: Articulation = engine if articulation is None else articulation
        self._snapshot: Snapshot | None = None
        self._pose: tuple[float, ...] | None = None
        arrays, tree = engine.arrays, self._articulation.tree
        dof = int(arrays["tree_dof"][tree])
        first = int(arrays["tree_s"][tree])
        self._at = {name: int(arrays["dof_s"][dof + k]) - first for name, k in self._index.items()}
        self.odometer = Odometer(arrays, tree)
        self._coordinates, self._velocities = numbers(self._articulation.coordinates), numbers(self._articulation.v)
        self._efforts, self._applied = numbers(self._articulation.effort), numbers(self._articulation.applied)

    def coordinate(self, joint: str) -> int:
        """Return the number of a joint's position among the coordinates of the robot in the engine.

        Raises:
            KeyError: no joint of that name with one degree of freedom.

        Examples:
            >>> import urdfkit
            >>> state = urdfkit.Simulator("simpleton").state
            >>> float(state.snapshot().coordinates[state.coordinate("left_wheel_joint")])
            0.0
        """
        return self._at[joint]

    def advance(self, steps: int) -> None:
        """Advance the step count by `steps` and drop cached values; call after the engine has stepped.

        Examples:
            >>> import urdfkit
            >>> simulator = urdfkit.Simulator("simpleton")
            >>> simulator.world.builder.engine.step(5)
            >>> simulator.state.advance(5)
            >>> simulator.state.t
            0.005
        """
        self.step += steps
        self._snapshot = self._pose = None

    @property
    def t(self) -> float:
        """Simulated time [s]."""
        return self.step * self._engine.dt

    @property
    def q(self) -> Array:
        """Configuration, in the order of `Kinematics`, read-only; shape (nq,)."""
        q = self._articulation.q
        q.flags.writeable = False
        return q

    @q.setter
    def q(self, value: object) -> None:
        raise SimulationError(_SET_POSITIONS)

    @property
    def v(self) -> Array:
        """Velocity [rad/s] or [m/s], read-only; shape (nv,). That of a floating base is in its axes, linear first."""
        return self._articulation.v

    @v.setter
    def v(self, value: object) -> None:
        raise SimulationError(_SET_VELOCITIES)

    @property
    def tau(self) -> Array:
        """Efforts of the last step without those of contacts and limits [N·m] or [N], read-only; shape (nv,)."""
        return self._articulation.tau

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """Contacts between all bodies of the world in the last step."""
        return self._engine.contacts()

    @property
    def energy(self) -> tuple[float, float]:
        """Kinetic and potential energy of the robot [J]; the potential energy is zero at the world's origin."""
        if self._articulation is self._engine:
            return self._engine.energy()
        own, gravity = self._articulation, self._engine.arrays["gravity"]
        return energy_of(self._kinematics, own.q, own.v, self._base, gravity, own.weightless)

    def position(self, joint: str) -> float:
        """Return a joint's position [rad] or [m]; the position of a continuous joint is not wrapped.

        Raises:
            UnknownNameError: no joint of that name with one degree of freedom.
        """
        try:
            found: float = self._coordinates[self._at[joint]]
        except KeyError:
            raise self._no_joint(joint) from None
        return found

    def velocity(self, joint: str) -> float:
        """Return a joint's velocity [rad/s] or [m/s].

        Raises:
            UnknownNameError: no joint of that name with one degree of freedom.
        """
        try:
            found: float = self._velocities[self._index[joint]]
        except KeyError:
            raise self._no_joint(joint) from None
        return found

    def effort(self, joint: str) -> float:
        """Return the total effort of a joint's motor, its servo and applied efforts in the last step [N·m] or [N].

        Raises:
            UnknownNameError: no joint of that name with one degree of freedom.
        """
        try:
            index = self._index[joint]
        except KeyError:
            raise self._no_joint(joint) from None
        found: float = self._efforts[index] + self._applied[index]
        return found

    def several(self, joint: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Return pose and velocity of a planar or floating joint, both in the joint's frame in the parent link.

        Returns:
            x y z [m] and quaternion x y z w of the child link; its velocity [m/s] and angular velocity [rad/s].

        Raises:
            UnknownNameError: no planar or floating joint of that name.

        Examples:
            >>> import urdfkit
            >>> from urdfkit.sim import Spawn
            >>> start = Spawn(joints={"table_joint/x": 0.5}, velocities={"table_joint/x": 0.1})
            >>> simulator = urdfkit.Simulator("gripper.urdf", spawn=start, note=lambda text: None)
            >>> pose, twist = simulator.state.several("table_joint")
            >>> pose[:3], twist[:3]
            ((0.5, 0.0, 0.0), (0.1, 0.0, 0.0))
        """
        kinematics = self._kinematics
        if joint not in kinematics.several_names:
            raise UnknownNameError(
                f"no planar or floating joint `{joint}` in robot `{kinematics.robot.name}`"
                f"{did_you_mean(str(joint), kinematics.several_names)}"
            )
        return pose_and_twist(
            kinematics.robot.joint_by_name[joint].type or "",
            self.q[kinematics.configuration_index(joint) :].tolist(),
            self.v[kinematics.velocity_index(joint) :].tolist(),
        )

    def _no_joint(self, joint: str) -> UnknownNameError:
        robot = self._kinematics.robot
        if joint in robot.joint_by_name:
            return UnknownNameError(f"joint `{joint}` is {robot.joint_by_name[joint].type}: it has no single position")
        return UnknownNameError(f"no joint `{joint}` in robot `{robot.name}`{did_you_mean(str(joint), self._index)}")

    @property
    def base_pose(self) -> tuple[float, ...]:
        """Pose of the root link in the world: x y z [m] and quaternion x y z w."""
        if self._pose is None:
            if self._base is None:
                self._pose = tuple(self._coordinates[:7].tolist())
            else:
                self._pose = tuple(self._base.tolist())
        return self._pose

    @property
    def base_twist(self) -> tuple[float, ...]:
        """Velocity [m/s] and angular velocity [rad/s] of the root link, along the axes of the link."""
        return (0.0,) * 6 if self._base is not None else tuple(self._velocities[:6].tolist())

    @property
    def base_velocity(self) -> tuple[float, ...]:
        """Velocity [m/s] of the root link's origin and angular velocity [rad/s], along the axes of the world."""
        return (0.0,) * 6 if self._base is not None else in_the_world(self.base_pose, self.base_twist)

    def keep_joints(self, joints: Sequence[str]) -> Callable[[], tuple[Array, Array, Array]]:
        """Return a function that gives the positions, velocities and efforts of joints at this time; shapes (n,).

        Args:
            joints: names of joints with one degree of freedom.

        Examples:
            >>> import urdfkit
            >>> simulator = urdfkit.Simulator("simpleton")
            >>> joints_at_start = simulator.state.keep_joints(["left_wheel_joint"])
            >>> simulator.command(linear=(0.5, 0.0, 0.0))
            >>> simulator.run(1.0)
            >>> positions, velocities, efforts = joints_at_start()
            >>> positions
            array([0.])
        """
        coordinates, velocities = self.snapshot().coordinates, self._articulation.v.copy()
        efforts = self._articulation.effort + self._articulation.applied
        at, index = self._at, self._index

        def build() -> tuple[Array, Array, Array]:
            dofs = [index[name] for name in joints]
            return coordinates[[at[name] for name in joints]], velocities[dofs], efforts[dofs]

        return build

    def snapshot(self) -> Snapshot:
        """Return a copy of the present configuration; calls within one step return the same object."""
        if self._snapshot is None:
            self._snapshot = Snapshot(self._kinematics, self.t, self._engine, self._articulation)
        return self._snapshot

    def link_poses(self) -> Array:
        """Return x y z [m] and quaternion x y z w of every link in the world, read-only; shape (n_links, 7).

        The array keeps the poses of this moment: the next step does not change it.
        """
        return self.snapshot().link_poses()
