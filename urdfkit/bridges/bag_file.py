"""Recorded messages of ROS 1 and ROS 2: .bag, .db3 and .mcap files, and folders of ``ros2 bag``."""

from __future__ import annotations

import math
import sys
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType
from typing import Any, NamedTuple

from urdfkit.errors import MissingDependencyError, ResourceError
from urdfkit.missing_files import missing_path

FIRST_BYTES = {".mcap": b"\x89MCAP", ".db3": b"SQLite format 3", ".bag": b"#ROSBAG V"}
"""Suffix → the first bytes of such files."""
NANOSECONDS = 1e9
_MODULE = "rosbags.usertypes"
REASONS = {
    "File end magic is invalid.": "its end is missing, as after a crash or an incomplete download; "
    "`mcap recover FILE -o NEW` recovers the rest"
}
"""Reasons of errors of rosbags, in words of users."""


class RecordedTopic(NamedTuple):
    """A topic of a recording: its name, its type as ``package/msg/Type``, and its number of messages."""

    name: str
    type: str
    messages: int


class RecordedMessage(NamedTuple):
    """A message of a recording: its topic, the time of its reception [s], and its bytes."""

    topic: RecordedTopic
    time: float
    data: bytes


class BagFile:
    """A recording, open for reading.

    Args:
        path: a .mcap, .db3 or .bag file, or a folder that ``ros2 bag record`` wrote.

    Raises:
        ResourceError: there is no such file, or it is no recording or damaged.
        MissingDependencyError: rosbags is missing.

    Attributes:
        path: the file.
        topics: the topics, in the order of the file.
        begin: time of the first message [s].
        end: time of the last message [s].
        count: number of messages.
        ros: version of ROS that wrote it, 1 or 2.
    """

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        if not self.path.exists():
            raise ResourceError(missing_path(self.path))
        if self.path.is_file() and self.path.suffix not in FIRST_BYTES:
            raise ResourceError(f"{self.path} is not a recording: recordings are {', '.join(FIRST_BYTES)} files")
        if self.path.is_file() and not _begins_with(self.path, FIRST_BYTES[self.path.suffix]):
            raise ResourceError(
                f"{self.path} is not a recording: its content does not have the format of a {self.path.suffix} file"
            )
        if self.path.is_dir() and not (self.path / "metadata.yaml").exists():
            raise ResourceError(f"{self.path} is not a recording: a ros2 bag folder contains metadata.yaml")
        try:
            from rosbags.highlevel import AnyReader

            from urdfkit.messages import register_layouts, typestore
        except ImportError as error:
            raise MissingDependencyError("recordings need rosbags, 0.11 or newer: pip install -U rosbags") from error
        try:
            with kept_message_types():
                self._reader = AnyReader([self.path], default_typestore=typestore())
                self._reader.open()
                register_layouts(self._reader.typestore.fielddefs)
            self.topics = tuple(
                RecordedTopic(each.topic, each.msgtype, each.msgcount) for each in self._reader.connections
            )
            self.count = self._reader.message_count
        except Exception as error:  # damaged files raise errors of every kind
            reason = REASONS.get(_first_line(error), _first_line(error))
            raise ResourceError(f"{self.path} cannot be read as a recording: {reason}") from error
        self.begin, self.end = 0.0, 0.0
        if self.count:
            self.begin = self._reader.start_time / NANOSECONDS
            self.end = max(self.begin, (self._reader.end_time - 1) / NANOSECONDS)  # rosbags ends after the last message
        self.ros = 2 if self._reader.is2 else 1

    def messages(
        self, *, begin: float | None = None, topics: Collection[str] | None = None
    ) -> Iterator[RecordedMessage]:
        """Yield messages in the order of their times.

        Args:
            begin: time of the first one [s].
            topics: names of topics; None for all.

        Raises:
            ResourceError: the file is damaged.
        """
        chosen = [each for each in self._reader.connections if topics is None or each.topic in topics]
        if not chosen:
            return
        records = {id(each): RecordedTopic(each.topic, each.msgtype, each.msgcount) for each in chosen}
        start = None if begin is None else round(begin * NANOSECONDS)
        try:
            for connection, time, data in self._reader.messages(chosen, start=start):
                topic = records.get(id(connection))
                if topic is None:  # readers may copy their connections
                    topic = RecordedTopic(connection.topic, connection.msgtype, connection.msgcount)
                yield RecordedMessage(topic, time / NANOSECONDS, bytes(data))
        except Exception as error:
            raise ResourceError(f"{self.path} is damaged: {_first_line(error)}") from error

    def period(self, topic: str) -> tuple[float, float]:
        """Return the times of the first and the last message of a topic [s].

        Raises:
            ResourceError: the file is damaged.
        """
        begin = end = next(self.messages(topics=[topic])).time
        start, window = math.inf, 1.0
        while end == begin and start > begin:  # the last message is usually near the end of the file
            start, window = max(begin, self.end - window), 4 * window
            for message in self.messages(begin=start, topics=[topic]):
                end = message.time
        return begin, end

    def message(self, recorded: RecordedMessage) -> Any:
        """Return the message of its bytes.

        Raises:
            ResourceError: the bytes are not a message of the type.
        """
        try:
            return self._reader.deserialize(recorded.data, recorded.topic.type)
        except Exception as error:
            raise ResourceError(
                f"{self.path}: a message on {recorded.topic.name} is not a {recorded.topic.type}: {_first_line(error)}"
            ) from error

    def close(self) -> None:
        """Close the file."""
        self._reader.close()

    def __enter__(self) -> BagFile:
        """Return itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Close the file."""
        self.close()


@contextmanager
def kept_message_types() -> Iterator[None]:
    """Keep the classes of our messages inside the context: rosbags replaces the module in which pickle finds them."""
    from urdfkit.messages import typestore

    typestore()
    ours = sys.modules.get(_MODULE)
    try:
        yield
    finally:
        if ours is not None:
            sys.modules[_MODULE] = ours


def _begins_with(path: Path, first: bytes) -> bool:
    try:
        with path.open("rb") as file:
            return file.read(len(first)) == first
    except OSError as error:
        raise ResourceError(f"{path} cannot be read: {error.strerror}") from error


def _first_line(error: Exception) -> str:
    return (str(error) or type(error).__name__).splitlines()[0]
