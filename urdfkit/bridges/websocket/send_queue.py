"""Queue of the frames for one peer; bounded, so that a peer that does not read costs a fixed amount of memory."""

import asyncio
from collections import deque
from collections.abc import Awaitable, Callable

from urdfkit.bridges.published_message import PublishedMessage

Frame = str | bytes | list[bytes | memoryview]
"""A text, or binary content, which may have several parts so that long contents are not copied."""
Encode = Callable[[PublishedMessage], list[Frame]]

MAX_BYTES = 8 * 1024 * 1024
"""Bytes of messages of one subscription that may wait; the newest message is always kept."""
MAX_MESSAGES = 100
"""Messages of one subscription that may wait."""
MAX_REPLIES = 16 * 1024 * 1024
"""Bytes of replies that may wait; beyond this the peer is disconnected."""


class SubscriptionQueue:
    """Messages of one subscription that wait; a slow peer loses the oldest ones.

    Args:
        encode: returns the frames of a message; called when the message is sent, not before.
        length: messages that may wait.
        period: minimum seconds between two messages.
    """

    def __init__(self, encode: Encode, *, length: int = MAX_MESSAGES, period: float = 0.0) -> None:
        self.encode, self.length, self.period = encode, length, period
        self.due = 0.0
        self._samples: deque[PublishedMessage] = deque()
        self._bytes = 0

    def __len__(self) -> int:
        """Return the number of messages that wait."""
        return len(self._samples)

    def put(self, sample: PublishedMessage) -> None:
        """Append a message; drop the oldest ones if there are too many."""
        self._samples.append(sample)
        self._bytes += sample.size
        while len(self._samples) > 1 and (len(self._samples) > self.length or self._bytes > MAX_BYTES):
            self.take()

    def take(self) -> PublishedMessage:
        """Remove and return the oldest message."""
        sample = self._samples.popleft()
        self._bytes -= sample.size
        return sample


class SendQueue:
    """Frames for one peer: replies in order, before the messages of its subscriptions, which take turns.

    Used in the event loop of the server.
    """

    def __init__(self) -> None:
        self._replies: deque[Frame] = deque()
        self._bytes = 0
        self._subscriptions: deque[SubscriptionQueue] = deque()
        self._ready = asyncio.Event()
        self.full = False

    def reply(self, frame: Frame) -> None:
        """Send a frame in order; one too many ends `run`. A single frame may have any length."""
        self.full = self.full or self._bytes > MAX_REPLIES
        if not self.full:
            self._bytes += len(frame)
            self._replies.append(frame)
        self._ready.set()

    def add(self, subscription: SubscriptionQueue) -> None:
        """Add a subscription."""
        self._subscriptions.append(subscription)

    def remove(self, subscription: SubscriptionQueue) -> None:
        """Remove a subscription with its messages."""
        self._subscriptions.remove(subscription)

    def put(self, subscription: SubscriptionQueue, sample: PublishedMessage) -> None:
        """Send a message of a subscription when it is its turn."""
        subscription.put(sample)
        self._ready.set()

    async def run(self, write: Callable[[Frame], Awaitable[object]]) -> None:
        """Write the frames one at a time, until `write` raises, too many replies wait or the task is cancelled."""
        now = asyncio.get_running_loop().time
        while not self.full:
            if self._replies:
                frame = self._replies.popleft()
                self._bytes -= len(frame)
                await write(frame)
                continue
            subscription, wait = self._next(now())
            if subscription is not None:
                subscription.due = now() + subscription.period
                for frame in subscription.encode(subscription.take()):
                    await write(frame)
                continue
            self._ready.clear()
            try:
                await asyncio.wait_for(self._ready.wait(), wait)
            except (TimeoutError, asyncio.TimeoutError):
                continue

    def _next(self, now: float) -> tuple[SubscriptionQueue | None, float | None]:
        """Return the next subscription with a message that is due, or the seconds until one is due."""
        wait: float | None = None
        for _ in range(len(self._subscriptions)):
            subscription = self._subscriptions[0]
            self._subscriptions.rotate(-1)
            if subscription:
                if subscription.due <= now:
                    return subscription, None
                wait = min(subscription.due - now, wait if wait is not None else subscription.period)
        return None, wait
