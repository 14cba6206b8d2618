"""A picture of a robot as SVG: the primitives it consists of, and their shadow on the ground.

Seen from far away, from the front, left and above. The same robot gives the same picture.
"""

from collections.abc import Iterable
from itertools import pairwise
from math import cos, dist, pi, sin

from urdfkit.description.urdf.geometry import compose, link_poses, rotate, rotation_of, unit
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Robot, Sphere, Vector

WIDTH, HEIGHT = 480, 320
"""Of the picture [px]."""

_MARGIN = 0.08
_SIDES = 24
"""Sides of the prism that stands for a cylinder; a sphere has half as many rings."""
_BACK: Vector = (0.720432, 0.480288, 0.500300)
"""Unit vector towards the viewer, and the axes of the picture."""
_RIGHT: Vector = (-0.554700, 0.832050, 0.0)
_UP: Vector = (-0.416275, -0.277517, 0.865852)
_LIGHT: Vector = (0.254251, 0.544825, 0.799076)
"""Unit vector towards the light."""
_AMBIENT = 0.42
_THIN = 1e-6
"""Height above a plane that counts as in it [m]."""
_GROUND, _SHADOW, _GREY = (0.95, 0.955, 0.965), (0.80, 0.81, 0.83), (0.7, 0.7, 0.7)

Polygon = tuple[Vector, ...]
Face = tuple[Vector, Polygon, Vector]
"""Outward normal, corners in the world [m] and colour (0..1)."""


def drawing_of(robot: Robot) -> str | None:
    """Return the picture of a robot as SVG; None where there is nothing to see but meshes.

    Args:
        robot: a tree.
    """
    faces = faces_of(robot)
    if not faces:
        return None
    ground = min(corner[2] for _, face, _ in faces for corner in face)
    shadows = [
        (tuple(_dropped(corner, ground) for corner in face), _SHADOW)
        for normal, face, _ in faces
        if _dot(normal, _LIGHT) > 0
    ]
    seen = _back_to_front([face for face in faces if _dot(face[0], _BACK) > 1e-9])
    polygons = [*shadows, *((face, _lit(rgb, normal)) for normal, face, rgb in seen)]
    across = [_dot(_RIGHT, corner) for face, _ in polygons for corner in face]
    along = [_dot(_UP, corner) for face, _ in polygons for corner in face]
    width, height = max(across) - min(across), max(along) - min(along)
    scale = (1 - 2 * _MARGIN) / (max(width / WIDTH, height / HEIGHT) or 1.0)
    left, top = (max(across) + min(across) - WIDTH / scale) / 2, (max(along) + min(along) + HEIGHT / scale) / 2
    lines = [f'<rect width="100%" height="100%" fill="{_hex(_GROUND)}"/>']
    for face, rgb in polygons:
        places = (f"{scale * (_dot(_RIGHT, at) - left):.1f},{scale * (top - _dot(_UP, at)):.1f}" for at in face)
        lines.append(f'<path d="M{" ".join(places)}z" fill="{_hex(rgb)}" stroke="{_hex(rgb)}"/>')
    size = f'width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}"'
    start = f'<svg xmlns="http://www.w3.org/2000/svg" {size} stroke-width="0.4" stroke-linejoin="round">'
    return "\n".join((start, *lines, "</svg>\n"))


def faces_of(robot: Robot) -> list[Face]:
    """Return the faces of the visible primitives of a robot whose joints are at zero, without meshes.

    Args:
        robot: a tree.
    """
    poses = link_poses(robot)
    named = {material.name: material.rgba for material in robot.materials if material.rgba is not None}
    found = []
    for link in robot.link_by_name_in_order():
        for visual in link.visuals if link.name in poses else ():
            material = visual.material
            rgba = (material.rgba or named.get(material.name)) if material else None
            pose = compose(poses[link.name], visual.origin)
            turn = rotation_of(pose.rpy)
            for normal, face in _faces(visual.geometry):
                corners = tuple(_sum(rotate(turn, corner), pose.xyz) for corner in face)
                found.append((rotate(turn, normal), corners, rgba[:3] if rgba else _GREY))
    return found


def _faces(geometry: Geometry | None) -> Iterable[tuple[Vector, Polygon]]:
    """Return normals and corners of the faces of a primitive in its own frame; a capsule is drawn as a cylinder."""
    turns = [2 * pi * k / _SIDES for k in range(_SIDES + 1)]
    match geometry:
        case Box(size=(x, y, z)):
            return [*_prism([(x / 2, y / 2), (-x / 2, y / 2), (-x / 2, -y / 2), (x / 2, -y / 2)], z / 2)]
        case Cylinder(radius=r, length=length):
            return _prism([(r * cos(turn), r * sin(turn)) for turn in turns[:-1]], length / 2)
        case Capsule(radius=r, length=length):
            return _faces(Cylinder(r, length + 2 * r))
        case Sphere(radius=r):
            points = [[(sin(a) * cos(b), sin(a) * sin(b), cos(a)) for b in turns] for a in turns[: _SIDES // 2 + 1]]
            return [
                (_normal(corners), tuple((r * x, r * y, r * z) for x, y, z in corners))
                for upper, lower in pairwise(points)
                for corners in zip(upper, lower, lower[1:], upper[1:], strict=False)
            ]
    return ()


def _normal(corners: Polygon) -> Vector:
    """Return the outward normal of a quadrilateral of a sphere about the origin."""
    (a, b, c), (d, e, f) = (
        (q[0] - p[0], q[1] - p[1], q[2] - p[2]) for p, q in ((corners[0], corners[2]), (corners[1], corners[3]))
    )
    return unit((b * f - c * e, c * d - a * f, a * e - b * d)) or corners[0]


def _prism(base: list[tuple[float, float]], half: float) -> list[tuple[Vector, Polygon]]:
    """Return the faces of an upright prism over a convex polygon that is given counter-clockwise."""
    faces: list[tuple[Vector, Polygon]] = [((0.0, 0.0, z), tuple((x, y, z * half) for x, y in base)) for z in (1, -1)]
    for (a, b), (c, d) in zip(base, [*base[1:], base[0]], strict=True):
        length = ((d - b) ** 2 + (a - c) ** 2) ** 0.5 or 1.0
        corners = ((a, b, -half), (c, d, -half), (c, d, half), (a, b, half))
        faces.append((((d - b) / length, (a - c) / length, 0.0), corners))
    return faces


def _back_to_front(faces: list[Face]) -> list[Face]:
    """Return visible faces in the order of painting, split where one intersects the plane of another (a BSP tree)."""
    # The largest face first: its plane splits few of the others, and theirs do not split it.
    waiting, ordered = [sorted(faces, key=lambda face: -max(dist(face[1][0], corner) for corner in face[1]))], []
    while waiting:
        group = waiting.pop()
        if len(group) < 2:
            ordered += group
            continue
        first = group[0]
        nearer: list[Face] = []
        farther: list[Face] = []
        for face in group[1:]:
            heights = [_dot(first[0], corner) - _dot(first[0], first[1][0]) for corner in face[1]]
            if min(heights) < -_THIN and max(heights) > _THIN:
                nearer.append((face[0], _above(face[1], heights), face[2]))
                farther.append((face[0], _above(face[1], [-height for height in heights]), face[2]))
            else:
                (nearer if max(heights) > _THIN else farther).append(face)
        waiting += [nearer, [first], farther]
    return ordered


def _above(polygon: Polygon, heights: list[float]) -> Polygon:
    """Return the part of a convex polygon whose corners have heights above 0."""
    found = []
    for k, (corner, height) in enumerate(zip(polygon, heights, strict=True)):
        before, low = polygon[k - 1], heights[k - 1]
        if (low > 0) != (height > 0):
            x, y, z = ((a * height - b * low) / (height - low) for a, b in zip(before, corner, strict=True))
            found.append((x, y, z))
        if height > 0:
            found.append(corner)
    return tuple(found)


def _dropped(point: Vector, ground: float) -> Vector:
    """Return the shadow of a point on the ground."""
    fall = (point[2] - ground) / _LIGHT[2]
    return point[0] - fall * _LIGHT[0], point[1] - fall * _LIGHT[1], ground


def _lit(rgb: Vector, normal: Vector) -> Vector:
    light = min(1.0, _AMBIENT + (1.1 - _AMBIENT) * max(0.0, _dot(normal, _LIGHT)))
    return rgb[0] * light, rgb[1] * light, rgb[2] * light


def _hex(rgb: Vector) -> str:
    return "#" + "".join(f"{round(255 * max(0.0, min(1.0, part))):02x}" for part in rgb)


def _sum(*vectors: Vector) -> Vector:
    x, y, z = (sum(parts) for parts in zip(*vectors, strict=True))
    return x, y, z


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
