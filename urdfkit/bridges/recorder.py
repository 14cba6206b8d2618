"""Recorder: write all published messages to one MCAP file, readable by ``ros2 bag`` and other MCAP tools.

The same simulation gives the same bytes: times are simulated, and the file has no data about the machine.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from types import TracebackType
from typing import Any

from urdfkit.atomic import staging, undisturbed
from urdfkit.bus import Bus, Subscription, Topic
from urdfkit.errors import MissingDependencyError, ResourceError, UsageError

SUFFIX = ".mcap"
STEM = "recording"
"""File stem of a recording until it is moved into place."""


def check_name(path: Path) -> None:
    """Raise unless a file has the suffix of a recording.

    Args:
        path: the file.

    Raises:
        UsageError: its suffix is not ``.mcap``.
    """
    if path.suffix != SUFFIX:
        raise UsageError(f"cannot record to {path}: recordings are MCAP; call it {path.stem}{SUFFIX}")


class Recorder:
    """Subscriber to every topic with messages; records until `close`.

    Service requests, which the bus also transports as topics, are not recorded.

    Args:
        bus: the bus whose topics are recorded.
        path: the file, replaced if it exists; written to a temporary folder next to it until it is complete.
        clock: returns the time [s]; after a jump back, as on a reset, recorded times continue from the last one.

    Raises:
        UsageError: the suffix of the file is not ``.mcap``.
        ResourceError: it cannot be written.
        MissingDependencyError: rosbags is missing, or too old to write MCAP.

    Attributes:
        count: messages recorded so far.
    """

    def __init__(self, bus: Bus, path: str | Path, clock: Callable[[], float]) -> None:
        self.path = Path(path)
        check_name(self.path)
        if self.path.is_dir():
            raise ResourceError(f"cannot record to {path}: it is a folder")
        self.count = 0
        self._bus, self._clock = bus, clock
        self._offset = self._last = 0.0
        self._subscriptions: list[Subscription] = []
        self._seen: set[str] = set()
        self._files = ExitStack()
        try:
            from rosbags.rosbag2 import StoragePlugin, Writer

            from urdfkit.messages import typestore
        except ImportError as error:
            raise MissingDependencyError("recording needs rosbags, 0.11 or newer: pip install -U rosbags") from error
        self._types = typestore()
        # rosbags writes a folder that contains the file; only the file is kept. The file contains its own name, so a
        # fixed name is used: the bytes do not depend on the name of the recording.
        folder = self._files.enter_context(staging(self.path.absolute().parent)) / STEM
        self._written = folder / f"{STEM}{SUFFIX}"
        try:
            self._writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
            self._writer.open()
            self.subscribe_new_topics()
        except BaseException:
            self._files.close()
            raise

    def subscribe_new_topics(self) -> None:
        """Subscribe to topics advertised since the last call, and record the last message of each."""
        if len(self._bus.topics) == len(self._seen):
            return
        for topic in self._bus.topics:
            if topic.name not in self._seen:
                self._seen.add(topic.name)
                if "/msg/" in topic.type:
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
        writer, self._writer = self._writer, None
        for each in self._subscriptions:
            each.close()
        with self._files:
            try:
                writer.close()
                self._written.replace(self.path)
            except OSError as error:
                raise ResourceError(f"cannot write {self.path}: {error.strerror}") from error

    def __enter__(self) -> Recorder:
        """Return itself."""
        return self

    def __exit__(self, kind: type[BaseException] | None, error: BaseException | None, at: TracebackType | None) -> None:
        """Complete the recording, also after an error."""
        self.close()

    def _listen(self, topic: Topic) -> None:
        connection = self._writer.add_connection(topic.name, topic.type, typestore=self._types)
        record = partial(self._record, connection, topic.type)
        if topic.count and (latest := topic.latest) is not None:
            record(latest)
        self._subscriptions.append(self._bus.subscribe(topic.name, topic.type, record))

    def _record(self, connection: Any, kind: str, message: Any) -> None:
        t = self._clock() + self._offset
        if t < self._last:
            self._offset += self._last - t
            t = self._last
        self._last = t
        data = self._types.serialize_cdr(message, kind)
        with undisturbed():  # a partial message would corrupt the recording
            self._writer.write(connection, round(t * 1e9), data)
        self.count += 1
