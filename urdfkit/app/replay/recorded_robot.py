"""Motion of a robot in a recording."""

from collections.abc import Callable
from typing import Any

from urdfkit.app.replay.observed_robot import MOTION, ObservedRobot
from urdfkit.bridges.bag_file import BagFile
from urdfkit.errors import UsageError
from urdfkit.kinematics import Kinematics


class RecordedRobot(ObservedRobot):
    """A robot that moves as in a recording.

    Args:
        bag: the recording; its transforms, joint states and odometry are read here.
        kinematics: the robot.
        fixed_frame: frame in which poses are given; None for the one of `FIXED_FRAMES` or the root of the transforms.
        progress: called with the read part of the recording, 0 to 1.

    Raises:
        UsageError: the recording has transforms, and none of the fixed frame.
    """

    def __init__(
        self,
        bag: BagFile,
        kinematics: Kinematics,
        *,
        fixed_frame: str | None = None,
        progress: Callable[[float], None] = lambda _: None,
    ) -> None:
        super().__init__(kinematics, fixed_frame=fixed_frame)
        names = {each.name for each in bag.topics if each.type in MOTION}
        for k, recorded in enumerate(bag.messages(topics=names)):
            if k % 1000 == 0 and bag.end > bag.begin:
                progress((recorded.time - bag.begin) / (bag.end - bag.begin))
            self.add(recorded.topic.name, recorded.topic.type, bag.message(recorded), recorded.time)
        if fixed_frame is not None and len(self.frames) and fixed_frame not in self.frames:
            raise UsageError(f"--fixed-frame: no frame `{fixed_frame}` in the recording")


def recorded_description(bag: BagFile) -> Any:
    """Return the last robot description of a recording as a text; None without one."""
    names = {each.name for each in bag.topics if each.name.endswith("robot_description")}
    texts = [bag.message(each) for each in bag.messages(topics=names)] if names else []
    return next((text.data for text in reversed(texts) if getattr(text, "data", "")), None)
