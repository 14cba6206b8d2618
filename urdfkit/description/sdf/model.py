"""Models of a world: links, joints, and models inside models, every pose resolved.

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
    """Mass [kg], pose of the centre of mass and of the axes of the tensor [kg·m²] about it, in the link.

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


@record(eq=False)
class WorldLink(Written):
    """A rigid body of a model.

    Attributes:
        name: unique in its model.
        pose: in the model.
        inertial: mass properties; sdformat's defaults where none are written.
        collisions: its collision shapes.
        visuals: its visual shapes.
        gravity: whether gravity acts on it.
        self_collide: whether it collides with other links of its model; None where the model decides.
        kinematic: moves by command only.
        damping: linear [1/s] and angular [1/s] velocity decay.
        lights: lights that move with it.
        kept: sensors and other elements.
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
        joint: of the same model, or ``nested::joint``.
        multiplier: factor of the other joint's position.
        offset: [rad] or [m].
        reference: position of the other joint [rad] or [m].
    """

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0
    reference: float = 0.0


@record
class WorldAxis:
    """An axis of a joint; `xyz` is of the joint's frame, not normalised. Unlimited values are infinite.

    Attributes:
        xyz: direction.
        lower: [rad] or [m].
        upper: [rad] or [m].
        effort: largest [N·m] or [N].
        velocity: largest [rad/s] or [m/s].
        damping: [N·m·s/rad] or [N·s/m].
        friction: dry friction [N·m] or [N].
        spring_stiffness: [N·m/rad] or [N/m].
        spring_reference: rest position of the spring [rad] or [m].
        mimic: the joint that it follows.
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
        child: likewise; never ``world`` alone.
        pose: in the child link.
        axes: none, one or two of them.
        kept: other elements.
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
        pose: in the world, or in the model it is nested in.
        static: never moves; also applies to nested models.
        links: its own.
        joints: its own.
        models: nested ones.
        self_collide: whether its links collide with each other.
        canonical_link: name of the canonical link; empty for the first link.
        kept: plugins and other elements.
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
        """Its plugins, as a robot has them."""
        return plugins_of(self.kept)

    def all_links(self) -> Iterator[tuple[str, Pose, WorldLink]]:
        """Yield name (``nested::link`` for those of nested models), pose in this model, and link."""
        for link in self.links:
            yield link.name, link.pose, link
        for model in self.models:
            for name, pose, link in model.all_links():
                yield f"{model.name}::{name}", compose(model.pose, pose), link

    def all_joints(self) -> Iterator[tuple[str, WorldJoint]]:
        """Yield name prefix (empty, or ``nested::``) and joint of each joint, those of nested models included."""
        for joint in self.joints:
            yield "", joint
        for model in self.models:
            for prefix, joint in model.all_joints():
                yield f"{model.name}::{prefix}", joint
