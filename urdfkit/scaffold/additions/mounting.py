"""Choice of the link and the place for a new part."""

from urdfkit.description.urdf.geometry import box_around_all
from urdfkit.description.urdf.robot import Link, Robot, Vector
from urdfkit.errors import ResourceError, did_you_mean
from urdfkit.scaffold.additions.free_placement import Part, free_place, overlapped, spot
from urdfkit.scaffold.additions.link_boxes import Boxes


def parent_link(robot: Robot, name: str | None) -> Link:
    """Return the link to mount a part on.

    Args:
        robot: the robot.
        name: the requested link; None: ``base_link`` if it has shapes, otherwise the heaviest link.

    Raises:
        ResourceError: the robot has no such link.
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
    """Return the length, width and height of a link [m]; None without shapes, or if a mesh cannot be read.

    Args:
        robot: the robot.
        link: a link of the robot.
    """
    own = Boxes(robot).of(link)
    if not own:
        return None
    x, y, z = (high - low for low, high in zip(*box_around_all(own), strict=True))
    return x, y, z


def mount(robot: Robot, link: Link, part: Part, xyz: Vector | None) -> tuple[Vector, list[str]]:
    """Return the place of a part in the frame of its link [m], and notes to print.

    Args:
        robot: the robot.
        link: the link that the part is mounted on.
        part: the part to mount.
        xyz: the requested place [m]; None: a free place.

    Raises:
        ResourceError: no place is free.
    """
    boxes = Boxes(robot)
    own = boxes.of(link)
    others = [(name, box) for name, box in boxes.seen_from(link) if name != link.name]
    if xyz is not None:
        solid = [(link.name, box) for box in own or [] if part.where != "middle"]
        hit = overlapped(part, xyz, [*others, *solid])
        return xyz, [f"at {written(xyz)} it overlaps `{hit}`"] if hit is not None else []
    place = free_place(own or [], [box for _, box in others], part)
    if place is None:
        neighbour = overlapped(part, spot(own, part), others) if own else None
        near = f" next to `{neighbour}`" if neighbour is not None else ""
        raise ResourceError(
            f"`{link.name}` has no free space{near} for a part of {_size(part)} m; nothing was changed; "
            "choose another link with --parent, or a place with --xyz"
        )
    notes = [f"the meshes of `{link.name}` cannot be read: check that the part does not overlap it, and use --xyz"]
    return place, notes if own is None else []


def written(values: Vector, digits: int = 6) -> str:
    """Return three numbers formatted for an attribute.

    Args:
        values: the numbers.
        digits: maximum number of digits; 17 digits preserve every value.
    """
    return " ".join(_shortest(value + 0.0, digits) for value in values)  # no -0


def exact(values: Vector) -> str:
    """Return three numbers formatted without loss of precision."""
    return written(values, 17)


def _shortest(value: float, digits: int) -> str:
    """Return a number with the fewest digits that represent it, and at most `digits`."""
    texts = (f"{value:.{count}g}" for count in range(min(6, digits), digits))
    return next((text for text in texts if float(text) == value), f"{value:.{digits}g}")


def _listed(robot: Robot) -> str:
    return f"links: {', '.join(list(robot.link_by_name)[:8])}"


def _size(part: Part) -> str:
    low, high = box_around_all(list(part.boxes))
    return " × ".join(f"{b - a:.2g}" for a, b in zip(low, high, strict=True))
