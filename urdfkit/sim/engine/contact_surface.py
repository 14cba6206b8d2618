"""What bodies touch with: the ground, their surfaces, and the contacts that come of it."""

from __future__ import annotations

from dataclasses import dataclass

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Ground:
    """A horizontal plane that fills the half space below it.

    Attributes:
        height: z of the plane in the world [m].
        mu: its friction coefficient; a pair of surfaces meets with the smaller one (Gazebo's ground plane has 100).
        name: what contacts call it.
    """

    height: float = 0.0
    mu: float = 100.0
    name: str = "ground_plane"


@dataclass(frozen=True, slots=True)
class Surface:
    """How a link rubs.

    Attributes:
        mu1: friction coefficient along `fdir1`.
        mu2: friction coefficient across `fdir1`.
        fdir1: first friction direction in the collision's frame; None when the writer gave none: then it is one of the
            world's axes.
        frame: the link in whose frame `fdir1` is instead, as the chassis of a wheel with rollers; empty for none.

    Two surfaces meet with the smaller coefficient along and the smaller one across, in the direction of the one with
    the smaller `mu1` (Gazebo Classic, ODEPhysics::Collide). Friction lies in the ellipse of the two.
    """

    mu1: float = 1.0
    mu2: float = 1.0
    fdir1: Vector | None = None
    frame: str = ""

    @property
    def mu(self) -> float:
        """The smaller coefficient."""
        return min(self.mu1, self.mu2)


@dataclass(frozen=True, slots=True)
class Contact:
    """A point where a link touched something in the last step.

    Attributes:
        a: the link.
        b: what it touched.
        position: in the world [m].
        normal: unit vector in the world from `b` to `a`.
        depth: how deep `a` is in `b` [m]; negative while there is still a gap.
        force: on `a`, in the world [N].
        a_shape: which of the collisions of `a` it is, in their order.
        b_shape: which of those of `b`; -1 for the ground.
    """

    a: str
    b: str
    position: Vector
    normal: Vector
    depth: float
    force: Vector
    a_shape: int = 0
    b_shape: int = -1
