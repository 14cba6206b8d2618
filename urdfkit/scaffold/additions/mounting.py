"""Where a new part goes on a robot: on which link, where on it, and what to tell about that."""

from __future__ import annotations

from urdfkit.description.urdf.geometry import box_around_all
from urdfkit.description.urdf.robot import Link, Robot, Vector
from urdfkit.errors import ResourceError, did_you_mean
from urdfkit.scaffold.additions.free_placement import Part, free_place, inside, spot
from urdfkit.scaffold.additions.link_boxes import Boxes


def parent_link(robot: Robot, name: str | None) -> Link:
    """Return the link that something is mounted on.

    Args:
        robot: the robot.
        name: as asked for; None: ``base_link`` if that is more than a frame, else the heaviest link.

    Raises:
        ResourceError: there is no such link.
    """
    if name is not None:
        if name not in robot.link_by_name:
            near = did_you_mean(name, robot.link_by_name)
            raise ResourceError(f"no link `{name}` in robot `{robot.name}`{near or f'; {_listed(robot)}'}")
        return robot.link_by_name[name]
    base = robot.link_by_name.get("base_link")
    if base is not None and (base.visuals or base.collisions):
        return base
    heavy = [link for link in robot.links if link.inertial is not None and link.inertial.mass]
    if not heavy:
        return base or robot.links[0]
    return max(heavy, key=lambda link: (link.inertial.mass or 0.0) if link.inertial is not None else 0.0)


def extent(robot: Robot, link: Link) -> Vector | None:
    """Return how long, wide and high a link is [m]; None where it has no shapes, or meshes that cannot be read.

    Args:
        robot: the robot.
        link: of it.
    """
    own = Boxes(robot).of(link)
    if not own:
        return None
    x, y, z = (high - low for low, high in zip(*box_around_all(own), strict=True))
    return x, y, z


def mount(robot: Robot, link: Link, part: Part, xyz: Vector | None) -> tuple[Vector, list[str]]:
    """Return where a part goes, in the frame of its link [m], and what to tell about it.

    Args:
        robot: the robot.
        link: that the part is mounted on.
        part: what is mounted.
        xyz: where, as asked for [m]; None: where nothing else is.

    Raises:
        ResourceError: there is no room left.
    """
    boxes = Boxes(robot)
    own = boxes.of(link)
    others = [(name, box) for name, box in boxes.seen_from(link) if name != link.name]
    if xyz is not None:
        solid = [(link.name, box) for box in own or [] if part.where != "middle"]
        hit = inside(part, xyz, [*others, *solid])
        return xyz, [f"at {written(xyz)} it reaches into `{hit}`"] if hit is not None else []
    place = free_place(own or [], [box for _, box in others], part)
    if place is None:
        there = inside(part, spot(own, part), others) if own else None
        beside = f" beside `{there}`" if there is not None else ""
        raise ResourceError(
            f"no room left on `{link.name}`{beside} for what is {_size(part)} m; nothing was changed: "
            "--parent says on which link, --xyz where"
        )
    notes = [f"the meshes of `{link.name}` cannot be read: look whether it is inside, and give --xyz"]
    return place, notes if own is None else []


def written(values: Vector, digits: int = 6) -> str:
    """Return three numbers as they are written in an attribute.

    Args:
        values: the numbers.
        digits: how many of each; 17 are as many as it takes to read the same number again.
    """
    return " ".join(_shortest(value + 0.0, digits) for value in values)  # no -0


def exact(values: Vector) -> str:
    """Return three numbers with all of the digits that they were given with."""
    return written(values, 17)


def _shortest(value: float, digits: int) -> str:
    """Return a number in as few digits as tell it, and no more than `digits`."""
    texts = (f"{value:.{count}g}" for count in range(min(6, digits), digits))
    return next((text for text in texts if float(text) == value), f"{value:.{digits}g}")


def _listed(robot: Robot) -> str:
    return f"links: {', '.join(list(robot.link_by_name)[:8])}"


def _size(part: Part) -> str:
    low, high = box_around_all(list(part.boxes))
    return " × ".join(f"{b - a:.2g}" for a, b in zip(low, high, strict=True))
