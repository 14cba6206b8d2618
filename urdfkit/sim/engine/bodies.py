"""What an engine is made of: robots, and bodies that are free or do not move."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from urdfkit.kinematics.model import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine.contact_surface import Surface

Array = NDArray[np.float64]
SMOOTHNESS = Surface()
"""Of what has no surface written."""
AT_ORIGIN = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class Piece:
    """A collision shape of a body.

    Attributes:
        shape: its geometry, its placement in the body, and its mesh if it is one; `Shape.body` names the link.
        surface: how it rubs.
    """

    shape: Shape
    surface: Surface = SMOOTHNESS


@dataclass(frozen=True, slots=True, eq=False)
class Body:
    """A rigid body that is free, or that does not move.

    Attributes:
        name: what contacts call it, unless a piece has a name of its own.
        pose: x y z [m] and quaternion x y z w in the world.
        pieces: its collision shapes.
        static: whether it stays where it is.
        mass: [kg]; of one that moves.
        centre: of mass, in the body [m].
        inertia: about the centre of mass, along the body's axes [kg·m²]; shape (3, 3).
        weightless: mass of it that gravity does not pull [kg].
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
        kinematics: with a floating base it is free, without it is bolted to `base`.
        shapes: its shapes; those that are no collisions are ignored.
        surfaces: link name → `Surface`; a link that is not named has mu 1.
        base: pose of a bolted root link, x y z [m] and quaternion x y z w.
        self_collide: the links that touch its others, or True for all; those with a joint between them never do.
        name: put before its links' names in contacts, with ``::``, unless empty.
        weightless: links that gravity does not pull.
    """

    kinematics: Kinematics
    shapes: Sequence[Shape] = ()
    surfaces: Mapping[str, Surface] = field(default_factory=dict)
    base: Sequence[float] = AT_ORIGIN
    self_collide: bool | Collection[str] = False
    name: str = ""
    weightless: Collection[str] = ()

    def meets(self, link: str) -> bool:
        """Return whether a link touches the robot's others."""
        return self.self_collide if isinstance(self.self_collide, bool) else link in self.self_collide
