import pytest

from urdfkit.view.protocol.websocket_messages import Axes
from urdfkit.view.server.drive_lock import DEADMAN, DriveLock

AHEAD = Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0)
BACK = Axes((-1.0, 0.0, 0.0, 0.0), 0.5, 1.0)
NOTHING = Axes((0.0, 0.0, 0.0, 0.0), 0.5, 1.0)


class Clock:
    now = 100.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def lock(clock: Clock) -> DriveLock:
    return DriveLock(clock=clock)


def test_what_is_held_counts_until_it_is_let_go(lock: DriveLock) -> None:
    assert lock.axes is None
    assert lock.update(1, AHEAD)
    assert lock.axes == AHEAD
    lock.update(1, NOTHING)
    assert lock.axes is None
    assert lock.holder is None


def test_silence_stops_the_robot(lock: DriveLock, clock: Clock) -> None:
    lock.update(1, AHEAD)
    clock.now += DEADMAN - 0.01
    assert lock.axes == AHEAD
    clock.now += 0.02
    assert lock.axes is None
    assert lock.holder is None


def test_a_word_in_time_keeps_it_going(lock: DriveLock, clock: Clock) -> None:
    for _ in range(20):
        lock.update(1, AHEAD)
        clock.now += DEADMAN * 0.9
        assert lock.axes == AHEAD


def test_stop_takes_the_wheel_out_of_any_hands(lock: DriveLock) -> None:
    lock.update(1, AHEAD)
    lock.release()
    assert lock.axes is None
    assert lock.holder is None
    assert lock.update(2, BACK)


def test_closing_the_page_stops_the_robot_at_once(lock: DriveLock) -> None:
    lock.update(1, AHEAD)
    lock.leave(2)
    assert lock.axes == AHEAD
    lock.leave(1)
    assert lock.axes is None


def test_one_drives_and_the_others_watch(lock: DriveLock, clock: Clock) -> None:
    lock.update(1, AHEAD)
    assert not lock.update(2, BACK)
    assert not lock.update(2, NOTHING)
    assert lock.axes == AHEAD
    assert lock.holder == 1
    lock.update(1, NOTHING)
    assert lock.update(2, BACK)
    assert lock.axes == BACK
    clock.now += DEADMAN + 0.01
    assert lock.update(1, AHEAD)


def test_while_one_page_drives_another_may_not_change_anything() -> None:
    now = [0.0]
    lock = DriveLock(clock=lambda: now[0])
    assert lock.allows(1)
    assert lock.allows(2)
    lock.update(1, AHEAD)
    assert lock.allows(1)
    assert not lock.allows(2)
    now[0] += DEADMAN + 0.01
    assert lock.allows(2)


def test_who_moves_an_arm_drives_for_a_while() -> None:
    now = [0.0]
    lock = DriveLock(clock=lambda: now[0])
    lock.claim(1)
    assert (lock.holder, lock.axes) == (1, None)
    lock.claim(2)
    assert lock.holder == 1
    assert not lock.update(2, AHEAD)
    now[0] += DEADMAN + 0.01
    assert lock.update(2, AHEAD)
    lock.claim(2)  # does not take the wheel out of its hands
    assert lock.axes == AHEAD
