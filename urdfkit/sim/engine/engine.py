"""Engine: robots, bodies and the ground, advanced in time."""

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from typing import Any

import numpy as np

from urdfkit.compilation.native import bind
from urdfkit.errors import SimulationError
from urdfkit.kinematics.model import Kinematics
from urdfkit.linear_algebra import Array, matmul
from urdfkit.scene import Shape
from urdfkit.sim.engine.articulation import Articulation
from urdfkit.sim.engine.bodies import AT_ORIGIN, Body, Member
from urdfkit.sim.engine.contact_surface import Contact, Ground, Surface
from urdfkit.sim.engine.free_body import FreeBody
from urdfkit.sim.engine.kernel_cache import kernel, world_kernel
from urdfkit.sim.engine.layout.collision_shapes import touching
from urdfkit.sim.engine.layout.required_inertia import require_inertia
from urdfkit.sim.engine.layout.world_arrays import fill
from urdfkit.sim.engine.simulation_memory import ADVANCE, HAS_PAIRS, ITERATED, LINK_POSES, OVERFULL, STEPS, TERMS
from urdfkit.sim.engine.state_conversion import contacts, turning

FLAT = Ground()
"""Default ground, at z = 0."""


class Engine(Articulation):
    """A robot on the ground, and whatever else is in its world, advanced in steps of `dt`.

    Velocities, efforts and all per-dof arrays are in the order of ``kinematics.model``'s ``v``; a floating base has its
    twist in its own axes, linear first. Write `motor_velocity`, `motor_effort`, `applied`, `position_target`, `kp`
    and `kd` in place (``engine.motor_velocity[3] = 1.0``); they hold until written again.

    Args:
        kinematics: the robot; with a floating base it is free; without one, the root link is fixed at `base`.
        shapes: its collision shapes; shapes of another role are ignored.
        dt: length of a step [s].
        gravity: [m/s²].
        ground: the plane under it; None for none.
        surfaces: link name → `Surface`; a link that is not named has mu 1.
        base: pose of the root link of a robot without floating base, x y z [m] and quaternion x y z w.
        self_collide: the robot's links that touch its others, True for all; those with a joint between them never do.
        weightless: the robot's links that gravity does not pull.
        others: more robots.
        bodies: free and static bodies.
        sleep: whether trees at rest may sleep, see `sleep.sleep`; sleeping trees cost no time.

    Raises:
        SimulationError: the robot or a body cannot be simulated, e.g. a link that must move has no mass.

    Attributes:
        dt: [s].
        robots: all robots; the first is this one.
        bodies: name → `FreeBody`, for each body that is free.
        collision_shapes: the shapes that can touch, by their numbers in the engine.
        kernel: the compiled function that advances the two blocks of `arrays`.
    """

    def __init__(
        self,
        kinematics: Kinematics,
        shapes: Sequence[Shape],
        *,
        dt: float = 0.001,
        gravity: tuple[float, float, float] = (0.0, 0.0, -9.81),
        ground: Ground | None = FLAT,
        surfaces: Mapping[str, Surface] | None = None,
        base: Sequence[float] | None = None,
        self_collide: bool | Collection[str] = False,
        weightless: Collection[str] = (),
        others: Sequence[Member] = (),
        bodies: Sequence[Body] = (),
        sleep: bool = True,
    ) -> None:
        if not (math.isfinite(dt) and dt > 0.0):
            raise SimulationError(f"invalid time step {dt:g} s; it must be positive")
        self.ground = ground
        self.dt = float(dt)
        root_pose = AT_ORIGIN if base is None else base
        own = Member(kinematics, shapes, surfaces or {}, root_pose, self_collide, weightless=weightless)
        self._members = (own, *others)
        self._free = tuple(body for body in bodies if not body.static)
        if len({body.name for body in self._free}) < len(self._free):
            names = [body.name for body in self._free]
            twice = next(name for name in names if names.count(name) > 1)
            raise SimulationError(f"there are two bodies called `{twice}`; give each a unique name")
        alone = not (others or bodies or self_collide)
        # Static shapes collide with other trees only, so a single robot on the ground has no pairs.
        self.collision_shapes = [each for each in touching(self._members, bodies) if each.body >= 0 or not alone]
        self.arrays = fill(
            self._members,
            bodies,
            self.collision_shapes,
            dt=dt,
            gravity=gravity,
            ground=ground,
            sleep=sleep,
        )
        for member in self._members:
            require_inertia(member.kinematics)
        alone = alone and not self.arrays["numbers"][HAS_PAIRS]
        blocks = self.arrays.floats, self.arrays.integers
        self._advance = bind(self._step_function(alone=alone), *blocks)
        self.kernel = kernel() if alone else world_kernel()
        self._place_links = bind(self.kernel, *blocks)
        super().__init__(kinematics, self.arrays, 0)
        others_parts = [Articulation(each.kinematics, self.arrays, k) for k, each in enumerate(others, 1)]
        self.robots: tuple[Articulation, ...] = (self, *others_parts)
        self.bodies = {
            body.name: FreeBody(body, self.arrays, tree) for tree, body in enumerate(self._free, len(self._members))
        }
        for part in others_parts:
            part.put()
        self.reset()

    @property
    def steps(self) -> int:
        """How many steps it made since the last `reset`."""
        # Counted by the kernel, because counting in Python would be noticeable if each step is a call.
        return int(self._counts[STEPS])

    @property
    def t(self) -> float:
        """Simulated time [s]."""
        return self.steps * self.dt

    @property
    def iterated(self) -> int:
        """How many steps since `reset` needed the iterative contact solver."""
        return int(self.arrays["counts"][ITERATED])

    def reset(self, q: Array | None = None, v: Array | None = None) -> None:
        """Put the robot at `q`, `v` (neutral, zero) at t = 0, forgetting contacts; bodies go back, targets stay.

        Raises:
            SimulationError: wrong shape, or not finite.
        """
        self.put(q, v)
        for body in self.bodies.values():
            body.put_back()
        a = self.arrays
        a["memory"][:] = a["effort"][:] = a["tau"][:] = 0.0
        a["counts"][:] = a["asleep"][:] = a["attempt"][:] = a["unguessed"][:] = 0
        a["still"][:] = 0.0
        self.evaluate()

    def step(self, n: int = 1) -> None:
        """Advance by `n` steps of `dt` in one compiled call that releases the GIL.

        Raises:
            SimulationError: the state stopped being finite; names the joint and the time. Or more touches at once than
                there is room for.
        """
        if self._advance(n, ADVANCE) < n:
            raise SimulationError(self._divergence())

    def wake(self) -> None:
        """Wake all sleeping trees, as required when their support is removed."""
        a = self.arrays
        # The stored targets at sleep are no longer valid.
        a["targets_at_sleep"][np.repeat(a["asleep"], np.diff(a["tree_dof"])) != 0] = np.nan

    def contacts(self) -> tuple[Contact, ...]:
        """Return what touched in the last step; of what sleeps, in the last before it fell asleep."""
        return contacts(self.arrays, self.collision_shapes, self.ground.name if self.ground else "", self.dt)

    def energy(self) -> tuple[float, float]:
        """Return kinetic and potential energy of the robot [J], the latter zero at the world's origin."""
        M = self.mass_matrix()
        a = self.arrays
        n = self.kinematics.model.njoints - 1
        places, axes = a["P"][0] + a["r"][:n], a["R"][:n].reshape(-1, 3, 3)
        moment = sum(
            matmul(sign * a[mass][:n], places + np.einsum("bij,bj->bi", axes, a[centre][:n]))
            for sign, mass, centre in ((1.0, "mass", "centre"), (-1.0, "weightless", "weightless_centre"))
        )
        return float(matmul(matmul(0.5 * self.v, M), self.v)), matmul(-moment, a["gravity"])

    def mass_matrix(self) -> Array:
        """Return M(q) of the robot [kg, kg·m or kg·m²]; shape (nv, nv)."""
        self.evaluate()
        n = self.kinematics.model.nv
        M = np.tril(self.arrays["M"][: n * n].reshape(n, n))
        return np.array(M + np.tril(M, -1).T)

    def bias_forces(self) -> Array:
        """Return h(q, v): what gravity and motion demand of each dof at zero acceleration [N or N·m]; shape (nv,)."""
        a, n = self.arrays, self.kinematics.model.nv
        return np.array(matmul(self.mass_matrix(), turning(a, a["v"])[:n]) + a["bias"][:n])

    def body_poses(self) -> Array:
        """Return where Pinocchio's joints are: x y z [m] and rotation matrix row by row; shape (njoints - 1, 12)."""
        self.evaluate()
        a, n = self.arrays, self.kinematics.model.njoints - 1
        return np.hstack([a["P"][0] + a["r"][:n], a["R"][:n]])

    def link_poses(self, robot: Articulation, coordinates: Array) -> Array:
        """Return x y z [m] and quaternion x y z w of the links of a robot at `coordinates`, see `Articulation`.

        Returns:
            In the order of ``kinematics.link_names``; shape (n_links, 7). Valid until the next call.
        """
        robot.read_coordinates[:] = coordinates
        self._place_links(robot.tree, LINK_POSES)
        return robot.computed_poses

    def _step_function(self, *, alone: bool) -> Callable[[Array, Any, int, int], int]:
        """Return the kernel for one robot without other bodies (`alone`), or for a world."""
        return kernel() if alone else world_kernel()

    def evaluate(self) -> None:
        """Compute poses, M and bias of the state as it is."""
        self._advance(1, TERMS)

    def _divergence(self) -> str:
        a = self.arrays
        when = f"at t = {self.t + self.dt:.6g} s"
        if a["counts"][OVERFULL]:
            return f"{when} there are more contacts than the engine can store; use fewer bodies in one heap"
        wrong = int(np.flatnonzero(~np.isfinite(a["v"]))[0])
        tree = int(np.searchsorted(a["tree_dof"], wrong, side="right")) - 1
        if tree >= len(self._members):
            return (
                f"the simulation diverged {when}: body `{self._free[tree - len(self._members)].name}` no longer has "
                "a finite velocity; use a smaller step, or check its inertia"
            )
        model = self._members[tree].kinematics.model
        wrong -= int(a["tree_dof"][tree])
        joint = next(i for i in range(1, model.njoints) if model.idx_vs[i] <= wrong < model.idx_vs[i] + model.nvs[i])
        kinematics = self._members[tree].kinematics
        what = f"joint `{model.names[joint]}`"
        if kinematics.floating_base and joint == 1:
            what = f"root link `{kinematics.robot.roots()[0].name}`"
        return (
            f"the simulation diverged {when}: {what} "
            "no longer has a finite velocity; use a smaller step, or check its inertia and gains"
        )
