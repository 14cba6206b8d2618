"""Read attribute values leniently: an unusable value becomes a `Problem` and is replaced by a default."""

from __future__ import annotations

import math

from urdfkit.description.urdf.robot import Pose, Problem, Vector
from urdfkit.description.urdf.version import QUATERNION, VERSIONS, Version
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number, numbers, why_not

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from typing import Any

    from urdfkit.description.urdf.robot import ProblemKind

    Part = tuple[str, Any, list[Problem], Version]
    """Subject of the messages when an element was read, the part read from it, the problems in it, and the version."""

ZERO: Vector = (0.0, 0.0, 0.0)

LARGEST = 1e30
"""Largest finite value accepted; larger values count as infinite, because their powers would overflow."""


AGREEMENT = 1e-3
"""Largest difference between entries of the rotations of ``rpy`` and ``quat_xyzw`` that is rounding."""

GAZEBO_VALUES = {
    **dict.fromkeys(
        ("mu1", "mu2", "kp", "kd", "maxVel", "max_vel", "minDepth", "min_depth", "maxContacts", "dampingFactor"),
        "a number, zero or greater",
    ),
    "fdir1": "3 numbers",
    "gravity": "true or false",
    "turnGravityOff": "true or false",
    "selfCollide": "true or false",
    "self_collide": "true or false",
}
"""Elements of a ``<gazebo>`` block with numbers or truth values, and their valid values."""

TRUTHS = {"true": True, "yes": True, "1": True, "false": False, "no": False, "0": False}
"""Values of the elements that are true or false; Gazebo ignores case, too."""


class Reader:
    """Reads values and records problems, in document order; a text that occurs again is parsed once.

    Args:
        earlier: element → the part read from it before; None to read every element.
        version: the version of URDF to read.

    Attributes:
        parts: element → the part read from it.
    """

    def __init__(self, earlier: Mapping[Element, Part] | None = None, version: Version = VERSIONS[0]) -> None:
        self.version = version
        self.problems: list[Problem] = []
        self.parts: dict[Element, Part] = {}
        self._earlier = earlier
        self._poses: dict[tuple[str | None, str | None], Pose] = {}
        self._vectors: dict[str, Vector] = {}
        self._numbers: dict[str, float] = {}
        self.subject = ""
        """The link or joint being read, for the messages."""

    def part(self, read: Callable[[Reader, Element], Any], element: Element) -> Any:
        """Return the part read from an element; reuses the result of an earlier run if available."""
        if self._earlier is None:
            return read(self, element)
        found = self._earlier.get(element)
        if found is None or found[3] != self.version or (found[2] and found[0] != self.subject):
            subject, before = self.subject, len(self.problems)
            one = read(self, element)
            found = subject, one, self.problems[before:], self.version
        else:
            self.problems += found[2]
        self.parts[element] = found
        return found[1]

    def note(self, kind: ProblemKind, message: str, element: Element, attribute: str | None = None) -> None:
        """Record a problem.

        Args:
            kind: category of the problem.
            message: one line for the user.
            element: the element that has the problem.
            attribute: the attribute that has the problem; None for the element as a whole.
        """
        subject = f"{self.subject}: " if self.subject else ""
        self.problems.append(Problem(kind, subject + message, element, attribute))

    def text(self, element: Element, attribute: str) -> str | None:
        """Return a required attribute; record a problem if it is missing."""
        value = element.attributes.get(attribute)
        if value is None:
            self.note("missing", f"<{element.tag}> has no attribute `{attribute}`", element, attribute)
        return value

    def number(
        self, element: Element, attribute: str, *, required: bool = False, infinite: bool = False
    ) -> float | None:
        """Return a number, None when it is missing or unusable.

        Args:
            element: the element that contains the number.
            attribute: name of the attribute.
            required: whether to record a problem if the attribute is missing.
            infinite: whether infinity is allowed.
        """
        text = element.attributes.get(attribute)
        if text is None:
            if required:
                self.text(element, attribute)
            return None
        if text in self._numbers:
            return self._numbers[text]
        value = number(text)
        if value is None:
            if numbers(text):
                self._note_arity(element, attribute, text, 1)
            else:
                self._note_number(element, attribute, text, "a number")
        elif math.isnan(value) or (abs(value) > LARGEST and not infinite):
            self._note_infinite(element, attribute, text)
            return None
        elif abs(value) <= LARGEST:
            self._numbers[text] = value
        return value

    def number_or(self, element: Element, attribute: str, default: float) -> float:
        """Return a number, or a default when it is missing or unusable."""
        value = self.number(element, attribute)
        return default if value is None else value

    def numbers(self, element: Element, attribute: str, count: int) -> tuple[float, ...] | None:
        """Return `count` numbers, None when they are missing or unusable."""
        text = element.attributes.get(attribute)
        if text is None:
            return None
        values = numbers(text)
        if values is None or not values:
            self._note_number(element, attribute, text, f"{count} numbers")
            return None
        if len(values) != count:
            self._note_arity(element, attribute, text, count)
            return None
        if not all(map(math.isfinite, values)) or max(map(abs, values)) > LARGEST:
            self._note_infinite(element, attribute, text)
            return None
        return tuple(values)

    def vector(self, element: Element, attribute: str) -> Vector | None:
        """Return three numbers, None when they are missing or unusable."""
        text = element.attributes.get(attribute, "")
        if text in self._vectors:
            return self._vectors[text]
        values = self.numbers(element, attribute, 3)
        if values is None:
            return None
        self._vectors[text] = found = values[0], values[1], values[2]
        return found

    def pose(self, parent: Element) -> Pose:
        """Return the ``<origin>`` of an element; the identity if it is missing."""
        origin = parent.find("origin")
        if origin is None:
            return Pose()
        if "quat_xyzw" in origin.attributes:
            if self.version >= QUATERNION:
                return self._pose_of_quaternion(origin)
            self.note("version", "`quat_xyzw` in URDF 1.0", origin, "quat_xyzw")
        texts = origin.attributes.get("xyz"), origin.attributes.get("rpy")
        found = self._poses.get(texts)
        if found is None:
            problems = len(self.problems)
            xyz, rpy = self.vector(origin, "xyz"), self.vector(origin, "rpy")
            found = Pose(xyz or ZERO, rpy or ZERO)
            if len(self.problems) == problems:
                self._poses[texts] = found
        return found

    def _pose_of_quaternion(self, origin: Element) -> Pose:
        from urdfkit.description.urdf.geometry import difference  # few robots need it

        turn = self.quaternion(origin) or ZERO
        if "rpy" in origin.attributes:
            rpy = self.vector(origin, "rpy") or ZERO
            if difference(Pose(rpy=rpy), Pose(rpy=turn)) > AGREEMENT:
                self.note("conflict", "<origin> has different rotations in `rpy` and `quat_xyzw`", origin, "quat_xyzw")
        return Pose(self.vector(origin, "xyz") or ZERO, turn)

    def quaternion(self, origin: Element) -> Vector | None:
        """Return roll, pitch, yaw [rad] of ``quat_xyzw``; no rotation if it is zero, None if it is unusable."""
        from urdfkit.description.urdf.geometry import rpy_of_quaternion

        q = self.numbers(origin, "quat_xyzw", 4)
        if q is None:
            return None
        largest = max(map(abs, q))
        if largest == 0.0:
            message = f'quat_xyzw="{_short(origin.attributes["quat_xyzw"])}" is not a rotation'
            self.note("zero", message, origin, "quat_xyzw")
            return ZERO
        x, y, z, w = (value / largest for value in q)
        return rpy_of_quaternion(x, y, z, w)

    def inner_number(self, element: Element | None) -> float | None:
        """Return the number in an element's text; None when it is missing or unusable."""
        if element is None:
            return None
        value = number(element.text)
        if value is None:
            self.note("bad-number", _not(element.text, "a number", f"<{element.tag}>"), element)
        return value

    def check_gazebo_value(self, element: Element) -> None:
        """Note an invalid value of one of `GAZEBO_VALUES`, in an element's text or ``value``."""
        attribute = None if element.text else "value"
        text = element.text or element.get("value") or ""
        wanted = GAZEBO_VALUES[element.tag]
        if wanted == "true or false":
            is_valid = text.strip().lower() in TRUTHS
        else:
            values, count = numbers(text) or (), 3 if element.tag == "fdir1" else 1
            is_valid = len(values) == count and all(map(math.isfinite, values)) and (count == 3 or min(values) >= 0.0)
        if not is_valid:
            self.note("bad-number", _not(text, wanted, f"<{element.tag}>"), element, attribute)

    def _note_number(self, element: Element, attribute: str, text: str, wanted: str) -> None:
        where = f"{attribute} of <{element.tag}>"
        self.note("bad-number", _not(text, wanted, where), element, attribute)

    def _note_infinite(self, element: Element, attribute: str, text: str) -> None:
        values = numbers(text) or ()
        why = "too large" if all(map(math.isfinite, values)) else "not finite"
        self.note("not-finite", f'{attribute}="{_short(text)}" of <{element.tag}> is {why}', element, attribute)

    def _note_arity(self, element: Element, attribute: str, text: str, count: int) -> None:
        count_found = len(text.split())
        expected = "1 number" if count == 1 else f"{count} numbers"
        message = f'{attribute}="{_short(text)}" of <{element.tag}>: expected {expected}, found {count_found}'
        self.note("wrong-arity", message, element, attribute)


def _not(text: str, wanted: str, where: str) -> str:
    why = why_not(text)
    return f"{where}: `{_short(text)}` is not {wanted}{f' ({why})' if why else ''}"


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 60 else line[:59] + "…"
