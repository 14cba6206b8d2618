"""Recorder: write published messages to MCAP files, readable by ``ros2 bag`` and other MCAP tools.

The same simulation gives the same bytes: times are simulated, and the file has no data about the machine.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any

from urdfkit.atomic import staging, undisturbed
from urdfkit.bridges.jpeg_image import COMPRESSED_IMAGE, IMAGE, jpeg_image
from urdfkit.bridges.node.node import Quality, publisher_quality
from urdfkit.bridges.recording_options import RecordingOptions
from urdfkit.bus import Bus, Subscription, Topic
from urdfkit.errors import MissingDependencyError, ResourceError, UsageError

SUFFIX = ".mcap"
STEM = "recording"
"""File stem of a recording until it is moved into place."""
REPEATED = ("/tf_static", "/robot_description")
"""Ends of the names of topics whose last message is repeated at the begin of each further file: they are latched."""


def check_name(path: Path) -> None:
    """Raise unless a file has the suffix of a recording.

    Args:
        path: the file.

    Raises:
        UsageError: its suffix is not ``.mcap``.
    """
    if path.suffix != SUFFIX:
        raise UsageError(f"cannot record to {path}: recordings are MCAP files; name the file {path.stem}{SUFFIX}")


class Recorder:
    """Subscriber to topics with messages; records until `close`.

    Service requests, which the bus also transports as topics, are not recorded.

    Args:
        bus: the bus whose topics are recorded.
        path: the file, replaced if it exists; written to a temporary folder next to it until it is complete.
        clock: returns the time [s]; after a jump back, as on a reset, recorded times continue from the last one.
        options: selection of topics, compression, splitting.

    Raises:
        UsageError: the suffix of the file is not ``.mcap``.
        ResourceError: it cannot be written.
        MissingDependencyError: rosbags is missing, or too old to write MCAP.

    Attributes:
        count: messages recorded so far.
        files: complete files so far.
        options: the options.
    """

    def __init__(
        self, bus: Bus, path: str | Path, clock: Callable[[], float], options: RecordingOptions | None = None
    ) -> None:
        self.path, self.options = Path(path), options or RecordingOptions()
        check_name(self.path)
        if self.path.is_dir():
            raise ResourceError(f"cannot record to {path}: it is a folder")
        self.count = 0
        self.files: list[Path] = []
        self._bus, self._clock = bus, clock
        self._offset = self._last = 0.0
        self._subscriptions: list[Subscription] = []
        self._seen: set[str] = set()
        self._recorded: list[Topic] = []
        self._connections: dict[tuple[str, str], Any] = {}
        try:
            from rosbags.rosbag2 import Writer  # noqa: F401

            from urdfkit.messages import typestore
        except ImportError as error:
            raise MissingDependencyError("recording needs rosbags, 0.11 or newer: pip install -U rosbags") from error
        self._types = typestore()
        self._open()
        try:
            self.subscribe_new_topics()
        except BaseException:
            self._staged.close()
            raise

    def subscribe_new_topics(self) -> None:
        """Subscribe to topics advertised since the last call, and record the last message of each."""
        if len(self._bus.topics) == len(self._seen):
            return
        for topic in self._bus.topics:
            if topic.name not in self._seen:
                self._seen.add(topic.name)
                if "/msg/" in topic.type and self.options.includes(topic.name):
                    self._listen(topic)

    @property
    def topics(self) -> int:
        """Number of subscribed topics."""
        return len(self._subscriptions)

    def close(self) -> None:
        """Complete the file and move it into place; closing twice is harmless.

        Raises:
            ResourceError: it cannot be written.
        """
        if self._writer is None:
            return
        for each in self._subscriptions:
            each.close()
        self._complete()

    def __enter__(self) -> Recorder:
        """Return itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Complete the recording, also after an error."""
        self.close()

    def _open(self) -> None:
        """Begin a file. rosbags writes a folder that contains the file; only the file is kept.

        The file contains its own name, so a fixed name is used: the bytes do not depend on the name of the recording.
        """
        from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer

        self._staged = ExitStack()
        folder = self._staged.enter_context(staging(self.path.absolute().parent)) / STEM
        self._written = folder / f"{STEM}{SUFFIX}"
        try:
            self._writer: Any = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
            if self.options.compression:
                self._writer.set_compression(CompressionMode.STORAGE, CompressionFormat.ZSTD)
            self._writer.open()
        except BaseException:
            self._staged.close()
            raise
        self._connections.clear()
        self._begin, self._size = math.inf, 0

    def _complete(self) -> None:
        """Complete the file and move it into place."""
        writer, self._writer = self._writer, None
        file = self.options.file(self.path, len(self.files))
        with self._staged:
            try:
                writer.close()
                self._written.replace(file)
            except OSError as error:
                raise ResourceError(f"cannot write {file}: {error.strerror}") from error
        self.files.append(file)

    def _listen(self, topic: Topic) -> None:
        if self.options.jpeg is None or topic.type != IMAGE:
            self._connection(topic.name, topic.type)
        record = partial(self._record, topic.name, topic.type)
        if topic.count and (latest := topic.latest) is not None:
            record(latest)
        self._recorded.append(topic)
        self._subscriptions.append(self._bus.subscribe(topic.name, topic.type, record))

    def _connection(self, name: str, kind: str) -> Any:
        found = self._connections.get((name, kind))
        if found is None:
            found = self._connections[name, kind] = self._writer.add_connection(
                name, kind, typestore=self._types, offered_qos_profiles=[_offered(publisher_quality(name))]
            )
        return found

    def _record(self, name: str, kind: str, message: Any) -> None:
        t = self._clock() + self._offset
        if t < self._last:
            self._offset += self._last - t
            t = self._last
        self._last = t
        self._begin = min(self._begin, t)
        if t - self._begin >= self.options.split_duration or self._size >= self.options.split_size:
            self._continue()
        self._write(name, kind, message)

    def _continue(self) -> None:
        """Continue in another file, which begins with the last messages of latched topics."""
        self._complete()
        self._open()
        self._begin = self._last
        for topic in self._recorded:
            if topic.name.endswith(REPEATED) and topic.count:
                self._write(topic.name, topic.type, topic.latest)

    def _write(self, name: str, kind: str, message: Any) -> None:
        if kind == IMAGE and self.options.jpeg is not None:
            compressed = jpeg_image(message, self.options.jpeg)
            if compressed is not None:
                name, kind, message = f"{name}/compressed", COMPRESSED_IMAGE, compressed
        connection = self._connection(name, kind)
        data = self._types.serialize_cdr(message, kind)
        with undisturbed():  # a partial message would corrupt the recording
            self._writer.write(connection, round(self._last * 1e9), data)
        self.count += 1
        self._size += len(data)


def _offered(quality: Quality) -> Any:
    """Return a quality of service as ``ros2 bag`` stores it, which publishes with it again; durations are infinite."""
    from rosbags.interfaces import Qos, QosDurability, QosHistory, QosLiveliness, QosReliability, QosTime

    forever = QosTime(9223372036, 854775807)
    return Qos(
        QosHistory.KEEP_LAST,
        quality.depth,
        QosReliability.RELIABLE if quality.reliable else QosReliability.BEST_EFFORT,
        QosDurability.TRANSIENT_LOCAL if quality.latched else QosDurability.VOLATILE,
        forever,
        forever,
        QosLiveliness.AUTOMATIC,
        forever,
        avoid_ros_namespace_conventions=False,
    )
