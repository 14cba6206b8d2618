import pytest

from urdfkit.view.protocol.websocket_messages import Axes
from urdfkit.view.server.drive_lock import DEADMAN, Driver

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
def driver(clock: Clock) -> Driver:
    return Driver(clock=clock)


def test_what_is_held_counts_until_it_is_let_go(driver: Driver) -> None:
    assert driver.axes is None
    assert driver.offer(1, AHEAD)
    assert driver.axes == AHEAD
    driver.offer(1, NOTHING)
    assert driver.axes is None
    assert driver.holder is None


def test_silence_stops_the_robot(driver: Driver, clock: Clock) -> None:
    driver.offer(1, AHEAD)
    clock.now += DEADMAN - 0.01
    assert driver.axes == AHEAD
    clock.now += 0.02
    assert driver.axes is None
    assert driver.holder is None


def test_a_word_in_time_keeps_it_going(driver: Driver, clock: Clock) -> None:
    for _ in range(20):
        driver.offer(1, AHEAD)
        clock.now += DEADMAN * 0.9
        assert driver.axes == AHEAD


def test_stop_takes_the_wheel_out_of_any_hands(driver: Driver) -> None:
    driver.offer(1, AHEAD)
    driver.stop()
    assert driver.axes is None
    assert driver.holder is None
    assert driver.offer(2, BACK)


def test_closing_the_page_stops_the_robot_at_once(driver: Driver) -> None:
    driver.offer(1, AHEAD)
    driver.leave(2)
    assert driver.axes == AHEAD
    driver.leave(1)
    assert driver.axes is None


def test_one_drives_and_the_others_watch(driver: Driver, clock: Clock) -> None:
    driver.offer(1, AHEAD)
    assert not driver.offer(2, BACK)
    assert not driver.offer(2, NOTHING)
    assert driver.axes == AHEAD
    assert driver.holder == 1
    driver.offer(1, NOTHING)
    assert driver.offer(2, BACK)
    assert driver.axes == BACK
    clock.now += DEADMAN + 0.01
    assert driver.offer(1, AHEAD)


def test_while_one_page_drives_another_may_not_change_anything() -> None:
    now = [0.0]
    driver = Driver(clock=lambda: now[0])
    assert driver.may(1)
    assert driver.may(2)
    driver.offer(1, AHEAD)
    assert driver.may(1)
    assert not driver.may(2)
    now[0] += DEADMAN + 0.01
    assert driver.may(2)


def test_who_moves_an_arm_drives_for_a_while() -> None:
    now = [0.0]
    driver = Driver(clock=lambda: now[0])
    driver.touch(1)
    assert (driver.holder, driver.axes) == (1, None)
    driver.touch(2)
    assert driver.holder == 1
    assert not driver.offer(2, AHEAD)
    now[0] += DEADMAN + 0.01
    assert driver.offer(2, AHEAD)
    driver.touch(2)  # does not take the wheel out of its hands
    assert driver.axes == AHEAD
