"""Ground plane, friction of surfaces, and contacts."""

from dataclasses import dataclass

from urdfkit.linear_algebra import Array

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
    """A contact of a link in the last step.

    Attributes:
        a: the link.
        b: the other body.
        position: position in the world [m].
        normal: unit vector in the world from `b` to `a`.
        depth: penetration [m]; negative for a gap.
        force: force on `a` in world axes [N].
        a_shape: index of the collision shape of `a`.
        b_shape: index of the collision shape of `b`; -1 for the ground.
    """

    a: str
    b: str
    position: Vector
    normal: Vector
    depth: float
    force: Vector
    a_shape: int = 0
    b_shape: int = -1


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """A collision shape in the form that the kernel uses.

    Attributes:
        link: name of its link or body in contacts.
        number: index of the shape in its link.
        body: index of its body; -1 for a static shape, whose placement is in the world.
        owner: index of the robot or body it belongs to.
        meets: whether it collides with other shapes of its owner.
        kind: of shape.
        size: [m], see `ground_contacts`.
        R: axes in the body.
        p: centre in the body [m].
        radius: of a ball round the centre that holds the shape [m].
        mu: friction coefficient along `along`.
        mu2: across it.
        along: direction of `mu`, in `along_body` or, if that is -1, in the world; zero for none.
        along_body: number of the body it turns with.
        vertices: of a hull or mesh [m], shape (n, 3).
        triangles: of a mesh [m], shape (m, 3, 3); of a hull those it was made from do not matter.
    """

    link: str
    number: int
    body: int
    owner: int
    meets: bool
    kind: int
    size: tuple[float, float, float]
    R: Array
    p: Array
    radius: float
    mu: float
    mu2: float
    along: Array
    along_body: int
    vertices: Array
    triangles: Array
