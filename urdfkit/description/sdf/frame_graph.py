"""Frame graph of a world or model: frames are relative to other frames (SDF 1.7 and later) and resolved to poses."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.sdf.values import RawPose
from urdfkit.description.urdf.geometry import IDENTITY, between, compose, inverse
from urdfkit.description.urdf.robot import Pose
from urdfkit.description.xml.source import Position
from urdfkit.errors import DescriptionError, did_you_mean
from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Literal

    Kind = Literal["link", "joint", "frame", "model"]


@record
class _Frame:
    kind: Kind
    raw: RawPose
    base: str
    attached_to: str
    placement: str
    strict: bool


class Scope:
    """The frames of one model, or of the world.

    A frame may be relative to any other frame of its scope, or to ``nested::frame`` of a nested model
    (http://sdformat.org/tutorials?tut=pose_frame_semantics).

    Args:
        root: the frame of the scope itself: ``__model__`` or ``world``.
        owner: name of the model or world in messages.
    """

    def __init__(self, root: str, owner: str) -> None:
        self.root, self.owner = root, owner
        self.canonical = ""
        self._frames: dict[str, _Frame] = {}
        self._nested: dict[str, Scope] = {}
        self._poses: dict[str, Pose] = {}
        self._open: list[str] = []

    def add(
        self,
        name: str,
        kind: Kind,
        raw: RawPose,
        *,
        default: str = "",
        placement: str = "",
        nested: Scope | None = None,
        strict: bool = True,
    ) -> None:
        """Add a frame.

        Args:
            name: name of the frame.
            kind: kind of the frame.
            raw: pose of the frame.
            default: the frame that the pose is relative to by default, and that the new frame is attached to.
            placement: the frame inside `nested` that the pose places.
            nested: the frames of a model.
            strict: names are unique among all kinds (SDF 1.7), not only among frames of the same kind.

        Raises:
            DescriptionError: the name already exists or is reserved.
        """
        if name == "world" or (name.startswith("__") and name.endswith("__")):
            raise DescriptionError(f"`{name}` is a reserved name; rename the {kind}", position=raw.position)
        taken = self._frames.get(name)
        if taken is not None:
            if taken.kind == kind or (strict and taken.strict):
                advice = "; give one of them another <name>" if kind == taken.kind == "model" else ""
                message = f"{self.owner} already has a {taken.kind} `{name}` (line {taken.raw.position.line}){advice}"
                raise DescriptionError(message, position=raw.position)
            return
        base = default or self.root
        self._frames[name] = _Frame(kind, raw, raw.relative_to or base, base, placement, strict)
        if nested is not None:
            self._nested[name] = nested

    def merge(self, name: str, inner: Scope, raw: RawPose, placement: str) -> None:
        """Add the frames of a model that becomes part of this one (``<include merge="true">``, SDF 1.9).

        Args:
            name: name of the model.
            inner: frames of the model.
            raw: pose of the model.
            placement: the frame inside the model that the pose places.

        Raises:
            DescriptionError: a name already exists.
        """
        whole = f"__merged__{name}__"
        link = inner._canonical_link(raw.position)
        self._frames[whole] = _Frame("frame", raw, raw.relative_to or self.root, link, placement, True)
        self._nested[whole] = inner
        for each, frame in inner._frames.items():
            if not each.startswith("__"):
                placed = RawPose(inner.pose(each), whole, frame.raw.position)
                base = whole if frame.attached_to == inner.root else frame.attached_to
                self.add(each, frame.kind, placed, default=base, nested=inner._nested.get(each))

    def names(self, kind: Kind) -> Iterator[str]:
        """Yield the names of the frames of a kind."""
        return (name for name, frame in self._frames.items() if frame.kind == kind)

    def pose(self, name: str, position: Position | None = None) -> Pose:
        """Return the pose of a frame in this scope.

        Args:
            name: a frame of the scope, or ``nested::frame``.
            position: position of the reference.

        Raises:
            DescriptionError: unknown frame, or frame poses form a cycle.
        """
        if name == self.root:
            return IDENTITY
        if name in self._poses:
            return self._poses[name]
        frame = self._frames.get(name)
        if frame is None:
            first, separator, rest = name.partition("::")
            if separator and first in self._nested:
                return compose(self.pose(first, position), self._nested[first].pose(rest, position))
            raise self._unknown(name, position)
        if name in self._open:
            circle = " → ".join([*self._open[self._open.index(name) :], name])
            raise DescriptionError(f"frame poses form a cycle: {circle}", position=frame.raw.position)
        self._open.append(name)
        try:
            found = compose(self.pose(frame.base, frame.raw.position), frame.raw.pose)
            if frame.placement:
                found = compose(found, inverse(self._nested[name].pose(frame.placement, frame.raw.position)))
        finally:
            self._open.pop()
        self._poses[name] = found
        return found

    def place(self, raw: RawPose, default: str, target: str) -> Pose:
        """Return a pose relative to the frame `target`; unchanged if it is relative to `target` already.

        Args:
            raw: the pose.
            default: the frame that the pose is relative to by default.
            target: the frame to express the pose in.

        Raises:
            DescriptionError: unknown frame.
        """
        base = raw.relative_to or default
        if base == target:
            return raw.pose
        return between(self.pose(target, raw.position), compose(self.pose(base, raw.position), raw.pose))

    def link_of(self, name: str, position: Position) -> str:
        """Return the link that a frame is attached to, ``nested::link`` in a nested model; ``world`` for the world.

        Raises:
            DescriptionError: unknown frame, or a frame that is not attached to a link.
        """
        seen: list[str] = []
        while True:
            if name == "world":
                return name
            if name in seen:
                circle = " → ".join([*seen, name])
                raise DescriptionError(f"frames are attached to each other in a cycle: {circle}", position=position)
            seen.append(name)
            if name == self.root:
                name = self._canonical_link(position)
            frame = self._frames.get(name)
            if frame is None:
                first, separator, rest = name.partition("::")
                if not separator or first not in self._nested:
                    raise self._unknown(name, position)
                return f"{first}::{self._nested[first].link_of(rest, position)}"
            if frame.kind == "link":
                return name
            if frame.kind == "model":
                nested = self._nested[name]
                return f"{name}::{nested.link_of(nested.root, position)}"
            name = frame.attached_to

    def _canonical_link(self, position: Position) -> str:
        if self.canonical:
            return self.canonical
        first = next(self.names("link"), None) or next(self.names("model"), None)
        if first is None:
            raise DescriptionError(f"{self.owner} has no link to attach to", position=position)
        return first

    def _unknown(self, name: str, position: Position | None) -> DescriptionError:
        frames = [self.root, *self._frames, *(f"{m}::{f}" for m, s in self._nested.items() for f in s._frames)]
        return DescriptionError(f"no frame `{name}` in {self.owner}{did_you_mean(name, frames)}", position=position)
