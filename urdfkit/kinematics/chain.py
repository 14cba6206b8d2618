"""Chain: forward and inverse kinematics of the joints between two links, for many configurations at once."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from urdfkit.description import Robot, load
from urdfkit.errors import KinematicsError
from urdfkit.kinematics.serial.kernel.native_code import Compiling, function
from urdfkit.kinematics.serial.serial_chain import SerialChain
from urdfkit.kinematics.serial.serial_solver import APPROACHES, FURTHER, ROW, SerialSolver, SolverOptions
from urdfkit.kinematics.serial.solutions import Solutions
from urdfkit.linear_algebra import Array

if TYPE_CHECKING:
    from urdfkit.kinematics.self_collision.collision_free_search import CollisionFreeSearch
    from urdfkit.kinematics.torch_chain import TorchChain

TOLERANCE = (1e-3, 1.745e-3)
"""Distance [m] and angle [rad] within which a target is reached: 1 mm and 0.1°."""
FEW = 64
"""Targets per thread below which a thread takes longer to start than to solve."""


class Chain:
    """Kinematic chain of a robot from a base link to a tip link.

    Configurations are arrays of the last axis n, one number per entry of `joint_names`; results keep the other axes, so
    one configuration (n,) has one pose (4, 4), and N configurations (N, n) have N poses (N, 4, 4). Other shapes are a
    KinematicsError.

    Args:
        robot: a loaded robot, a file, a package folder or the name of a bundled robot; see `urdfkit.load`.
        base: name of the link in which poses are expressed; the root link when None.
        tip: name of the link whose poses are computed.
        hold: name of a joint of the chain → its position [rad] or [m]; such joints do not move.
        compiling: called with a message before the kernel is compiled, once per machine and version.

    Raises:
        UrdfkitError: the robot cannot be loaded.
        KinematicsError: an unknown link or joint, or no joint moves the tip relative to the base.
        MissingDependencyError: numba is not installed.

    Attributes:
        robot: the robot.
        base: name of the base link.
        tip: name of the tip link.
        joint_names: the independent joints in the order from base to tip; a planar joint has ``joint/x``, ``joint/y``
            and ``joint/theta``.
        lower: lower limits [rad] or [m], minus infinity without one; shape (n,).
        upper: upper limits [rad] or [m], infinity without one; shape (n,).

    Examples:
        >>> import numpy as np
        >>> from urdfkit.kinematics import Chain
        >>> arm = Chain("seven_dof_arm", None, "grasping_frame")
        >>> q = arm.configuration({"elbow_pitch_joint": 0.5})
        >>> target = arm.forward(q)
        >>> found = arm.solve(target)
        >>> bool(found.reached), bool(np.allclose(arm.forward(found.q), target, atol=2e-3))
        (True, True)
        >>> poses, jacobians = arm.forward_and_jacobian([q, found.q])
        >>> poses.shape, jacobians.shape
        ((2, 4, 4), (2, 6, 7))
        >>> bool((jacobians[0] == arm.jacobian(q)).all())
        True
        >>> float(arm.manipulability(q).round(3))
        0.002
    """

    def __init__(
        self,
        robot: Robot | str | Path,
        base: str | None,
        tip: str,
        *,
        hold: Mapping[str, float] | None = None,
        compiling: Compiling | None = None,
    ) -> None:
        self.serial = SerialChain(load(robot), base, tip, hold=hold)
        self.robot, self.base, self.tip = self.serial.robot, self.serial.base, tip
        self.joint_names = tuple(variable.name for variable in self.serial.variables)
        self.lower: Array = np.array([variable.lower for variable in self.serial.variables])
        self.upper: Array = np.array([variable.upper for variable in self.serial.variables])
        steps, indices, limits = self.serial.steps, self.serial.indices, self.serial.limits
        self._count, self._size = len(indices), len(self.joint_names)
        self._chain = (steps.buffer_info()[0], indices.buffer_info()[0], self._count, self._size)
        self._limits = limits.buffer_info()[0]
        self._compiling = compiling
        self._memory = threading.local()
        self._start = np.array(self.serial.start())

    def __repr__(self) -> str:
        """Return the links at both ends and the joints."""
        return f"<Chain {self.base} → {self.tip} of {self.robot.name}: {', '.join(self.joint_names)}>"

    def configuration(self, positions: Mapping[str, float] | None = None) -> Array:
        """Return the configuration with these positions, other joints in the middle of their limits; shape (n,).

        Args:
            positions: name of a joint → position [rad] or [m]; joints outside the chain are ignored.

        Raises:
            KinematicsError: an unknown name, a mimic joint, or a position that is not a finite number.
        """
        return np.array(self.serial.start(positions))

    def forward(self, q: ArrayLike) -> Array:
        """Return the poses of the tip in the base, as homogeneous matrices; shape (N, 4, 4)."""
        q = self._configurations(q)
        poses = np.empty((*q.shape[:-1], 4, 4))
        self._compute(q, poses, None, 1)
        return poses

    def jacobian(self, q: ArrayLike) -> Array:
        """Return the Jacobians at the tip in the axes of the base, linear rows first; shape (N, 6, n)."""
        q = self._configurations(q)
        jacobians = np.empty((*q.shape[:-1], 6, self._size))
        self._compute(q, None, jacobians, 2)
        return jacobians

    def forward_and_jacobian(self, q: ArrayLike) -> tuple[Array, Array]:
        """Return both `forward` and `jacobian`, in less time than one after the other."""
        q = self._configurations(q)
        poses, jacobians = np.empty((*q.shape[:-1], 4, 4)), np.empty((*q.shape[:-1], 6, self._size))
        self._compute(q, poses, jacobians, 3)
        return poses, jacobians

    def manipulability(self, q: ArrayLike, *, position_only: bool = False) -> Array:
        """Return Yoshikawa's measure √det(J·Jᵀ), the product of the singular values of the Jacobian; shape (N,).

        Args:
            q: configurations.
            position_only: use the linear rows only.
        """
        q = self._configurations(q)
        values = np.empty(q.shape[:-1])
        self._compute(q, values, None, 12 if position_only else 4)
        return values

    def solve(
        self,
        targets: ArrayLike,
        seeds: ArrayLike | None = None,
        *,
        position_only: bool = False,
        tolerance: tuple[float, float] = TOLERANCE,
        prefer: str = "first",
        restarts: int = 200,
        seed: int = 0,
        threads: int | None = None,
        approach: bool = True,
        collision_free: bool = False,
        further: int = FURTHER,
    ) -> Solutions:
        """Find configurations that place the tip at targets, within the limits of the joints.

        The result for a target depends on that target, its seed and the options only: neither on the other targets nor
        on the number of threads.

        Args:
            targets: poses of the tip in the base: x y z [m] and a quaternion x y z w, shape (N, 7), or homogeneous
                matrices, shape (N, 4, 4).
            seeds: configurations to start from, shape (n,) or (N, n); the middle of the limits when None.
            position_only: ignore the orientation.
            tolerance: distance [m] and angle [rad] within which a target is reached.
            prefer: ``first``: the first solution found; ``nearest``: the one nearest to the seed; ``manipulability``:
                the one with the largest manipulability. The latter two compare the solutions of `further` restarts.
            restarts: maximum number of random starts per target.
            seed: number of the random stream.
            threads: number of threads; that of the processors when None.
            approach: compute the nearest configuration for targets that cannot be reached, by distance first, then by
                angle; otherwise any configuration with a small error is returned, in a fifth of the time.
            collision_free: reach targets only without collisions between links; see
                `urdfkit.kinematics.self_collision.configuration_check` for the pairs that are checked.
            further: number of restarts after the first solution; with that of `restarts` all of them are compared, as
                in `solve_all`.

        Raises:
            KinematicsError: an unknown preference, targets or seeds of another shape, or numbers that are no pose.
            ResourceError: `collision_free` is set, and a mesh cannot be read.
        """
        options = SolverOptions(
            position_only, *tolerance, prefer, restarts, seed, APPROACHES if approach else 0, further
        )
        shape, rows = self._solve(targets, seeds, options, 1, threads)
        collisions = None
        if collision_free:
            starts = np.broadcast_to(self._start if seeds is None else seeds, (*shape, self._size))
            poses = np.asarray(targets, dtype=np.float64).reshape(len(rows), -1)
            collisions = self._search.improve(rows[:, 0], poses, starts.reshape(len(rows), -1), options)
        return self._solutions(rows.reshape(*shape, self._size + ROW), collisions)

    def solve_all(
        self,
        target: ArrayLike,
        start: ArrayLike | None = None,
        *,
        position_only: bool = False,
        tolerance: tuple[float, float] = TOLERANCE,
        restarts: int = 200,
        seed: int = 0,
        most: int = 256,
        collision_free: bool = False,
    ) -> Solutions:
        """Find different configurations for one target, with all whole turns that the limits allow, nearest first.

        A chain with more joints than the target has constraints has infinitely many solutions; those of the
        restarts are returned.

        Args:
            target: see `solve`; shape (7,) or (4, 4).
            start: configuration that the solutions are sorted by; the middle of the limits when None.
            position_only: see `solve`.
            tolerance: see `solve`.
            restarts: see `solve`.
            seed: see `solve`.
            most: maximum number of solutions, before whole turns.
            collision_free: see `solve`; solutions with collisions are ignored.

        Returns:
            The solutions; the nearest configuration alone if the target cannot be reached.

        Raises:
            KinematicsError: see `solve`.

        Examples:
            >>> from urdfkit.kinematics import Chain
            >>> arm = Chain("rrbot", None, "camera_link")
            >>> arm.solve_all(arm.forward([0.5, 1.0]), position_only=True).q.round(2)
            array([[ 0.5 ,  1.  ],
                   [ 1.61, -1.22]])
        """
        options = SolverOptions(position_only, *tolerance, "all", restarts, seed)
        numbers = np.asarray(target, dtype=np.float64)
        if numbers.shape not in ((7,), (4, 4)):
            raise KinematicsError(f"solve_all needs one target of shape (7,) or (4, 4); got {numbers.shape}")
        from_ = (self._start if start is None else self._configurations(start)).ravel().tolist()
        solver = SerialSolver(self.serial, self._compiling)
        found = solver.solve(numbers.ravel().tolist(), from_, options, rows=most)
        if collision_free:
            found = self._search.filtered(found)
        if found[0].reached:
            found = solver.with_whole_turns(found, from_)
        return Solutions(
            np.array([solution.q for solution in found]),
            np.array([solution.reached for solution in found]),
            np.array([solution.position_error for solution in found]),
            np.array([solution.rotation_error for solution in found]),
            np.array([float(solution.restarts) for solution in found]),
            [solution.collisions or () for solution in found] if collision_free else None,
        )

    def torch(self, device: Any = "cpu", dtype: Any = None) -> TorchChain:
        """Return this chain with tensors of PyTorch in place of arrays: for gradients, and for a GPU.

        Args:
            device: ``cpu``, ``cuda`` or another device of PyTorch.
            dtype: type of the numbers; ``torch.float64`` when None.

        Raises:
            MissingDependencyError: pytorch-kinematics is not installed.

        Examples:
            >>> import torch
            >>> from urdfkit.kinematics import Chain
            >>> arm = Chain("seven_dof_arm", None, "grasping_frame").torch()
            >>> q = torch.full((7,), 0.3, dtype=torch.float64, requires_grad=True)
            >>> arm.forward(q)[2, 3].backward()  # height of the tip [m]
            >>> q.grad.shape
            torch.Size([7])
        """
        from urdfkit.kinematics.torch_chain import TorchChain

        return TorchChain(self.serial, device, dtype)

    @cached_property
    def _search(self) -> CollisionFreeSearch:
        from urdfkit.kinematics.self_collision.collision_free_search import CollisionFreeSearch

        return CollisionFreeSearch(self.serial)

    # Memory

    def _configurations(self, q: ArrayLike) -> Array:
        q = np.ascontiguousarray(q, dtype=np.float64)
        if q.ndim == 0 or q.shape[-1] != self._size:
            raise KinematicsError(f"configurations of {self!r} have {self._size} numbers; got shape {q.shape}")
        return q

    def _compute(self, q: Array, poses: Array | None, jacobians: Array | None, wanted: int) -> None:
        function("forward", self._compiling)(
            *self._chain,
            q.ctypes.data,
            q.size // self._size,
            poses.ctypes.data if poses is not None else 0,
            jacobians.ctypes.data if jacobians is not None else 0,
            wanted,
            self._work(),
        )

    def _work(self) -> int:
        """Return the address of memory of this thread."""
        try:
            return self._memory.address  # type: ignore[no-any-return]
        except AttributeError:
            self._memory.block = block = np.empty(6 * self._count + 10 * self._size + 8)
            self._memory.address = address = block.ctypes.data
            return address

    def _solve(
        self, targets: ArrayLike, seeds: ArrayLike | None, options: SolverOptions, rows: int, threads: int | None
    ) -> tuple[tuple[int, ...], Array]:
        """Return the shape of the targets and the rows that the kernel writes for them."""
        targets = np.ascontiguousarray(targets, dtype=np.float64)
        shape = targets.shape
        if shape[-1:] == (7,):
            width, shape = 7, shape[:-1]
        elif shape[-2:] == (4, 4):
            width, shape = 16, shape[:-2]
        else:
            raise KinematicsError(f"targets have the shape (N, 7) or (N, 4, 4); got {shape}")
        number = targets.size // width
        stride = 0
        if seeds is None:
            seeds = self._start
        else:
            seeds = self._configurations(seeds)
            if seeds.shape[:-1] == shape and shape:
                stride = self._size
            elif seeds.ndim != 1:
                raise KinematicsError(f"seeds have the shape (n,) or that of the targets, (N, n); got {seeds.shape}")
        result = np.empty((number, rows, self._size + ROW))
        native = function("solve", self._compiling)
        numbers = options.numbers(rows)
        at = targets.ctypes.data
        arguments = (*self._chain, self._limits, at, at, width, seeds.ctypes.data, stride, numbers.buffer_info()[0])
        place = result.ctypes.data

        def part(first: int, last: int) -> int:
            return native(*arguments, first, last, place, self._work())

        workers = 1 if number < 2 * FEW else min(threads or os.cpu_count() or 1, number // FEW)
        invalid = part(0, number) if workers == 1 else in_threads(part, number, workers)
        if invalid:
            where = f" {invalid - 1}" if shape else ""
            raise KinematicsError(
                f"target{where} is not a pose: its numbers must be finite and below 1e6, a quaternion not zero, and a "
                "matrix a rotation"
            )
        return shape, result

    def _solutions(self, rows: Array, collisions: list[tuple[tuple[str, str], ...]] | None) -> Solutions:
        n = self._size
        errors = rows[..., n], rows[..., n + 1]
        return Solutions(rows[..., :n], rows[..., n + 2] > 0.0, *errors, rows[..., n + 3], collisions)


def in_threads(part: Callable[[int, int], int], number: int, workers: int) -> int:
    """Call a function for ranges of a number of targets in several threads; return the smallest result above zero."""
    results: list[int] = []
    block = max(FEW, -(-number // (8 * workers)))
    starts = iter(range(0, number, block))
    lock = threading.Lock()

    def work() -> None:
        while True:
            with lock:
                first = next(starts, None)
            if first is None:
                return
            results.append(part(first, min(first + block, number)))

    others = [threading.Thread(target=work) for _ in range(workers - 1)]
    for thread in others:
        thread.start()
    work()
    for thread in others:
        thread.join()
    return min((result for result in results if result), default=0)
