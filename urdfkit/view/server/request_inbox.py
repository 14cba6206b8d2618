"""Inbox: bounded queue of the browsers' input for the caller's thread."""

from dataclasses import dataclass, field
from threading import Condition

from urdfkit.view.protocol.page_requests import Request

MAX_ACTIONS = 16
MAX_REQUESTS = 256
"""Maximum number of waiting requests; further ones are rejected with an error."""


@dataclass(frozen=True, slots=True)
class PageInput:
    """The input of all pages since the last call.

    Attributes:
        joints: joint → last requested position [rad or m].
        actions: pressed buttons, oldest first.
        requests: requests, oldest first.
    """

    joints: dict[str, float] = field(default_factory=dict)
    actions: tuple[str, ...] = ()
    requests: tuple[Request, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.joints or self.actions or self.requests)


class Inbox:
    """Filled by the thread of the server, emptied by the thread of the caller."""

    def __init__(self) -> None:
        self._changed = Condition()
        self._joints: dict[str, float] = {}
        self._actions: list[str] = []
        self._requests: list[Request] = []

    def put_joints(self, positions: dict[str, float]) -> None:
        """Store joint positions; the last position of each joint counts."""
        with self._changed:
            self._joints.update(positions)
            self._changed.notify()

    def put_action(self, action: str) -> None:
        """Store a pressed button; beyond `MAX_ACTIONS` waiting ones the oldest is dropped."""
        with self._changed:
            self._actions.append(action)
            del self._actions[:-MAX_ACTIONS]
            self._changed.notify()

    def put_request(self, request: Request) -> bool:
        """Remember an request; False where too many wait already."""
        with self._changed:
            if len(self._requests) >= MAX_REQUESTS:
                return False
            self._requests.append(request)
            self._changed.notify()
            return True

    def take(self) -> PageInput:
        """Return and remove all waiting input; never blocks."""
        with self._changed:
            inputs = PageInput(self._joints, tuple(self._actions), tuple(self._requests))
            self._joints, self._actions, self._requests = {}, [], []
        return inputs

    def wait(self, timeout: float) -> PageInput:
        """Return and remove all waiting input; wait up to `timeout` [s] for the first."""
        with self._changed:
            self._changed.wait_for(lambda: self._joints or self._actions or self._requests, timeout)
        return self.take()
