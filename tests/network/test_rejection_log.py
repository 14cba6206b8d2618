from urdfkit.network.rejection_log import AGAIN, MINUTE, MOST, RejectionLog


def test_the_same_refusal_is_reported_once_in_a_while(caplog) -> None:
    now = [0.0]
    rejections = RejectionLog(lambda: now[0])
    for _ in range(5):
        rejections.add("127.0.0.1", "GET /ws", "no key")
        now[0] += 4.0
    assert caplog.messages == ["rejected GET /ws from 127.0.0.1: no key"]
    now[0] += AGAIN
    rejections.add("127.0.0.1", "GET /ws", "no key")
    assert len(caplog.messages) == 2


def test_many_different_ones_do_not_fill_the_log(caplog) -> None:
    now = [0.0]
    rejections = RejectionLog(lambda: now[0])
    for k in range(10_000):
        rejections.add("127.0.0.1", f"GET /{k}", "no key")
    assert len(caplog.messages) == MOST + 1
    assert "not logged" in caplog.messages[-1]
    now[0] += MINUTE
    rejections.add("127.0.0.1", "GET /more", "no key")
    assert caplog.messages[-1].startswith("rejected GET /more")


def test_what_a_terminal_would_act_on_is_spelled_out(caplog) -> None:
    RejectionLog().add("::1", "GET /\x1b[2J\nurdfkit: all is well", "no key")
    (line,) = caplog.messages
    assert "\n" not in line
    assert "\x1b" not in line
