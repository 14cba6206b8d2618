"""Channel: bounded queue of the frames for one browser; a slow browser does not delay others."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable

Frame = str | bytes

MAX_IN_FLIGHT = 3
"""Pose frames sent but not yet acknowledged."""
MAX_WAITING = 64 * 1024 * 1024
"""Bytes of scene commands that may wait for one browser; beyond this it is disconnected and has to reconnect."""


MAX_UNSEEN = 2
"""Frames of one source sent but not yet shown."""
MAX_STREAM = 120
"""Frames of one stream that may wait; beyond this the oldest are dropped."""
MAX_STREAM_BYTES = 16 * 1024 * 1024
"""Bytes of one stream that may wait; the newest frame is always kept."""


class ChannelFullError(Exception):
    """A browser does not read the frames that must not be dropped."""


class Channel:
    """Outgoing frames of one browser, in five classes with different rules for dropping.

    - Lines, such as scene commands, are never dropped.
    - Streams, such as plots, keep the newest `MAX_STREAM` frames and `MAX_STREAM_BYTES` of each key.
    - Updates, such as the status, keep the newest frame of each topic.
    - Of poses the newest frame is kept; at most `MAX_IN_FLIGHT` frames are unacknowledged.
    - Of images and points the newest frame of each source is kept; at most `MAX_UNSEEN` are not yet shown.

    Used in the event loop of the server.

    Attributes:
        subscribed_keys: the keys that this browser has subscribed to.
    """

    def __init__(self) -> None:
        self._lines: deque[Frame] = deque()
        self._waiting = 0
        self._updates: dict[str, Frame] = {}
        self._poses: tuple[int, bytes] | None = None
        self._in_flight: deque[int] = deque()
        self._streams: dict[str, deque[Frame]] = {}
        self._views: dict[str, tuple[int, bytes]] = {}
        self._unseen: dict[str, deque[int]] = {}
        self.subscribed_keys: frozenset[str] = frozenset()
        self._ready = asyncio.Event()
        self._cut = False

    def line(self, frame: Frame) -> None:
        """Send a frame in order; it is never dropped.

        Raises:
            ChannelFullError: too many bytes are waiting.
        """
        self._waiting += len(frame)
        if self._waiting > MAX_WAITING and self._lines:
            raise ChannelFullError(f"{self._waiting} bytes are queued for the browser")
        self._lines.append(frame)
        self._ready.set()

    def update(self, topic: str, frame: Frame) -> None:
        """Send a frame unless a newer one of its topic replaces it."""
        self._updates[topic] = frame
        self._ready.set()

    def poses(self, sequence: int, frame: bytes) -> None:
        """Send a pose frame unless a newer one replaces it."""
        self._poses = (sequence, frame)
        self._ready.set()

    def acknowledge(self, sequence: int) -> None:
        """Record that the browser has applied a pose frame and all older ones; unknown numbers are ignored."""
        if sequence in self._in_flight:
            while self._in_flight.popleft() != sequence:
                pass
            self._ready.set()

    def send_chunk(self, key: str, frame: Frame) -> None:
        """Send the next frame of a stream, in order; a slow browser loses the oldest ones."""
        stream = self._streams.setdefault(key, deque(maxlen=MAX_STREAM))
        stream.append(frame)
        while len(stream) > 1 and sum(map(len, stream)) > MAX_STREAM_BYTES:
            stream.popleft()
        self._ready.set()

    def view(self, key: str, sequence: int, frame: bytes) -> None:
        """Send an image or points unless a newer frame of the source replaces them."""
        self._views[key] = (sequence, frame)
        self._ready.set()

    def accepts(self, key: str) -> bool:
        """Whether this browser has subscribed to a source and has shown the frames it was sent."""
        return key in self.subscribed_keys and len(self._unseen.get(key, ())) < MAX_UNSEEN and key not in self._views

    def seen(self, key: str, sequence: int) -> None:
        """Record that the browser has shown a frame of a source and all older ones; unknown numbers are ignored."""
        unseen = self._unseen.get(key)
        if unseen and sequence in unseen:
            while unseen.popleft() != sequence:
                pass
            self._ready.set()

    def subscribe(self, keys: frozenset[str]) -> None:
        """Replace the subscriptions of the browser; waiting frames of other keys are dropped."""
        self.subscribed_keys = keys
        for waiting in (self._streams, self._views, self._unseen):
            for key in [key for key in waiting if key not in keys]:
                del waiting[key]

    def cut(self) -> None:
        """End `run`; waiting frames are dropped."""
        self._cut = True
        self._ready.set()

    @property
    def in_flight(self) -> int:
        """Number of pose frames sent and not yet acknowledged."""
        return len(self._in_flight)

    async def run(self, write: Callable[[Frame], Awaitable[None]]) -> None:
        """Write the frames one at a time until `write` raises, `cut` is called or the task is cancelled."""
        while not self._cut:
            frame = self._next()
            if frame is None:
                self._ready.clear()
                await self._ready.wait()
            else:
                await write(frame)

    def _next(self) -> Frame | None:
        if self._lines:
            frame = self._lines.popleft()
            self._waiting -= len(frame)
            return frame
        if self._updates:
            return self._updates.pop(next(iter(self._updates)))
        for key, stream in self._streams.items():
            chunk = stream.popleft()
            if not stream:
                del self._streams[key]
            return chunk
        if self._poses is not None and len(self._in_flight) < MAX_IN_FLIGHT:
            sequence, packed = self._poses
            self._poses = None
            self._in_flight.append(sequence)
            return packed
        for key, (number, seen) in self._views.items():
            unseen = self._unseen.setdefault(key, deque())
            if len(unseen) < MAX_UNSEEN:
                del self._views[key]
                unseen.append(number)
                return seen
        return None
