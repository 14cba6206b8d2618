import threading

from urdfkit.view.server.request_inbox import MAX_ACTIONS, Inbox, PageInput


def test_of_several_positions_for_a_joint_the_last_counts() -> None:
    inbox = Inbox()
    inbox.put_joints({"a": 1.0, "b": 2.0})
    inbox.put_joints({"a": 3.0})
    inbox.put_action("pause")
    assert inbox.take() == PageInput({"a": 3.0, "b": 2.0}, ("pause",))
    assert not inbox.take()


def test_buttons_nobody_takes_do_not_pile_up() -> None:
    inbox = Inbox()
    for number in range(1000):
        inbox.put_action(str(number))
    assert inbox.take().actions == tuple(str(n) for n in range(1000 - MAX_ACTIONS, 1000))


def test_wait_returns_what_comes_in_and_gives_up_in_time() -> None:
    inbox = Inbox()
    assert not inbox.wait(0.0)
    thread = threading.Thread(target=lambda: inbox.put_joints({"a": 1.0}))
    thread.start()
    assert inbox.wait(10.0) == PageInput({"a": 1.0})
    thread.join()
