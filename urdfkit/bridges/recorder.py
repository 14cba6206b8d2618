"""Recorder: everything that is published, written to one MCAP file that ``ros2 bag`` and its relatives read.

The same simulation gives the same bytes: times are simulated, and nothing of the machine is in the file.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from urdfkit.atomic import staging, undisturbed
from urdfkit.errors import MissingDependencyError, ResourceError, UsageError

if TYPE_CHECKING:
    from types import TracebackType

    from urdfkit.bus import Bus, Subscription, Topic

SUFFIX = ".mcap"
STEM = "recording"
"""What a recording is called until it is moved into place."""


def check_name(path: Path) -> None:
    """Refuse a file that is called anything else than a recording.

    Args:
        path: the file.

    Raises:
        UsageError: it is not called ``.mcap``.
    """
    if path.suffix != SUFFIX:
        raise UsageError(f"cannot record to {path}: recordings are MCAP; call it {path.stem}{SUFFIX}")


class Recorder:
    """Listens to every topic that carries messages, from `look` on, until `close`.

    Requests of services, which travel on topics here, are left out: a recording holds messages.

    Args:
        bus: whose topics.
        path: the file, replaced when it is there already; written beside it until it is complete.
        clock: returns the time [s]; where it goes back, as after a reset, the recording goes on from where it was.

    Raises:
        UsageError: the file is not called ``.mcap``.
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
        self._known: set[str] = set()
        self._files = ExitStack()
        try:
            from rosbags.rosbag2 import StoragePlugin, Writer

            from urdfkit.messages import typestore
        except ImportError as error:
            raise MissingDependencyError("recording needs rosbags, 0.11 or newer: pip install -U rosbags") from error
        self._types = typestore()
        # rosbags writes a folder with the file in it; only the file is kept. Its name is written into it, too: always
        # the same one, so that what a recording is called changes nothing in it.
        folder = self._files.enter_context(staging(self.path.absolute().parent)) / STEM
        self._written = folder / f"{STEM}{SUFFIX}"
        try:
            self._writer = Writer(folder, version=9, storage_plugin=StoragePlugin.MCAP)
            self._writer.open()
            self.look()
        except BaseException:
            self._files.close()
            raise

    def look(self) -> None:
        """Listen to topics that have come up since the last look; what they published last is recorded now."""
        if len(self._bus.topics) == len(self._known):
            return
        for topic in self._bus.topics:
            if topic.name not in self._known:
                self._known.add(topic.name)
                if "/msg/" in topic.type:
                    self._listen(topic)

    @property
    def topics(self) -> int:
        """How many topics are listened to."""
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
        """Keep what was recorded, whatever ended it."""
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
        with undisturbed():  # half a message would spoil the whole recording
            self._writer.write(connection, round(t * 1e9), data)
        self.count += 1
