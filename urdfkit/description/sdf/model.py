"""Models of a world: links, joints and nested models, with resolved poses.

Each pose is in a fixed frame, independent of the file: a model's in the world (a nested model's in its parent), a
link's in its model, a shape's and a light's in its parent, a joint's in its child link.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from math import inf

from urdfkit.description.sdf.shapes import Kept, Light, WorldShape, Written, plugins_of
from urdfkit.description.urdf.geometry import compose
from urdfkit.description.urdf.robot import Plugin, Pose, Vector
from urdfkit.description.xml.source import Position
from urdfkit.record import field, record


@record
class WorldInertial:
    """Mass [kg], pose of the inertial frame in the link, and inertia tensor [kg·m²] about the centre of mass.

    The defaults are sdformat's (inertial.sdf).
    """

    mass: float = 1.0
    pose: Pose = Pose()
    ixx: float = 1.0
    ixy: float = 0.0
    ixz: float = 0.0
    iyy: float = 1.0
    iyz: float = 0.0
    izz: float = 1.0

    @property
    def rows(self) -> tuple[Vector, Vector, Vector]:
        """The tensor as a matrix, by rows."""
        return (self.ixx, self.ixy, self.ixz), (self.ixy, self.iyy, self.iyz), (self.ixz, self.iyz, self.izz)


@record(eq=False)
class WorldLink(Written):
    """A rigid body of a model.

    Attributes:
        name: unique in its model.
        pose: pose in the model.
        inertial: mass properties; sdformat's defaults for missing values.
        collisions: collision shapes.
        visuals: visual shapes.
        gravity: whether gravity acts on the link.
        self_collide: whether the link collides with other links of its model; None for the setting of the model.
        kinematic: whether the link moves by command only.
        damping: linear [1/s] and angular [1/s] velocity decay.
        lights: lights attached to the link.
        kept: sensors and other elements, preserved unchanged.
        position: source position.
    """

    name: str
    pose: Pose = Pose()
    inertial: WorldInertial = WorldInertial()
    collisions: tuple[WorldShape, ...] = ()
    visuals: tuple[WorldShape, ...] = ()
    gravity: bool = True
    self_collide: bool | None = None
    kinematic: bool = False
    damping: tuple[float, float] = (0.0, 0.0)
    lights: tuple[Light, ...] = ()
    kept: tuple[Kept, ...] = ()
    position: Position | None = field(default=None, repr=False)


@record
class WorldMimic:
    """Position = multiplier · (position of `joint` − reference) + offset.

    Attributes:
        joint: name of the other joint, in the same model or ``nested::joint``.
        multiplier: factor of the other joint's position.
        offset: offset [rad] or [m].
        reference: position of the other joint [rad] or [m].
    """

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0
    reference: float = 0.0


@record
class WorldAxis:
    """An axis of a joint. Unlimited values are infinite.

    Attributes:
        xyz: direction in the joint frame, not normalised.
        lower: lower limit [rad] or [m].
        upper: upper limit [rad] or [m].
        effort: maximum effort [N·m] or [N].
        velocity: maximum velocity [rad/s] or [m/s].
        damping: viscous damping [N·m·s/rad] or [N·s/m].
        friction: dry friction [N·m] or [N].
        spring_stiffness: stiffness of the spring [N·m/rad] or [N/m].
        spring_reference: rest position of the spring [rad] or [m].
        mimic: relation to the joint that this axis follows; None without one.
    """

    xyz: Vector = (0.0, 0.0, 1.0)
    lower: float = -inf
    upper: float = inf
    effort: float = inf
    velocity: float = inf
    damping: float = 0.0
    friction: float = 0.0
    spring_stiffness: float = 0.0
    spring_reference: float = 0.0
    mimic: WorldMimic | None = None


@record(eq=False)
class WorldJoint(Written):
    """A joint between two links.

    Attributes:
        name: unique in its model.
        type: ``revolute``, ``continuous``, ``prismatic``, ``fixed``, ``ball``, ``universal``, ``revolute2``, ``screw``
            or ``gearbox``.
        parent: a link of the model, ``nested::link``, or ``world``.
        child: a link of the model or ``nested::link``; not ``world``.
        pose: pose in the child link.
        axes: zero, one or two axes.
        kept: other elements, preserved unchanged.
        position: source position.
    """

    name: str
    type: str
    parent: str
    child: str
    pose: Pose = Pose()
    axes: tuple[WorldAxis, ...] = ()
    kept: tuple[Kept, ...] = ()
    position: Position | None = field(default=None, repr=False)


@record(eq=False)
class WorldModel(Written):
    """A model: links, joints, and nested models.

    Attributes:
        name: unique among its sibling models.
        pose: pose in the world, or in the parent model.
        static: whether the model never moves; applies to nested models too.
        links: links, without those of nested models.
        joints: joints, without those of nested models.
        models: nested models.
        self_collide: whether the links collide with each other.
        canonical_link: name of the canonical link; empty for the first link.
        kept: plugins and other elements, preserved unchanged.
        position: source position.
    """

    name: str
    pose: Pose = Pose()
    static: bool = False
    links: tuple[WorldLink, ...] = ()
    joints: tuple[WorldJoint, ...] = ()
    models: tuple[WorldModel, ...] = ()
    self_collide: bool = False
    canonical_link: str = ""
    kept: tuple[Kept, ...] = ()
    position: Position | None = field(default=None, repr=False)

    @cached_property
    def plugins(self) -> tuple[Plugin, ...]:
        """The plugins of the model, in the form used for robots."""
        return plugins_of(self.kept)

    def all_links(self) -> Iterator[tuple[str, Pose, WorldLink]]:
        """Yield name (``nested::link`` in nested models), pose in this model, and link."""
        for link in self.links:
            yield link.name, link.pose, link
        for model in self.models:
            for name, pose, link in model.all_links():
                yield f"{model.name}::{name}", compose(model.pose, pose), link

    def all_joints(self) -> Iterator[tuple[str, WorldJoint]]:
        """Yield every joint with its name prefix (empty, or ``nested::``), including joints of nested models."""
        for joint in self.joints:
            yield "", joint
        for model in self.models:
            for prefix, joint in model.all_joints():
                yield f"{model.name}::{prefix}", joint
