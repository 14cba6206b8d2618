"""Kinematics: a robot's model, its configurations by name, and the poses of its links.

``q`` and ``v`` are those of `Kinematics.model`: every movable joint has its place in them, in Pinocchio's order, mimic
joints included. A continuous joint takes two numbers in ``q`` (cosine and sine), a planar joint four (x, y, cosine,
sine), a floating joint and a floating base seven (x y z, quaternion x y z w). By name every joint is one number, and a
planar or floating joint one number per variable, named as MoveIt names them (``joint/x``, ``joint/theta``,
``joint/rot_w``, ...).
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.description import Robot, load
from urdfkit.errors import KinematicsError
from urdfkit.kinematics.joint_limits import JointLimitError, position_limits
from urdfkit.kinematics.joint_variables import finite, index_variables, rates, unit_pose
from urdfkit.kinematics.mimic import Coupling, couplings
from urdfkit.kinematics.pinocchio_model import ForwardKinematics, build_model, pin
from urdfkit.kinematics.variable_names import require_independent, unknown_frame, unknown_variable
from urdfkit.linear_algebra import Array, matmul

SMALL = 100
"""Degrees of freedom up to which poses are computed with ``pin.Data``, which takes 40 MB for so many."""
LARGE = 500
"""Degrees of freedom up to which ``pin.Data`` is created, which takes 4 GB for so many."""


class Kinematics:
    """Kinematic model of a robot: configurations by joint name, link poses and limits.

    Args:
        robot: a loaded robot, a file, a package folder or the name of a bundled robot; see `urdfkit.load`.
        floating_base: put a free-flyer above the root link; its frame is the root link's.

    Raises:
        UrdfkitError: the robot cannot be loaded.
        KinematicsError: the robot is not one tree, or a mimic or an axis makes no sense.

    Attributes:
        robot: the robot as written.
        model: ``pin.Model``.
        root: name of the root link.
        floating_base: whether q starts with the pose of the root link.
        couplings: mimic joint → its `Coupling`.
        joint_names: independent joints of one degree of freedom, in the order of q.
        mimic_names: joints that follow another one, in the order of q.
        several_names: planar and floating joints, in the order of q.
        variable_names: names for `configuration`: `joint_names` and the variables of planar and floating joints.
        link_names: all links in document order.

    Examples:
        >>> import urdfkit
        >>> arm = urdfkit.Kinematics("seven_dof_arm")
        >>> arm.limits("elbow_pitch_joint")  # [rad]
        (-1.595, 1.933)
        >>> q = arm.configuration({"elbow_pitch_joint": 0.5})
        >>> float(q[arm.configuration_index("elbow_pitch_joint")]), arm.positions(q)["elbow_pitch_joint"]
        (0.5, 0.5)
        >>> poses = arm.link_poses(q)
        >>> poses[arm.link_names.index("grasping_frame")].round(2)  # x y z [m] and quaternion x y z w
        array([ 0.21,  0.  ,  0.79,  0.  , -0.51,  0.  ,  0.86])
        >>> arm.placements(arm.neutral())[arm.frame("grasping_frame")].translation.round(2)  # upright
        array([0.  , 0.  , 0.84])
        >>> v = arm.velocity({"elbow_pitch_joint": 0.1})
        >>> float(v[arm.velocity_index("elbow_pitch_joint")]), arm.velocities(v)["elbow_pitch_joint"]
        (0.1, 0.1)
        >>> float(arm.gravity(q)[arm.velocity_index("elbow_pitch_joint")].round(2))  # [N·m]
        -1.22
    """

    def __init__(self, robot: Robot | str | Path, *, floating_base: bool = False) -> None:
        self.robot = robot = load(robot)
        self.floating_base = floating_base
        self.couplings: dict[str, Coupling] = couplings(robot)
        self.model: Any = build_model(robot, floating_base=floating_base)
        self._large: ForwardKinematics | None = ForwardKinematics(self.model) if self.model.nv > SMALL else None
        self.root: str = robot.roots()[0].name
        self.link_names: tuple[str, ...] = tuple(link.name for link in robot.link_by_name_in_order())
        first = 2 if floating_base else 1  # after the universe and the free-flyer
        self._joint_ids = {name: i for i, name in enumerate(self.model.names) if i >= first}
        self._variables = index_variables(robot, self.model, self._joint_ids)
        single = [name for name in self._joint_ids if name in self._variables]
        self.joint_names: tuple[str, ...] = tuple(name for name in single if name not in self.couplings)
        self.mimic_names: tuple[str, ...] = tuple(name for name in single if name in self.couplings)
        self.several_names: tuple[str, ...] = tuple(name for name in self._joint_ids if name not in self._variables)
        self.variable_names: tuple[str, ...] = tuple(name for name in self._variables if name not in self.couplings)
        self._frames = {name: int(self.model.getFrameId(name, pin.BODY)) for name in self.link_names}

    def __repr__(self) -> str:
        """Return the name of the robot and the sizes of the model."""
        nq, nv = self.model.nq, self.model.nv
        return f"<Kinematics of {self.robot.name}: {len(self.link_names)} links, nq = {nq}, nv = {nv}>"

    @cached_property
    def data(self) -> Any:
        """``pin.Data``, overwritten by every query.

        Raises:
            KinematicsError: the robot has more than `LARGE` degrees of freedom.

        Examples:
            >>> import pinocchio
            >>> import urdfkit
            >>> arm = urdfkit.Kinematics("rrbot")
            >>> pinocchio.crba(arm.model, arm.data, arm.neutral()).round(2)  # mass matrix
            array([[2.53, 0.86],
                   [0.86, 0.38]])
        """
        if self.model.nv > LARGE:
            raise KinematicsError(
                f"robot `{self.robot.name}` has {self.model.nv} degrees of freedom; dynamics are computed for at most "
                f"{LARGE}, because the memory of Pinocchio grows with the third power of their number"
            )
        return self.model.createData()

    # Configurations and velocities by name

    def neutral(self) -> Array:
        """Return the configuration with every joint at zero and mimic joints as coupled; shape (nq,)."""
        return self.configuration()

    def configuration(
        self, positions: Mapping[str, float] | None = None, *, base: Array | None = None, check_limits: bool = False
    ) -> Array:
        """Return the configuration with these joint positions, the others at zero, mimic joints following; shape (nq,).

        Args:
            positions: joint or variable name → position [rad] or [m].
            base: pose of a floating root link, x y z [m] and quaternion x y z w; the identity when None.
            check_limits: refuse positions outside the limits, those of mimic joints included.

        Raises:
            KinematicsError: an unknown name, a mimic joint, a position that is no finite number, or a `base` of a robot
                whose root link does not float.
            JointLimitError: `check_limits` is set and a position is outside its limits.
        """
        q: Array = pin.neutral(self.model)
        values = self.followed(positions or {})
        if check_limits and (errors := self.limit_errors(values)):
            raise errors[0]
        for name, value in values.items():
            self._variables[name].put(q, value)
        for name, i in self._joint_ids.items():
            if self.robot.joint_by_name[name].type == "floating":
                start = int(self.model.idx_qs[i])
                q[start : start + 7] = unit_pose(q[start : start + 7])
        if base is not None:
            self._require_floating()
            q[:7] = unit_pose(base)
        return q

    def followed(self, positions: Mapping[str, float]) -> dict[str, float]:
        """Return all joint and variable positions, mimic joints included, when these are set and the others at zero.

        Unlike `positions` of a configuration, continuous joints keep full turns.

        Raises:
            KinematicsError: an unknown name, a mimic joint, a position that is no finite number.

        Examples:
            >>> import urdfkit
            >>> urdfkit.Kinematics("gripper.urdf").followed({"right_finger_joint": 0.02})["left_finger_joint"]
            -0.02
        """
        values = {name: variable.zero for name, variable in self._variables.items()}
        for name, position in positions.items():
            values[self._own(name)] = finite(name, position)
        for name, coupling in self.couplings.items():
            values[name] = coupling.offset
            if coupling.master is not None:
                values[name] += coupling.multiplier * values[coupling.master]
        return values

    def positions(self, q: Array) -> dict[str, float]:
        """Return joint or variable name → position [rad] or [m], mimics included; a continuous joint in (-π, π]."""
        return {name: variable.get(q) for name, variable in self._variables.items()}

    def velocities(self, v: Array) -> dict[str, float]:
        """Return joint name → velocity [rad/s] or [m/s] of the joints of one degree of freedom, mimics included."""
        return {name: float(v[self.velocity_index(name)]) for name in self._joint_ids if name in self._variables}

    def velocity(
        self, velocities: Mapping[str, float] | None = None, *, base: Array | None = None, q: Array | None = None
    ) -> Array:
        """Return v for these velocities, the others at zero, mimic joints following; shape (nv,).

        Args:
            velocities: joint or variable name → velocity [rad/s] or [m/s]; the numbers of a quaternion have none.
            base: twist of a floating root link in its own axes, linear first; zero when None.
            q: configuration that gives the orientation of planar and floating joints; `neutral` when None.

        Raises:
            KinematicsError: an unknown name, a mimic joint, a velocity that is no finite number or none at all, or a
                `base` of a robot whose root link does not float.
        """
        u = np.zeros(len(self.independent))
        column = {int(i): k for k, i in enumerate(self.independent)}
        along: dict[str, dict[str, float]] = {}
        for name, value in (velocities or {}).items():
            value = finite(name, value, quantity="velocity")
            if self._own(name) in self._joint_ids:
                u[column[self.velocity_index(name)]] = value
            else:
                joint, _, part = name.rpartition("/")
                if part.startswith("rot_"):
                    raise KinematicsError(f"`{name}` is one number of a quaternion: it has no separate velocity")
                along.setdefault(joint, {})[part] = value
        q = self.neutral() if q is None else q
        for joint, parts in along.items():
            found = rates(self.robot.joint_by_name[joint].type or "", q[self.configuration_index(joint) :], parts)
            first = column[self.velocity_index(joint)]
            u[first : first + len(found)] = found
        if base is not None:
            self._require_floating()
            u[:6] = base
        v: Array = matmul(self.mimic_matrix, u)
        return v

    def configuration_index(self, joint: str) -> int:
        """Return the first index of a joint in q.

        Raises:
            KinematicsError: no such movable joint.
        """
        return int(self.model.idx_qs[self._joint_id(joint)])

    def velocity_index(self, joint: str) -> int:
        """Return the first index of a joint in v.

        Raises:
            KinematicsError: no such movable joint.
        """
        return int(self.model.idx_vs[self._joint_id(joint)])

    # Mimic joints

    @cached_property
    def independent(self) -> NDArray[np.int64]:
        """Indices in v of the independent velocities, i.e. all but mimic joints; shape (nv - number of mimics,).

        Examples:
            >>> import urdfkit
            >>> gripper = urdfkit.Kinematics("gripper.urdf")
            >>> gripper.model.nv, gripper.independent.tolist()
            (5, [0, 1, 2, 4])
        """
        follows = {self.velocity_index(name) for name in self.mimic_names}
        return np.array([i for i in range(self.model.nv) if i not in follows], dtype=np.int64)

    @cached_property
    def mimic_matrix(self) -> Array:
        """G with v = G·v[independent]; shape (nv, nv - number of mimics), read-only.

        With M and h of the full model, Gᵀ·M·G and Gᵀ·h are those of the robot whose mimic joints follow exactly.

        Examples:
            >>> import urdfkit
            >>> urdfkit.Kinematics("gripper.urdf").mimic_matrix
            array([[ 1.,  0.,  0.,  0.],
                   [ 0.,  1.,  0.,  0.],
                   [ 0.,  0.,  1.,  0.],
                   [ 0.,  0.,  0., -1.],
                   [ 0.,  0.,  0.,  1.]])
        """
        column = {int(i): k for k, i in enumerate(self.independent)}
        G = np.zeros((self.model.nv, len(column)))
        for i, k in column.items():
            G[i, k] = 1.0
        for name, coupling in self.couplings.items():
            if coupling.master is not None:
                G[self.velocity_index(name), column[self.velocity_index(coupling.master)]] = coupling.multiplier
        G.flags.writeable = False
        return G

    # Limits

    def limits(self, joint: str) -> tuple[float, float]:
        """Return the lower and upper position of a joint [rad] or [m]; infinite without a limit.

        Raises:
            KinematicsError: no such movable joint.
        """
        self._joint_id(joint)
        return position_limits(self.robot.joint_by_name[joint])

    def limit_errors(self, positions: Mapping[str, float]) -> list[JointLimitError]:
        """Return an error, not raised, for each position outside its limits (a joint may be at its limit).

        Examples:
            >>> import urdfkit
            >>> for error in urdfkit.Kinematics("seven_dof_arm").limit_errors({"elbow_pitch_joint": 9.0}):
            ...     print(error)
            joint `elbow_pitch_joint` at 9 rad is outside its limits [-1.595, 1.933] rad
        """
        found = []
        for name, value in positions.items():
            if name in self._joint_ids:
                lower, upper = self.limits(name)
                if not lower <= value <= upper:
                    found.append(JointLimitError(self.robot.joint_by_name[name], value, lower, upper))
        return found

    # Frames

    def frame(self, name: str) -> int:
        """Return Pinocchio's frame id of a link.

        Raises:
            KinematicsError: no link of that name.
        """
        if name not in self._frames:
            raise KinematicsError(unknown_frame(self.robot, name))
        return self._frames[name]

    def link_poses(self, q: ArrayLike) -> Array:
        """Return x y z [m] and quaternion x y z w of all links in the world, as `link_names` has them; shape (n, 7).

        Raises:
            KinematicsError: `q` is no configuration of this robot.
        """
        try:
            values = np.asarray(q, dtype=float)
        except (TypeError, ValueError):
            values = np.zeros(0)
        if values.shape != (self.model.nq,):
            raise KinematicsError(f"q is {q!r}; robot `{self.robot.name}` needs {self.model.nq} numbers")
        placements = self.placements(values)
        poses = np.empty((len(self._frames), 7))
        for row, frame in enumerate(self._frames.values()):
            poses[row] = pin.SE3ToXYZQUAT(placements[frame])
        return poses

    def placements(self, q: Array) -> Sequence[Any]:
        """Return the ``pin.SE3`` of every frame of the model in the world; valid until the next query."""
        if self._large is not None:
            return self._large.placements(q)
        pin.framesForwardKinematics(self.model, self.data, q)
        placements: Sequence[Any] = self.data.oMf
        return placements

    # Dynamics

    def gravity(self, q: Array) -> Array:
        """Return the efforts that hold the robot at rest against gravity [N·m] or [N], as v orders them; shape (nv,).

        A mimic joint has an effort of its own; ``mimic_matrix.T @ gravity(q)`` are those of the joints that lead.

        Raises:
            KinematicsError: the robot has more than `LARGE` degrees of freedom.
        """
        return np.array(pin.computeGeneralizedGravity(self.model, self.data, q))

    # Errors for unknown names

    def _joint_id(self, joint: str) -> int:
        if joint not in self._joint_ids:
            raise KinematicsError(unknown_variable(self.robot, self.couplings, self._variables, joint))
        return self._joint_ids[joint]

    def _own(self, name: str) -> str:
        """Return the name if it is a variable that moves on its own."""
        return require_independent(self.robot, self.couplings, self._variables, name)

    def _require_floating(self) -> None:
        if not self.floating_base:
            raise KinematicsError(f"root link `{self.root}` of robot `{self.robot.name}` has no floating base")
