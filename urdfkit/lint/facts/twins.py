"""Twins: joints of one parent link whose names differ in the side or the end of the robot only."""

import re
from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint, Link, Vector
from urdfkit.lint.model.model import Model
from urdfkit.record import record

_SIDES: dict[str, tuple[str, ...]] = {
    "left": ("right",),
    "l": ("r",),
    "fl": ("fr",),
    "rl": ("rr",),
    "bl": ("br",),
    "lf": ("rf",),
    "lb": ("rb",),
    "lh": ("rh",),
    "hl": ("hr",),
}
"""Word for a part on the left → the words for its counterpart on the right."""

_OTHER_SIDES: dict[str, tuple[str, ...]] = {other: (word,) for word, others in _SIDES.items() for other in others}
"""Word for a part on the right → the word for its counterpart on the left."""

_ENDS: dict[str, tuple[str, ...]] = {
    "front": ("rear", "back", "hind"),
    "fl": ("rl", "bl", "hl"),
    "fr": ("rr", "br", "hr"),
    "lf": ("lh", "lb"),
    "rf": ("rh", "rb"),
}
"""Word for a part at the front → the words for its counterpart at the rear."""

_WORD = re.compile(r"left|front|(?<![a-z])(?:f[lr]|[rbh]l|l[fbh]|rf|l)(?![a-z])", re.IGNORECASE)

_RIGHT = re.compile(r"right|(?<![a-z])(?:[frbh]r|r[fbh]|r)(?![a-z])", re.IGNORECASE)

_ALIKE = 0.05
"""Largest relative difference of the sizes of equal shapes."""


@record(eq=False)
class Twins:
    """Two joints with one parent and one type.

    Attributes:
        first: the joint on the left or at the front.
        second: its counterpart.
        are_sides: whether they are on two sides, not at two ends.
    """

    first: Joint
    second: Joint
    are_sides: bool


def twins(model: Model) -> Iterator[Twins]:
    """Yield each pair of joints of one parent whose names differ in a side or an end only."""
    joints = model.robot.joint_by_name
    if len(joints) < len(model.robot.joints):
        return  # It is undefined which of two joints of one name applies.
    for joint in model.robot.joints:
        for are_sides in (True, False):
            for name in _counterparts(joint.name, _SIDES if are_sides else _ENDS):
                other = joints.get(name)
                if other is not None and (other.parent, other.type) == (joint.parent, joint.type):
                    yield Twins(joint, other, are_sides)


def mirrored(name: str) -> tuple[str, ...]:
    """Return the names of the counterparts of a name on the other side of the robot.

    Examples:
        >>> mirrored("left_wrist_joint")
        ('right_wrist_joint',)
    """
    return (*_counterparts(name, _SIDES), *_counterparts(name, _OTHER_SIDES, _RIGHT))


def side_of(name: str) -> str:
    """Return ``left`` or ``right``, the side of the robot that a name states; empty if it states none or both.

    Examples:
        >>> side_of("fl_wheel_joint")
        'left'
    """
    left = any(_counterparts(name, _SIDES))
    right = any(_counterparts(name, _OTHER_SIDES, _RIGHT))
    return "" if left is right else "left" if left else "right"


def links_of(pair: Twins, model: Model) -> tuple[Link, Link] | None:
    """Return the child links of twins; None if one is undefined."""
    links = model.robot.link_by_name
    first, second = links.get(pair.first.child or ""), links.get(pair.second.child or "")
    return (first, second) if first is not None and second is not None else None


def are_alike(first: Link, second: Link, model: Model) -> bool:
    """Return whether the shapes of two links have the same sizes; False if a size is unknown."""
    sizes = [_size(link, model) for link in (first, second)]
    if None in sizes:
        return False
    pairs = zip(*(sorted(size or ()) for size in sizes), strict=True)
    return all(abs(a - b) <= _ALIKE * max(a, b) for a, b in pairs)


def decimal_slip(first: float, second: float) -> int:
    """Return 10, 100 or 1000 if that is the ratio of the magnitudes of two numbers; 0 otherwise."""
    low, high = sorted((abs(first), abs(second)))
    return next((factor for factor in (10, 100, 1000) if low > 0.0 and abs(high / low / factor - 1.0) < 1e-3), 0)


def _size(link: Link, model: Model) -> Vector | None:
    extent = model.extents.get(link.name)
    if extent is None:
        return None
    x, y, z = (high - low for low, high in zip(extent.low, extent.high, strict=True))
    return x, y, z


def _counterparts(name: str, words: dict[str, tuple[str, ...]], pattern: re.Pattern[str] = _WORD) -> Iterator[str]:
    """Yield the names that differ from a name in one word only."""
    for match in pattern.finditer(name):
        word = match.group()
        for other in words.get(word.lower(), ()):
            spelt = other.upper() if word.isupper() else other.capitalize() if word[0].isupper() else other
            yield name[: match.start()] + spelt + name[match.end() :]
