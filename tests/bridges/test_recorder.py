"""Recordings: read back by rosbags, message for message; the same bytes from the same simulation."""

from __future__ import annotations

import signal
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("rosbags.rosbag2")

from tests.processes import signals
from urdfkit.bridges.recorder import Recorder
from urdfkit.bus import Bus
from urdfkit.cli import main
from urdfkit.errors import ResourceError, UsageError
from urdfkit.messages import FLOAT, TWIST, from_fields, twist, typestore

Message = tuple[str, int, Any]


def read(path: Path) -> list[Message]:
    """Return topic, time [ns] and message of everything in a recording."""
    from rosbags.rosbag2 import Reader

    with Reader(path) as reader:
        return [
            (connection.topic, t, typestore().deserialize_cdr(data, connection.msgtype))
            for connection, t, data in reader.messages()
        ]


def number(value: float) -> Any:
    return from_fields(FLOAT, {"data": value})


def test_what_is_published_is_read_back(tmp_path: Path) -> None:
    bus, t, path = Bus(), 0.0, tmp_path / "a.mcap"
    bus.publish("/before", FLOAT, number(0.5))
    bus.advertise("/request", "gazebo_msgs/srv/DeleteModel_Request")
    with Recorder(bus, path, lambda: t) as recorder:
        t = 0.25
        bus.publish("/before", FLOAT, number(1.5))
        bus.publish("/late", TWIST, twist((1, 2, 3), (4, 5, 6)))
        recorder.subscribe_new_topics()
        t = 0.5
        bus.advertise("/late", TWIST).offer(lambda: twist((7, 0, 0), (0, 0, 0)))
        assert not path.exists()
        assert (recorder.count, recorder.topics) == (4, 2)
    found = read(path)
    assert [(topic, t) for topic, t, _ in found] == [
        ("/before", 0), ("/before", 250_000_000), ("/late", 250_000_000), ("/late", 500_000_000)
    ]  # fmt: skip
    assert [message.data for _, _, message in found[:2]] == [0.5, 1.5]
    assert [message.linear.x for _, _, message in found[2:]] == [1.0, 7.0]
    assert list(tmp_path.iterdir()) == [path]
    bus.publish("/before", FLOAT, number(2.5))
    recorder.close()
    assert len(read(path)) == 4


def test_time_goes_on_after_a_reset(tmp_path: Path) -> None:
    bus, times = Bus(), iter([1.0, 2.0, 0.0, 0.5])
    bus.advertise("/x", FLOAT)
    with Recorder(bus, tmp_path / "a.mcap", lambda: next(times)):
        for value in range(4):
            bus.publish("/x", FLOAT, number(value))
    assert [round(t * 1e-9, 3) for _, t, _ in read(tmp_path / "a.mcap")] == [1.0, 2.0, 2.0, 2.5]


def test_what_cannot_be_recorded_to(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=r"recordings are MCAP; call it a\.mcap"):
        Recorder(Bus(), tmp_path / "a.bag", lambda: 0.0)
    with pytest.raises(ResourceError, match=r"cannot write into .*nowhere"):
        Recorder(Bus(), tmp_path / "nowhere" / "a.mcap", lambda: 0.0)
    (tmp_path / "b.mcap").mkdir()
    with pytest.raises(ResourceError, match="it is a folder"):
        Recorder(Bus(), tmp_path / "b.mcap", lambda: 0.0)


def test_an_error_keeps_what_was_recorded(tmp_path: Path) -> None:
    bus = Bus()
    bus.advertise("/x", FLOAT)

    def fail() -> None:
        with Recorder(bus, tmp_path / "a.mcap", lambda: 0.0):
            bus.publish("/x", FLOAT, number(1.0))
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        fail()
    assert len(read(tmp_path / "a.mcap")) == 1


def test_ctrl_c_waits_until_a_message_is_written(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    bus = Bus()
    bus.advertise("/x", FLOAT)
    recorder = Recorder(bus, tmp_path / "a.mcap", lambda: 0.0)
    write = recorder._writer.write

    def interrupted(*words: Any) -> None:
        signal.raise_signal(signal.SIGINT)
        write(*words)

    monkeypatch.setattr(recorder._writer, "write", interrupted)
    with signals():
        with pytest.raises(KeyboardInterrupt):
            bus.publish("/x", FLOAT, number(1.0))
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    recorder.close()
    assert [message.data for _, _, message in read(tmp_path / "a.mcap")] == [1.0]


@pytest.mark.slow
def test_a_run_is_recorded_and_the_same_run_gives_the_same_bytes(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    contents = []
    monkeypatch.chdir(tmp_path)
    for name in ("by_another_name.mcap", "run.mcap"):  # which changes nothing in it
        words = ["sim", "run", "diff_wheeled_robot", "--for", "1", "--cmd-vel", "0.2,0,0.5", "--record", name]
        assert main(words) == 0
        reported = capsys.readouterr().err
        contents.append((tmp_path / name).read_bytes())
    assert contents[0] == contents[1]
    found = read(tmp_path / "run.mcap")
    assert f"recorded {len(found)} messages of " in reported
    assert reported.rstrip().endswith(" topics to run.mcap")
    count = {topic: sum(name == topic for name, _, _ in found) for topic, _, _ in found}
    assert count["/clock"] == 100
    assert count["/tf_static"] == 1
    assert count["/odom"] == 100
    times = [t for _, t, _ in found]
    assert times == sorted(times)
    assert times[-1] == 10**9
    clock = [(t, message.clock) for topic, t, message in found if topic == "/clock"]
    assert all(t == stamp.sec * 10**9 + stamp.nanosec for t, stamp in clock)


def test_a_recording_is_refused_with_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "run", "simpleton", "--for", "0.1", "--record", str(tmp_path / "a.db3")]) == 2
    assert capsys.readouterr().err.endswith("recordings are MCAP; call it a.mcap\n")
