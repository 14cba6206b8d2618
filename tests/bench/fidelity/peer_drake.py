"""Drake, on the same URDF, with the friction that it does not read added as its own properties."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
from pydrake.geometry import (
    AddCompliantHydroelasticProperties,
    AddRigidHydroelasticProperties,
    HalfSpace,
    ProximityProperties,
)
from pydrake.geometry import Box as DrakeBox
from pydrake.geometry import Sphere as DrakeSphere
from pydrake.math import RigidTransform, RollPitchYaw
from pydrake.multibody.math import SpatialForce, SpatialVelocity
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import (
    AddMultibodyPlant,
    CoulombFriction,
    ExternallyAppliedSpatialForce,
    MultibodyPlantConfig,
)
from pydrake.multibody.tree import PdControllerGains, SpatialInertia, UnitInertia, default_model_instance
from pydrake.systems.analysis import ResetIntegratorFromFlags, Simulator
from pydrake.systems.framework import DiagramBuilder

from fidelity.row import UnsupportedError
from fidelity.scene import Ground, Look, Pose, Run, Scene, Thing

SETTINGS: dict[str, dict[str, Any]] = {
    "default": {},
    "SAP": {"discrete_contact_approximation": "sap"},
    "SAP, hydroelastic": {"discrete_contact_approximation": "sap", "hydroelastic": True},
    "SAP, stiff": {"discrete_contact_approximation": "sap", "penetration_allowance": 1e-6, "stiction_tolerance": 1e-6},
    "RK3": {"continuous": True},
}
"""Name → options. Stiff: deepest penetration and fastest creep of 1 µm and 1 µm/s, as far as the solver allows.

RK3: its continuous system with steps of the same length, by Runge-Kutta of third order.
"""
ONCE = 1e-9
"""Stiffness of velocity actuators, which must be positive [N·m/rad]."""


def version() -> str:
    """Return Drake's version."""
    from importlib.metadata import version as of

    return of("drake")


def runner(dt: float, setting: str) -> Run:
    """Return Drake at a step [s] and a setting."""

    def run(scene: Scene) -> list[Look]:
        return _Drake(scene, dt, dict(SETTINGS[setting])).run()

    return run


class _Drake:
    def __init__(self, scene: Scene, dt: float, options: dict[str, Any]) -> None:
        self.scene, self.dt = scene, dt
        self.continuous = options.pop("continuous", False)
        self.hydroelastic = options.pop("hydroelastic", False)
        root = ET.fromstring(scene.file.read_text(encoding="utf-8"))
        if any(float(each.get("friction", 0)) > 0.0 for each in root.iter("dynamics")):
            raise UnsupportedError("Drake has no dry friction in joints")
        if self.continuous and (scene.wheels or root.find("joint/mimic") is not None or _has_limits(root)):
            raise UnsupportedError("joint limits, mimic joints and velocity actuators need discrete steps")
        builder = DiagramBuilder()
        config = MultibodyPlantConfig(time_step=0.0 if self.continuous else dt, **options)
        if not self.hydroelastic:
            config.contact_model = "point"
        self.plant, _ = AddMultibodyPlant(config, builder)
        self._load(root)
        for thing in scene.things:
            self._add_thing(thing)
        if scene.ground:
            self._add_ground()
        self.plant.mutable_gravity_field().set_gravity_vector(scene.gravity)
        self.wheels = self._wheels()
        self.plant.Finalize()
        self.diagram = builder.Build()
        self.simulator = Simulator(self.diagram)
        if self.continuous:
            ResetIntegratorFromFlags(self.simulator, "runge_kutta3", dt)
            self.simulator.get_mutable_integrator().set_fixed_step_mode(True)
        self.context = self.plant.GetMyMutableContextFromRoot(self.simulator.get_mutable_context())
        self.root = self.plant.GetBodyByName(_root_link(root))
        self.joints = {name: self.plant.GetJointByName(name) for name in _moving(root)}
        self.total = [0.0] * len(scene.servos)
        self._start()
        self.simulator.Initialize()

    def _load(self, root: ET.Element) -> None:
        mu = {block.get("reference"): float(block.findtext("mu1") or 1.0) for block in root.findall("gazebo[mu1]")}
        root.set("xmlns:drake", "http://drake.mit.edu")
        for block in root.findall("gazebo"):
            root.remove(block)
        for link in root.findall("link"):
            for collision in link.findall("collision"):
                properties = ET.SubElement(collision, "drake:proximity_properties")
                friction = str(_own_friction(mu.get(link.get("name"), 1.0)))
                for name in ("drake:mu_static", "drake:mu_dynamic"):
                    ET.SubElement(properties, name).set("value", friction)
                if self.hydroelastic:
                    ET.SubElement(properties, "drake:compliant_hydroelastic")
                    ET.SubElement(properties, "drake:hydroelastic_modulus").set("value", "1e8")
                    ET.SubElement(properties, "drake:mesh_resolution_hint").set("value", "0.02")
        Parser(self.plant).AddModelsFromString(ET.tostring(root, encoding="unicode"), "urdf")

    def _properties(self, mu: float) -> Any:
        properties = ProximityProperties()
        if self.hydroelastic:
            AddCompliantHydroelasticProperties(0.05, 1e8, properties)
        friction = _own_friction(mu)
        properties.AddProperty("material", "coulomb_friction", CoulombFriction(friction, friction))
        return properties

    def _add_thing(self, thing: Thing) -> None:
        inertia = UnitInertia(*(moment / thing.mass for moment in thing.inertia))
        body = self.plant.AddRigidBody(
            thing.name, default_model_instance(), SpatialInertia(thing.mass, np.zeros(3), inertia)
        )
        shape = DrakeBox(*thing.size) if len(thing.size) == 3 else DrakeSphere(thing.size[0])
        self.plant.RegisterCollisionGeometry(body, RigidTransform(), shape, thing.name, self._properties(thing.mu))

    def _add_ground(self) -> None:
        properties = ProximityProperties()
        if self.hydroelastic:
            AddRigidHydroelasticProperties(properties)
        properties.AddProperty("material", "coulomb_friction", CoulombFriction(1.0, 1.0))
        plane = HalfSpace.MakePose(np.array([0.0, 0.0, 1.0]), np.zeros(3))
        self.plant.RegisterCollisionGeometry(self.plant.world_body(), plane, HalfSpace(), "ground", properties)

    def _wheels(self) -> list[Any]:
        found = []
        for name in self.scene.wheels:
            actuator = self.plant.AddJointActuator(f"{name}_motor", self.plant.GetJointByName(name), math.inf)
            actuator.set_controller_gains(PdControllerGains(p=ONCE, d=100.0))
            found.append(actuator)
        return found

    def _start(self) -> None:
        scene, plant, context = self.scene, self.plant, self.context
        if not scene.bolted:
            pose = RigidTransform(RollPitchYaw(scene.spawn[3:]), scene.spawn[:3])
            plant.SetFreeBodyPose(context, self.root, pose)
            plant.SetFreeBodySpatialVelocity(context, self.root, SpatialVelocity(scene.twist[3:], scene.twist[:3]))
        for thing in scene.things:
            plant.SetFreeBodyPose(context, plant.GetBodyByName(thing.name), RigidTransform(thing.position))
        q, v = plant.GetPositions(context), plant.GetVelocities(context)
        for name, (position, velocity) in scene.joints.items():
            joint = self.joints[name]
            q[joint.position_start()], v[joint.velocity_start()] = position, velocity
        plant.SetPositions(context, q)
        plant.SetVelocities(context, v)
        if scene.push is not None:
            force = ExternallyAppliedSpatialForce()
            force.body_index = plant.GetBodyByName(scene.push[0]).index()
            force.F_Bq_W = SpatialForce(np.zeros(3), np.array([scene.push[1], 0.0, 0.0]))
            plant.get_applied_spatial_force_input_port().FixValue(context, [force])

    def run(self) -> list[Look]:
        scene, looks = self.scene, [self._look(0.0)]
        every = scene.every or (0.005 if scene.wheels else scene.seconds)
        steps = round(every / self.dt)
        each_step = bool(scene.servos or scene.wheels)
        for k in range(round(scene.seconds / every)):
            for i in range(steps if each_step else 1):
                self._drive((k * steps + i) * self.dt)
                self.simulator.AdvanceTo((k * steps + (i + 1 if each_step else steps)) * self.dt)
            looks.append(self._look((k + 1) * steps * self.dt))
        if scene.weighed:
            looks[-1] = replace(looks[-1], ground=Ground.of(self._contacts()))
        return looks

    def _contacts(self) -> Iterator[tuple[Any, Any]]:
        """Yield position and force on the robot of each contact; the ground only pushes up."""
        found = self.plant.get_contact_results_output_port().Eval(self.context)
        pairs = [found.point_pair_contact_info(k) for k in range(found.num_point_pair_contacts())]
        wrenches = [(pair.contact_point(), pair.contact_force()) for pair in pairs]
        for k in range(found.num_hydroelastic_contacts()):
            info = found.hydroelastic_contact_info(k)
            wrenches.append((info.contact_surface().centroid(), info.F_Ac_W().translational()))
        for position, force in wrenches:
            yield position, force if force[2] > 0.0 else -force

    def _drive(self, t: float) -> None:
        scene, plant, context = self.scene, self.plant, self.context
        if scene.wheels:
            share = min(1.0, (t + 0.5 * self.dt) / scene.ramp) if scene.ramp else 1.0
            speeds = [share * speed for speed in scene.wheels.values()]
            instance = self.wheels[0].model_instance()
            wanted = np.concatenate([np.zeros(len(speeds)), speeds])
            plant.get_desired_state_input_port(instance).FixValue(context, wanted)
        efforts = dict(scene.efforts)
        for k, (name, (p, i, d, target)) in enumerate(scene.servos.items()):
            position, velocity = self._state(name)
            self.total[k] += (target - position) * self.dt
            efforts[name] = p * (target - position) + i * self.total[k] - d * velocity
        if efforts:
            generalized = np.zeros(plant.num_velocities())
            for name, effort in efforts.items():
                generalized[self.joints[name].velocity_start()] = effort
            plant.get_applied_generalized_force_input_port().FixValue(context, generalized)

    def _state(self, name: str) -> tuple[float, float]:
        joint = self.joints[name]
        position = self.plant.GetPositions(self.context)[joint.position_start()]
        return float(position), float(self.plant.GetVelocities(self.context)[joint.velocity_start()])

    def _look(self, t: float) -> Look:
        joints = {name: self._state(name) for name in self.joints}
        things = {thing.name: self._pose(self.plant.GetBodyByName(thing.name)) for thing in self.scene.things}
        return Look(t, self._pose(self.root), joints, things)

    def _pose(self, body: Any) -> Pose:
        pose = self.plant.EvalBodyPoseInWorld(self.context, body)
        velocity = self.plant.EvalBodySpatialVelocityInWorld(self.context, body)
        w, x, y, z = pose.rotation().ToQuaternion().wxyz()
        return Pose(pose.translation(), (x, y, z, w), velocity.translational(), velocity.rotational())


def _own_friction(mu: float) -> float:
    """Return the friction of a surface that has `mu` with another of friction 1: Drake uses 2·μ₁·μ₂/(μ₁ + μ₂)."""
    return mu / (2.0 - mu)


def _has_limits(root: ET.Element) -> bool:
    return any(joint.get("type") in ("revolute", "prismatic") for joint in root.findall("joint"))


def _root_link(root: ET.Element) -> str:
    children = {child.get("link") for child in root.findall("joint/child")}
    return next(str(link.get("name")) for link in root.findall("link") if link.get("name") not in children)


def _moving(root: ET.Element) -> list[str]:
    return [str(joint.get("name")) for joint in root.findall("joint") if joint.get("type") != "fixed"]
