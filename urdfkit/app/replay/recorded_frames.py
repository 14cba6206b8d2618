"""Frames of a recording: the transforms of ``/tf`` and ``/tf_static``, at any time."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.app.replay.recorded_values import PoseTimeline
from urdfkit.scene.pose_matrices import pose_matrices

Array = NDArray[np.float64]


class RecordedFrames:
    """The tree of transforms. As in tf2, each frame has one parent: the one of its last transform.

    Args:
        length: number of transforms that are kept of each frame; None for all.
    """

    def __init__(self, length: int | None = None) -> None:
        self._length = length
        self._parents: dict[str, str] = {}
        self._poses: dict[str, PoseTimeline] = {}
        self._static: set[str] = set()

    def add(self, time: float, message: Any, *, static: bool = False) -> None:
        """Add the transforms of a TFMessage that was received at a time [s]; static ones hold at all times."""
        for each in message.transforms:
            child, parent = _name(each.child_frame_id), _name(each.header.frame_id)
            if child == parent:
                continue
            if child not in self._poses or (static and child in self._static):
                self._poses[child] = PoseTimeline(self._length)
            if static:
                self._static.add(child)
            self._parents[child] = parent
            moved, turned = each.transform.translation, each.transform.rotation
            pose = (moved.x, moved.y, moved.z, turned.x, turned.y, turned.z, turned.w)
            self._poses[child].add(time, pose)

    def __contains__(self, frame: str) -> bool:
        """Whether a frame has a parent or a child."""
        return frame in self._parents or frame in self._parents.values()

    def __len__(self) -> int:
        """Number of frames with a parent."""
        return len(self._parents)

    def ancestors(self, frame: str) -> list[str]:
        """Return a frame and its parents, up to the root of its tree."""
        found = [frame]
        while (parent := self._parents.get(found[-1])) is not None and parent not in found:
            found.append(parent)
        return found

    def transform(self, fixed: str, frame: str, time: float) -> Array | None:
        """Return the pose of a frame in a fixed frame, shape (4, 4); None if no transforms connect them."""
        up, down = self.ancestors(frame), self.ancestors(fixed)
        common = next((each for each in up if each in down), None)
        if common is None:
            return None
        result = self._product(up[: up.index(common)], time)
        if below := down[: down.index(common)]:
            result = np.asarray(np.linalg.inv(self._product(below, time)) @ result)
        return result

    def _product(self, frames: list[str], time: float) -> Array:
        """Return the pose of the first frame in the parent of the last one."""
        result = np.eye(4)
        for frame in frames:
            result = pose_matrices(self._poses[frame].at(time))[0] @ result
        return result

    def prefix(self, link: str) -> str:
        """Return what stands before the names of links, such as ``robot1/``, judged by the name of one link."""
        names = {*self._parents, *self._parents.values()}
        if link in names:
            return ""
        longer = sorted(name for name in names if name.endswith(f"/{link}"))
        return longer[0].removesuffix(link) if longer else ""


def _name(frame: str) -> str:
    """Return a frame without the slash that tf of ROS 1 wrote before it."""
    return frame.lstrip("/")
