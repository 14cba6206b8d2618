"""S909 twins-misplaced."""

from collections import Counter
from collections.abc import Iterator
from math import dist, hypot, inf

from urdfkit.description.urdf.robot import Joint, Link
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.placement.directions import Directions
from urdfkit.lint.facts.placement.mirrored_chains import asymmetric_offset
from urdfkit.lint.facts.placement.mirrored_shapes import unmirrored_shapes
from urdfkit.lint.facts.placement.twin_overlaps import overlapping_twins
from urdfkit.lint.facts.root_cause import Place, argument_of_coordinate, call_of, shared_argument, written_at
from urdfkit.lint.facts.twins import Twins, are_alike, decimal_slip, links_of, mirrored, side_of, twins
from urdfkit.lint.model.placement import links_below, shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_SAME = 0.02
"""Largest difference of equal coordinates, as a fraction of the distance from the parent."""

_UNEVEN = 0.25
"""Largest accepted difference of coordinates, as a fraction of the distance from the parent."""


_CONDITIONS = ("xacro:if", "xacro:unless")
"""Directives of a macro that select one of several origins."""

_UPRIGHT = 0.99
"""Cosine of the angle up to which the parent of twins counts as upright."""

_UNEVEN_WHEELS = 0.05
"""The same for wheels, which must touch the ground."""


class TwinsMisplaced(RobotRule):
    """A part and its counterpart on the other side, or at the other end, are not mirror images.

    ## What it does
    Compares the joint origins of parts of the same parent whose names differ only in a side (``left`` and ``right``,
    ``fl`` and ``fr``) or an end (``front`` and ``rear``). The coordinates of a left and a right part may differ only in
    one sign. The coordinates of a front and a rear part may differ only in one coordinate. Reports:

    - a part that is on the same side as its counterpart
    - counterparts in the same place, and coordinates that differ in a sign or a decimal point
    - moving joints that differ in a coordinate by more than a quarter of their distance from the parent, and wheels
      that differ by more than a twentieth
    - a left part on the right side, or a front part at the rear
    - the only joint of two chains, such as arms or legs, whose offset is not mirrored
    - joints with equal offsets although the shapes of their parents, or of their own links, are mirrored
    - shapes with equal offsets although the joints of their links are mirrored
    - links of the two sides, except hands and cameras, that overlap with every joint at zero

    ## Why is this bad?
    Both wheels are on one side of the robot, or one of them is in the air. Usually a sign or a decimal point is
    missing.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="8"/>
           <inertia ixx="0.0667" ixy="0" ixz="0" iyy="0.1733" iyz="0" izz="0.2267"/>
         </inertial>
       </link>
       <link name="left_wheel">
         <visual><geometry><sphere radius="0.1"/></geometry></visual>
         <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
       </link>
       <link name="right_wheel">
         <visual><geometry><sphere radius="0.1"/></geometry></visual>
         <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
       </link>
       <joint name="left_wheel_joint" type="continuous">
         <parent link="base"/><child link="left_wheel"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
       </joint>
       <joint name="right_wheel_joint" type="continuous">
    -    <parent link="base"/><child link="right_wheel"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
    +    <parent link="base"/><child link="right_wheel"/><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```
    """

    code = "S909"
    name = "twins-misplaced"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that does not match its counterpart, at most one for each joint."""
        if model.is_damaged:
            return
        for joint, message, help in _on_other_side(model):
            at_parent = joint.element.find("parent") or joint.element
            names = (*sorted(links_below(model.robot, joint.child or "")), *mirrored(joint.name))
            yield self.at(model, at_parent, message, attribute="link", joint=joint.name, help=help, names=names)
            return
        pairs = list(twins(model))
        defects = [(pair, defect) for pair in pairs if (defect := _defect(pair, model)) is not None]
        counts = Counter(joint.name for pair, _ in defects for joint in (pair.first, pair.second))
        found: set[str] = set()
        arguments: list[object] = []
        directions = Directions(pairs if defects else ())
        for pair, (message, help) in defects:
            both = (pair.first, pair.second)
            scores = [(counts[joint.name], len(directions.contradicted(joint))) for joint in both]
            wrong, right = both if scores[0] > scores[1] else both[::-1]
            if found.isdisjoint((pair.first.name, pair.second.name)):
                found.add(wrong.name)
                origin = wrong.element.find("origin") or wrong.element
                names = (*(joint.name for joint in both), *(joint.child for joint in both if joint.child))
                argument = _argument(model, wrong, right, directions.wrong_coordinate(wrong, pair))
                place, attribute = argument or (origin, "xyz")
                if argument is None or argument not in arguments:
                    arguments.append(argument)
                    yield self.at(model, place, message, attribute=attribute, joint=wrong.name, help=help, names=names)
        asymmetric = asymmetric_offset(model) if not found else None
        if asymmetric is not None:
            wrong, right, k = asymmetric
            found.add(wrong.name)
            origin = wrong.element.find("origin") or wrong.element
            place, attribute = _argument(model, wrong, right, k) or (origin, "xyz")
            values = " and ".join(f"{joint.origin.xyz[k]:g} m" for joint in (wrong, right))
            message = (
                f"joints `{wrong.name}` and `{right.name}` are not mirrored, unlike all other joints on the two sides: "
            )
            message += f"{'xyz'[k]} is {values}"
            help = "check the sign and the decimal point"
            names = (wrong.name, right.name)
            yield self.at(model, place, message, attribute=attribute, joint=wrong.name, help=help, names=names)
        for joint, message in (*_exchanged(model), *_equal_below_mirrored(model)) if not found else ():
            origin = joint.element.find("origin") or joint.element
            help = "check the signs of the coordinates"
            found.add(joint.name)
            yield self.at(model, origin, message, attribute="xyz", joint=joint.name, help=help)
            break
        for unmirrored, place, message in unmirrored_shapes(model) if not found else ():
            help = "check the sign of the offset"
            found.add(unmirrored.name)
            yield self.at(model, place, message, attribute="xyz", link=unmirrored.name, help=help)
            break
        for overlapping, place, message in overlapping_twins(model) if not found else ():
            help = "check their sizes, and the distance between the two sides"
            joints = model.robot.joints
            ends = (overlapping.name, *mirrored(overlapping.name))
            names = tuple(joint.name for joint in joints if joint.child in ends)
            written = written_at(model, place, "xyz") if place.tag == "origin" else None
            name = overlapping.name
            if written is not None:
                yield self.at_span(written, message, link=name, help=help, names=names)
            else:
                yield self.at(model, place, message, attribute="xyz", link=name, help=help, names=names)
            break


def _argument(model: Model, wrong: Joint, right: Joint, k: int) -> Place | None:
    """Return the argument of a macro call, or the call, that misplaces a joint in a coordinate."""
    origin, other = wrong.element.find("origin"), right.element.find("origin")
    if origin is None or other is None:
        return None
    if origin.origin.position == other.origin.position:
        argument = argument_of_coordinate(model, origin, other, k) or shared_argument(model, origin, other)
        tag = model.tag(origin.origin.position)
        if argument is not None or tag is None or all(above.name not in _CONDITIONS for above in tag.ancestors()):
            return argument
    call = call_of(wrong.element, [right.element])  # Conditions of the macro select one of several origins.
    return (call, "") if call is not None else None


def _on_other_side(model: Model) -> Iterator[tuple[Joint, str, str]]:
    """Yield a joint whose parent is on the other side of the robot, like the parent of its counterpart."""
    robot = model.robot
    for joint in robot.joints:
        child, parent = joint.child or "", joint.parent or ""
        sides = side_of(child), side_of(parent)
        if "" in sides or sides[0] == sides[1]:
            continue
        own = next((name for name in mirrored(parent) if name in robot.link_by_name), None)
        others = (each for name in mirrored(child) for each in robot.parents_of.get(name, ()))
        if own is None or any(side_of(each.child or "") == sides[1] for each in robot.joints if each.parent == own):
            continue  # both feet have sensors on both sides
        if any(each.parent == parent for each in others):
            message = f"joint `{joint.name}` attaches `{child}` to `{parent}`, like its counterpart on the other side"
            yield joint, message, f"write `{own}`"


def _defect(pair: Twins, model: Model) -> tuple[str, str] | None:
    """Return the message and help for joints that do not match; None if they do."""
    first, second, links = pair.first.origin.xyz, pair.second.origin.xyz, links_of(pair, model)
    if links is None or any(_is_unresolved(joint.element, model) for joint in (pair.first, pair.second)):
        return None
    names = f"`{pair.first.name}` and `{pair.second.name}`"
    distance = max(hypot(*first), hypot(*second))
    if distance == 0.0 or not (pair.first.is_movable or are_alike(*links, model)):
        return None
    differing = [k for k in range(3) if abs(first[k] - second[k]) > _SAME * distance]
    if not differing:
        if pair.are_sides and pair.first.is_movable and _are_mirrored_about(pair, links, model, _SAME * distance):
            message = f"joints {names} are not mirrored, unlike the shapes of their links: y is {first[1]:g} m for both"
            return message, "check the sign of the coordinate"
        if not _are_in_one_place(pair, links, model) or dist(first, second) > _size(links[0], model):
            return None
        return f"joints {names} have the same origin", "check the sign of one of the coordinates"
    for k in differing:
        if (factor := decimal_slip(first[k], second[k])) and abs(first[k]) + abs(second[k]) > _SAME * distance:
            x, y = (f"{value:g}" for value in (first[k], second[k]))
            return f"{'xyz'[k]} of joints {names} is {x} m and {y} m: a ratio of {factor}", "check the decimal point"
    flipped = [k for k in differing if abs(first[k] + second[k]) <= _SAME * distance]
    is_wheel = pair.are_sides and pair.first.type == "continuous" and "wheel" in pair.first.name.lower()
    accepted = (_UNEVEN_WHEELS if is_wheel else _UNEVEN) * distance
    uneven = [k for k in differing if k not in flipped and abs(abs(first[k]) - abs(second[k])) > accepted]
    if not pair.first.is_movable:
        return None
    if pair.are_sides and uneven:
        k = uneven[0]
        values = f"{first[k]:g} m and {second[k]:g} m"
        return f"joints {names} are not mirrored: {'xyz'[k]} is {values}", "make the coordinates match"
    if len(flipped) > 1 or (not pair.are_sides and len(flipped) + len(uneven) > 1):
        letters = " and ".join("xyz"[k] for k in sorted((*flipped, *([] if pair.are_sides else uneven))))
        return f"joints {names} differ in {letters}, not in one coordinate", "check the signs of the coordinates"
    return None


def _exchanged(model: Model) -> Iterator[tuple[Joint, str]]:
    """Yield a joint that is apart from its left-right twin along x and from its front-rear twin along y, reversed.

    Seen from the rear, the left is then on the right, whichever axis points forward.
    """
    ends = {pair.first.name: pair for pair in twins(model) if not pair.are_sides}
    for side in (pair for pair in twins(model) if pair.are_sides and pair.first.is_movable):
        end, frame = ends.get(side.first.name), model.frames.get(side.first.parent or "")
        if end is None or frame is None or frame.rotation[2][2] < _UPRIGHT:
            continue
        (x, y, _), (u, v, _) = (
            tuple(a - b for a, b in zip(pair.first.origin.xyz, pair.second.origin.xyz, strict=True))
            for pair in (side, end)
        )
        if abs(x) > abs(y) and abs(v) > abs(u) and u * y - v * x < 0.0:
            names = f"`{side.first.name}`, `{side.second.name}` and `{end.second.name}`"
            yield side.first, f"joints {names}: left and right are swapped with front and rear"


def _equal_below_mirrored(model: Model) -> Iterator[tuple[Joint, str]]:
    """Yield a joint with the offset of its twin along an axis in which the shapes of their parents are mirrored."""
    joints, links = model.robot.joint_by_name, model.robot.link_by_name
    for joint in model.robot.joints:
        other = next((joints[name] for name in mirrored(joint.name) if name in joints), None)
        if other is None or joint.name > other.name or not joint.is_movable or joint.parent == other.parent:
            continue
        if other.parent not in mirrored(joint.parent or "") or joint.origin.xyz != other.origin.xyz:
            continue
        shapes = [shapes_of(links[each.parent or ""]) for each in (joint, other) if each.parent in links]
        if len(shapes) != 2 or len(shapes[0]) != len(shapes[1]):
            continue
        places = [(one.origin.xyz, two.origin.xyz) for one, two in zip(*shapes, strict=True)]
        for k in range(3):
            is_mirrored = any(one[k] != 0.0 for one, _ in places) and all(one[k] == -two[k] for one, two in places)
            frames = [model.frames.get(each.parent or "") for each in (joint, other)]
            if joint.origin.xyz[k] == 0.0 or not is_mirrored or None in frames:
                continue
            if len({frame.rotation for frame in frames if frame is not None}) == 1:
                names = f"`{joint.name}` and `{other.name}`"
                value = f"{'xyz'[k]} is {joint.origin.xyz[k]:g} m for both"
                yield other, f"joints {names} are not mirrored, unlike the shapes of their parents: {value}"


def _are_mirrored_about(pair: Twins, links: tuple[Link, Link], model: Model, least: float) -> bool:
    """Return whether twins off the middle of a symmetric parent have the same y, but mirrored shapes.

    The blades of scissors, on one pivot, turn in opposite directions.
    """
    limits = [(each.limit.lower, each.limit.upper) if each.limit else None for each in (pair.first, pair.second)]
    if pair.first.axis != pair.second.axis or limits[0] != limits[1]:
        return False
    parent = model.extents.get(pair.first.parent or "")
    if parent is None or abs(pair.first.origin.xyz[1]) <= least or pair.first.origin.rpy != pair.second.origin.rpy:
        return False
    shapes = [[shape.origin.xyz[1] for shape in shapes_of(link)] for link in links]
    is_symmetric = abs(parent.low[1] + parent.high[1]) <= _SAME * parent.diagonal
    is_mirrored = len(shapes[0]) == len(shapes[1]) and all(a == -b != 0.0 for a, b in zip(*shapes, strict=False))
    return bool(shapes[0]) and is_symmetric and is_mirrored


def _are_in_one_place(pair: Twins, links: tuple[Link, Link], model: Model) -> bool:
    """Return whether twins with the same origin have the same axis, and shapes at the same place.

    Joints that turn about it in opposite directions count too, but fingers that slide apart do not.
    """
    first, second = pair.first, pair.second
    axes = (
        [second.axis]
        if first.type == "prismatic"
        else [second.axis, (-second.axis[0], -second.axis[1], -second.axis[2])]
    )
    if first.origin.rpy != second.origin.rpy or (first.is_movable and first.axis not in axes):
        return False
    shapes = [[(shape.geometry, shape.origin) for shape in shapes_of(link)] for link in links]
    return bool(shapes[0]) and (shapes[0] == shapes[1] or _are_at_one_place(links, model))


def _size(link: Link, model: Model) -> float:
    extent = model.extents.get(link.name)
    return extent.diagonal if extent is not None else inf


def _are_at_one_place(links: tuple[Link, Link], model: Model) -> bool:
    first, second = (model.extents.get(link.name) for link in links)
    if first is None or second is None:
        return False
    corners = zip((*first.low, *first.high), (*second.low, *second.high), strict=True)
    return all(abs(a - b) <= _SAME * first.diagonal for a, b in corners)


def _is_unresolved(joint: Element, model: Model) -> bool:
    origin = joint.find("origin")
    return origin is not None and any(model.is_unresolved(origin, name) for name in ("xyz", "rpy"))
