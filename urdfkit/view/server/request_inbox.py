"""Inbox: what the browsers ask for, waiting until the caller's own thread takes it. Bounded, newest wins."""

from __future__ import annotations

from dataclasses import dataclass, field
from threading import Condition
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from urdfkit.view.protocol.page_requests import Order

MAX_ACTIONS = 16
MAX_ORDERS = 256
"""Orders that may wait; who orders more is told so."""


@dataclass(frozen=True, slots=True)
class Wishes:
    """What came in since the last look.

    Attributes:
        joints: joint → position last asked for [rad or m].
        actions: buttons pressed, oldest first.
        orders: what is to be done, oldest first.
    """

    joints: dict[str, float] = field(default_factory=dict)
    actions: tuple[str, ...] = ()
    orders: tuple[Order, ...] = ()

    def __bool__(self) -> bool:
        return bool(self.joints or self.actions or self.orders)


class Inbox:
    """Filled by the server's thread, emptied by the caller's."""

    def __init__(self) -> None:
        self._changed = Condition()
        self._joints: dict[str, float] = {}
        self._actions: list[str] = []
        self._orders: list[Order] = []

    def put_joints(self, positions: dict[str, float]) -> None:
        """Remember joint positions; of several for one joint the last."""
        with self._changed:
            self._joints.update(positions)
            self._changed.notify()

    def put_action(self, action: str) -> None:
        """Remember a button; beyond `MAX_ACTIONS` untaken ones the oldest is forgotten."""
        with self._changed:
            self._actions.append(action)
            del self._actions[:-MAX_ACTIONS]
            self._changed.notify()

    def put_order(self, order: Order) -> bool:
        """Remember an order; False where too many wait already."""
        with self._changed:
            if len(self._orders) >= MAX_ORDERS:
                return False
            self._orders.append(order)
            self._changed.notify()
            return True

    def take(self) -> Wishes:
        """Return what came in and forget it; never waits."""
        with self._changed:
            wishes = Wishes(self._joints, tuple(self._actions), tuple(self._orders))
            self._joints, self._actions, self._orders = {}, [], []
        return wishes

    def wait(self, timeout: float) -> Wishes:
        """Return what came in; when there is nothing, wait up to `timeout` [s] for it."""
        with self._changed:
            self._changed.wait_for(lambda: self._joints or self._actions or self._orders, timeout)
        return self.take()
