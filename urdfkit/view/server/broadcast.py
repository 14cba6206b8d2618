"""Hub: hands scene commands and poses to every browser, and keeps the scene for those who come later."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import umsgpack

from urdfkit.view.server.send_queue import Channel, ChannelFullError, Frame

CLEAR = umsgpack.packb({"type": "delete", "path": "/robot"})
"""The command that empties the scene."""


class Hub:
    """The scene as it stands, and the browsers that watch it. Lives in the server's loop."""

    def __init__(self) -> None:
        self._channels: tuple[Channel, ...] = ()  # replaced, never changed: other threads look at it
        self._clients: dict[int, Channel] = {}
        self._scene: dict[str, dict[str, bytes]] = {}
        self._lasting: dict[str, Frame] = {}
        self._poses: tuple[int, bytes] | None = None

    def join(self, channel: Channel, client: int = 0) -> None:
        """Bring a browser up to date, then keep it so; `client` is its number."""
        for frame in self.snapshot():
            channel.line(frame)
        if self._poses is not None:
            channel.poses(*self._poses)
        self._channels = (*self._channels, channel)
        self._clients[client] = channel

    def leave(self, channel: Channel) -> None:
        """Forget a browser."""
        self._channels = tuple(each for each in self._channels if each is not channel)
        self._clients = {client: each for client, each in self._clients.items() if each is not channel}

    @property
    def watchers(self) -> int:
        """How many browsers watch."""
        return len(self._channels)

    @property
    def wanted(self) -> frozenset[str]:
        """What any browser wants beside what everybody gets; may be asked from any thread."""
        return frozenset().union(*(channel.wanted for channel in self._channels))

    def takes(self, key: str) -> bool:
        """Whether a browser wants a source and can take another frame of it; may be asked from any thread."""
        return any(channel.takes(key) for channel in self._channels)

    def snapshot(self) -> Iterator[Frame]:
        """Yield what a browser needs to see what all others see: scene commands, then the lasting texts."""
        for slots in self._scene.values():
            yield from slots.values()
        yield from self._lasting.values()

    def command(self, path: str, slot: str | None, packed: bytes) -> None:
        """Keep a meshcat command and send it to all.

        Args:
            path: the scene path it is about.
            slot: commands with the same path and slot replace each other; None deletes the path and all below it.
            packed: the command as it travels.
        """
        if slot is None:
            for known in [known for known in self._scene if known == path or known.startswith(f"{path}/")]:
                del self._scene[known]
        else:
            self._scene.setdefault(path, {})[slot] = packed
        for channel in self._channels:
            self._line(channel, packed)

    def lasting(self, topic: str, frame: Frame) -> None:
        """Send a text to all; who comes later gets the last one of its topic."""
        self._lasting[topic] = frame
        for channel in self._channels:
            self._line(channel, frame)

    def news(self, topic: str, frame: Frame) -> None:
        """Send a text that a newer one of its topic may overtake; who comes later gets the last one."""
        self._lasting[topic] = frame
        for channel in self._channels:
            channel.news(topic, frame)

    def news_for(self, key: str, frame: Frame) -> None:
        """Send a text to who wants it; a newer one may overtake it."""
        for channel in self._channels:
            if key in channel.wanted:
                channel.news(key, frame)

    def stream(self, key: str, frame: Frame) -> None:
        """Send a part of something that goes on to who wants it; see `Channel.stream`."""
        for channel in self._channels:
            if key in channel.wanted:
                channel.stream(key, frame)

    def view(self, key: str, sequence: int, frame: bytes) -> None:
        """Send a picture or points to who wants them; newest wins."""
        for channel in self._channels:
            if key in channel.wanted:
                channel.view(key, sequence, frame)

    def tell(self, client: int, frame: Frame) -> None:
        """Send something to one browser, if it is still there."""
        if (channel := self._clients.get(client)) is not None:
            self._line(channel, frame)

    def poses(self, sequence: int, frame: bytes) -> None:
        """Send a pose frame; newest wins."""
        self._poses = (sequence, frame)
        for channel in self._channels:
            channel.poses(sequence, frame)

    def forget_poses(self) -> None:
        """Forget the last pose frame: it belonged to another scene."""
        self._poses = None

    def _line(self, channel: Channel, frame: Frame) -> None:
        try:
            channel.line(frame)
        except ChannelFullError:
            self.leave(channel)
            channel.cut()


def pack(command: Any) -> tuple[str, str | None, bytes]:
    """Return path, slot and bytes of a meshcat command (anything with ``lower()``) for `Hub.command`."""
    lowered = command.lower()
    kind, path = lowered["type"], lowered["path"].rstrip("/")
    slot = {"delete": None, "set_property": f"set_property:{lowered.get('property')}"}.get(kind, kind)
    return path, slot, umsgpack.packb(lowered)
