"""Hub: sends scene commands, messages and poses to every browser, and keeps the state for browsers that join later."""

import re
from collections.abc import Iterator
from typing import Any

import umsgpack

from urdfkit.view.server.send_queue import Channel, ChannelFullError, Frame

_UUID = re.compile("[0-9a-f]{8}(?:-[0-9a-f]{4}){3}-[0-9a-f]{12}")

CLEAR = umsgpack.packb({"type": "delete", "path": "/robot"})
"""The command that empties the scene."""


class Hub:
    """The current scene and the connected browsers. Used in the event loop of the server."""

    def __init__(self) -> None:
        self._channels: tuple[Channel, ...] = ()  # replaced, never modified: other threads read it
        self._clients: dict[int, Channel] = {}
        self._scene: dict[str, dict[str, bytes]] = {}
        self._latched: dict[str, Frame] = {}
        self._poses: tuple[int, bytes] | None = None

    def join(self, channel: Channel, client: int = 0) -> None:
        """Send a browser the current state, then all changes; `client` is its number."""
        for frame in self.snapshot():
            channel.line(frame)
        if self._poses is not None:
            channel.poses(*self._poses)
        self._channels = (*self._channels, channel)
        self._clients[client] = channel

    def leave(self, channel: Channel) -> None:
        """Remove a browser."""
        self._channels = tuple(each for each in self._channels if each is not channel)
        self._clients = {client: each for client, each in self._clients.items() if each is not channel}

    @property
    def watchers(self) -> int:
        """Number of connected browsers."""
        return len(self._channels)

    @property
    def subscribed_keys(self) -> frozenset[str]:
        """The keys that any browser has subscribed to; may be called from any thread."""
        return frozenset().union(*(channel.subscribed_keys for channel in self._channels))

    def subscribers(self, key: str) -> frozenset[Channel]:
        """The browsers that have subscribed to a key; may be called from any thread."""
        return frozenset(channel for channel in self._channels if key in channel.subscribed_keys)

    def accepts(self, key: str) -> bool:
        """Whether a browser has subscribed to a source and can receive another frame; may be called from any thread."""
        return any(channel.accepts(key) for channel in self._channels)

    def snapshot(self) -> Iterator[Frame]:
        """Yield the current state for a new browser: scene commands, then the latched messages."""
        for slots in self._scene.values():
            yield from slots.values()
        yield from self._latched.values()

    def command(self, path: str, slot: str | None, packed: bytes) -> None:
        """Keep a meshcat command and send it to all browsers.

        Args:
            path: the scene path of the command.
            slot: commands with the same path and slot replace each other; None deletes the path and its children.
            packed: the encoded command.
        """
        if slot is None:
            for node in [node for node in self._scene if node == path or node.startswith(f"{path}/")]:
                del self._scene[node]
        else:
            self._scene.setdefault(path, {})[slot] = packed
        for channel in self._channels:
            self._line(channel, packed)

    def latch(self, topic: str, frame: Frame) -> None:
        """Send a message to all browsers, without loss; browsers that join later get the last one of its topic."""
        self._latched[topic] = frame
        for channel in self._channels:
            self._line(channel, frame)

    def update(self, topic: str, frame: Frame) -> None:
        """Send the state of a topic to all browsers; only the newest one is kept, also for browsers that join later."""
        self._latched[topic] = frame
        for channel in self._channels:
            channel.update(topic, frame)

    def update_subscribers(self, key: str, frame: Frame) -> None:
        """Send the state of a key to its subscribers; only the newest one is kept."""
        for channel in self._channels:
            if key in channel.subscribed_keys:
                channel.update(key, frame)

    def send_chunk(self, key: str, frame: Frame) -> None:
        """Send the next part of a stream to the subscribers of its key; see `Channel.send_chunk`."""
        for channel in self._channels:
            if key in channel.subscribed_keys:
                channel.send_chunk(key, frame)

    def view(self, key: str, sequence: int, frame: bytes) -> None:
        """Send an image or points to the subscribers of their key; only the newest frame is kept."""
        for channel in self._channels:
            if key in channel.subscribed_keys:
                channel.view(key, sequence, frame)

    def send_to(self, client: int, frame: Frame) -> None:
        """Send a frame to one browser, if it is still connected."""
        if (channel := self._clients.get(client)) is not None:
            self._line(channel, frame)

    def poses(self, sequence: int, frame: bytes) -> None:
        """Send a pose frame; only the newest one is kept."""
        self._poses = (sequence, frame)
        for channel in self._channels:
            channel.poses(sequence, frame)

    def restart(self, topic: str, frame: Frame) -> None:
        """Drop the scene, the poses and all latched messages, then latch this message as the first."""
        self._scene, self._latched, self._poses = {}, {}, None
        self.latch(topic, frame)

    def forget_poses(self) -> None:
        """Drop the last pose frame, which belongs to another scene."""
        self._poses = None

    def _line(self, channel: Channel, frame: Frame) -> None:
        try:
            channel.line(frame)
        except ChannelFullError:
            self.leave(channel)
            channel.cut()


def pack(command: Any) -> tuple[str, str | None, bytes]:
    """Return path, slot and bytes of a meshcat command (anything with ``lower()``) for `Hub.command`.

    meshcat identifies objects by version 1 UUIDs, which contain the time and the hardware address of the machine. They
    are replaced by numbers, because an identifier is used only within its command.
    """
    lowered = command.lower()
    kind, path = lowered["type"], lowered["path"].rstrip("/")
    slot = {"delete": None, "set_property": f"set_property:{lowered.get('property')}"}.get(kind, kind)
    if kind == "set_object":
        lowered = _with_numbers(lowered, {})
    return path, slot, umsgpack.packb(lowered)


def _with_numbers(value: Any, numbers: dict[str, str]) -> Any:
    """Return a value with its UUIDs, and the references to them, replaced by numbers in the order of their places."""
    if isinstance(value, dict):
        return {key: _with_numbers(item, numbers) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_with_numbers(item, numbers) for item in value]
    if isinstance(value, str) and _UUID.fullmatch(value):
        return numbers.setdefault(value, str(len(numbers) + 1))
    return value
