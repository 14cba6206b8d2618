"""Members of an engine: robots, free bodies and static bodies."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

from urdfkit.kinematics.model import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine.contact_surface import Surface

SMOOTHNESS = Surface()
"""Surface of a shape without a defined surface."""
AT_ORIGIN = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A collision shape of a body.

    Attributes:
        shape: geometry, placement in the body, and mesh if it has one; `Shape.body` names the link.
        surface: friction of the shape.
    """

    shape: Shape
    surface: Surface = SMOOTHNESS


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A free or static rigid body.

    Attributes:
        name: its name in contacts, unless a piece has its own name.
        pose: x y z [m] and quaternion x y z w in the world.
        pieces: its collision shapes.
        static: whether it cannot move.
        mass: mass of a free body [kg].
        centre: centre of mass, in the body [m].
        inertia: inertia about the centre of mass, in the body's axes [kg·m²]; shape (3, 3).
        weightless: part of the mass without gravity [kg].
        weightless_centre: centre of that mass, in the body [m].
    """

    name: str
    pose: Sequence[float] = AT_ORIGIN
    pieces: Sequence[Piece] = ()
    static: bool = False
    mass: float = 1.0
    centre: Sequence[float] = (0.0, 0.0, 0.0)
    inertia: Sequence[Sequence[float]] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    weightless: float = 0.0
    weightless_centre: Sequence[float] = (0.0, 0.0, 0.0)


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """A robot.

    Attributes:
        kinematics: kinematic model; without a floating base, the root link is fixed at `base`.
        shapes: its shapes; only collision shapes are used.
        surfaces: link name → `Surface`; other links have mu 1.
        base: pose of a fixed root link, x y z [m] and quaternion x y z w.
        self_collide: links that collide with other links of the robot, True for all; adjacent links never collide.
        name: prefix of its links' names in contacts, followed by ``::``; empty for none.
        weightless: links without gravity.
    """

    kinematics: Kinematics
    shapes: Sequence[Shape] = ()
    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    base: Sequence[float] = AT_ORIGIN
    self_collide: bool | Collection[str] = False
    name: str = ""
    weightless: Collection[str] = ()

    def meets(self, link: str) -> bool:
        """Return whether a link collides with other links of the robot."""
        return self.self_collide if isinstance(self.self_collide, bool) else link in self.self_collide
