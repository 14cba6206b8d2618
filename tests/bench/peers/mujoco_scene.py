"""The benchmark's scenes in MuJoCo: its own URDF importer, then what a URDF does not say."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

from tests.bench.peers.scene import DT, GRAVITY, Pose, Running, Scene, Thing

INTEGRATORS = ("implicitfast", "Euler", "discrete")
"""RK4 and implicit do more work a step; discrete came with MuJoCo 3.13."""
SOLVERS = ("Newton", "CG", "PGS")
CONES = ("pyramidal", "elliptic")


@dataclass(frozen=True, slots=True)
class Settings:
    """How MuJoCo is to compute.

    Attributes:
        integrator: see `INTEGRATORS`.
        solver: see `SOLVERS`.
        cone: of friction, see `CONES`.
        jacobian: ``dense``, ``sparse`` or ``auto``.
        islands: whether what does not touch is solved separately.
        sleep: whether what rests may sleep.
        gain: of the motors [N·m·s/rad]. An ideal motor has no slip between wish and speed: the greater the better, but
            Euler integrates it explicitly and bears no more than 1.
        tolerance: of the solver; MuJoCo's own is 1e-8.
    """

    integrator: str = "implicitfast"
    solver: str = "Newton"
    cone: str = "pyramidal"
    jacobian: str = "auto"
    islands: bool = True
    sleep: bool = False
    gain: float = 100.0
    tolerance: float = 1e-8

    def __str__(self) -> str:
        words = [self.integrator, self.solver, self.cone]
        if self.jacobian != "auto":
            words.append(self.jacobian)
        if not self.islands:
            words.append("no islands")
        if self.sleep:
            words.append("sleep")
        if self.tolerance != 1e-8:
            words.append(f"tolerance {self.tolerance:g}")
        return " ".join(words)


class Mujoco:
    """MuJoCo, as a peer to compare with."""

    name, label = "mujoco", "MuJoCo"

    def version(self) -> str:
        """Return which MuJoCo is installed.

        Raises:
            ImportError: none is.
        """
        import mujoco

        return str(mujoco.__version__)

    def settings(self, scene: Scene) -> Iterator[Settings]:
        """Yield the combinations of integrator, solver and cone that this MuJoCo has."""
        import mujoco

        for integrator in INTEGRATORS:
            if hasattr(mujoco.mjtIntegrator, f"mjINT_{integrator.upper()}"):
                for cone in CONES:
                    for solver in SOLVERS:
                        gain = 1.0 if integrator == "Euler" else 100.0
                        yield Settings(integrator, solver, cone, sleep=scene.sleeps, gain=gain)

    def refined(self, settings: Settings) -> Iterator[Settings]:
        """Yield variations of the fastest settings that may be faster still."""
        yield replace(settings, jacobian="dense")
        yield replace(settings, jacobian="sparse")
        yield replace(settings, tolerance=1e-6)
        if not settings.sleep:  # which works by islands
            yield replace(settings, islands=False)

    def build(self, scene: Scene) -> Callable[[Settings], Running]:
        """Return what sets a scene up with given settings."""
        import mujoco

        # That a scene diverges, which some settings make it do, is found by its check, not in a file MUJOCO_LOG.TXT.
        mujoco.set_mju_user_warning(lambda text: None)
        built = Built(scene)
        return lambda settings: InMujoco(built, settings)


class Built:
    """A scene as a compiled model of MuJoCo.

    Args:
        scene: what to build.

    Raises:
        ImportError: MuJoCo is not installed.
    """

    def __init__(self, scene: Scene) -> None:
        import mujoco

        self.scene = scene
        spec = mujoco.MjSpec()
        spec.option.timestep = DT
        spec.option.gravity = GRAVITY
        spec.compiler.fusestatic = True
        # Where geoms meet, MuJoCo takes the larger friction: the floor's own is none, so that the robot's counts.
        spec.worldbody.add_geom(
            name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=(100.0, 100.0, 1.0), friction=(0.0, 0.0, 0.0)
        )
        self.motors = [prefix(k) + joint for k, thing in enumerate(scene.things) for joint in thing.motors]
        for k, thing in enumerate(scene.things):
            _add(spec, thing, prefix(k))
        self.model: Any = spec.compile()

    def with_settings(self, settings: Settings) -> Any:
        """Return a copy of the model that computes with these settings."""
        import mujoco

        model = copy.copy(self.model)
        opt = model.opt
        opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{settings.integrator.upper()}")
        opt.solver = getattr(mujoco.mjtSolver, f"mjSOL_{settings.solver.upper()}")
        opt.cone = getattr(mujoco.mjtCone, f"mjCONE_{settings.cone.upper()}")
        opt.jacobian = getattr(mujoco.mjtJacobian, f"mjJAC_{settings.jacobian.upper()}")
        opt.tolerance = settings.tolerance
        motors = [model.actuator(name).id for name in self.motors]
        model.actuator_gainprm[motors, 0], model.actuator_biasprm[motors, 2] = settings.gain, -settings.gain
        if not settings.islands:
            opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_ISLAND
        if settings.sleep and hasattr(mujoco.mjtEnableBit, "mjENBL_SLEEP"):
            opt.enableflags |= mujoco.mjtEnableBit.mjENBL_SLEEP
        return model


def prefix(k: int) -> str:
    """Return what is put before the names of a thing."""
    return f"{k}/"


def _add(spec: Any, thing: Thing, before: str) -> None:
    """Add a thing to the specification, under names of its own."""
    import mujoco

    child = mujoco.MjSpec.from_string(thing.urdf)
    root = spec.worldbody.add_frame(pos=thing.at).attach_body(child.worldbody.first_body(), before, "")
    if not thing.bolted:
        root.add_freejoint()
    bodies = [root, *root.find_all(mujoco.mjtObj.mjOBJ_BODY)]
    for body in bodies:
        slippery = body.name.removeprefix(before) in thing.slippery
        for geom in body.geoms:
            geom.friction = (1.0, 0.0, 0.0)
            if slippery:
                geom.condim, geom.priority = 1, 1
    for a, b in combinations(bodies, 2):
        if b not in a.bodies:  # of parent and child MuJoCo knows
            spec.add_exclude(bodyname1=a.name, bodyname2=b.name)
    for joint, motor in thing.motors.items():
        actuator = spec.add_actuator(name=before + joint, target=before + joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.set_to_velocity(kv=1.0)
        actuator.forcelimited, actuator.forcerange = True, (-motor.effort, motor.effort)
    for joint, servo in thing.servos.items():
        actuator = spec.add_actuator(name=before + joint, target=before + joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.set_to_position(kp=servo.stiffness, kv=servo.damping)
        actuator.forcelimited, actuator.forcerange = True, (-servo.effort, servo.effort)


class InMujoco(Running):
    """A scene in MuJoCo.

    Args:
        built: the scene, compiled.
        settings: how to compute.
    """

    def __init__(self, built: Built, settings: Settings) -> None:
        import mujoco

        super().__init__(built.scene)
        self._step = mujoco.mj_step
        self.model = built.with_settings(settings)
        self.state: Any = mujoco.MjData(self.model)
        self._servos: list[tuple[list[int], list[list[float]]]] = []
        for k, thing in enumerate(built.scene.things):
            for joint, motor in thing.motors.items():
                self.state.ctrl[self.model.actuator(prefix(k) + joint).id] = motor.speed
            for joint, angle in (thing.poses[0] if thing.poses else {}).items():
                self.state.qpos[self._place(k, joint)] = angle
            actuators = [self.model.actuator(prefix(k) + joint).id for joint in thing.servos]
            self._servos.append((actuators, [[pose[joint] for joint in thing.servos] for pose in thing.poses]))
        free = self.model.jnt_type == mujoco.mjtJoint.mjJNT_FREE
        loose = [k for k, thing in enumerate(built.scene.things) if not thing.bolted]
        self._bases = dict(zip(loose, self.model.jnt_qposadr[free].tolist(), strict=True))
        self._freedoms = dict(zip(loose, self.model.jnt_dofadr[free].tolist(), strict=True))
        self.pose(0)

    def many(self, steps: int) -> None:
        """Advance by `steps` in one call."""
        self._step(self.model, self.state, nstep=steps)

    def one_by_one(self, steps: int) -> None:
        """Advance by `steps`, each a call."""
        step, model, state = self._step, self.model, self.state
        for _ in range(steps):
            step(model, state)

    def base(self, k: int) -> Pose:
        """Return where the root link of a thing is."""
        at = self._bases[k]
        x, y, z, qw, qx, qy, qz = self.state.qpos[at : at + 7].tolist()
        return x, y, z, qx, qy, qz, qw

    def position(self, k: int, joint: str) -> float:
        """Return a joint's position [rad]."""
        return float(self.state.qpos[self._place(k, joint)])

    def _place(self, k: int, joint: str) -> int:
        return int(self.model.joint(prefix(k) + joint).qposadr[0])

    def set_targets(self, k: int, number: int) -> None:
        """Set the targets of a thing's servos."""
        indices, poses = self._servos[k]
        self.state.ctrl[indices] = poses[number]

    def knock(self, k: int, speed: float) -> None:
        """Give a thing a speed along x."""
        self.state.qvel[self._freedoms[k]] = speed

    def asleep(self) -> int | None:
        """Return how many things sleep."""
        awake = getattr(self.state, "tree_asleep", None)
        return None if awake is None else int((awake >= 0).sum())
