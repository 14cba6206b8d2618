"""Recordings: read back by rosbags, message for message; the same bytes from the same simulation."""

from __future__ import annotations

import io
import signal
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

pytest.importorskip("rosbags.rosbag2")

from tests.processes import signals
from urdfkit.bridges.jpeg_image import IMAGE
from urdfkit.bridges.recorder import Recorder
from urdfkit.bridges.recording_options import RecordingOptions, parse_split
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
    with pytest.raises(UsageError, match=r"recordings are MCAP files; name the file a\.mcap"):
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
    assert count["/robot_description"] == 1
    assert count["/odom"] == 100
    times = [t for _, t, _ in found]
    assert times == sorted(times)
    assert times[-1] == 10**9
    clock = [(t, message.clock) for topic, t, message in found if topic == "/clock"]
    assert all(t == stamp.sec * 10**9 + stamp.nanosec for t, stamp in clock)


def test_a_recording_is_refused_with_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "run", "simpleton", "--for", "0.1", "--record", str(tmp_path / "a.db3")]) == 2
    assert capsys.readouterr().err.endswith("recordings are MCAP files; name the file a.mcap\n")


def image(encoding: str = "rgb8") -> Any:
    pixels = np.arange(6 * 4 * 3, dtype=np.uint8)
    fields = {"height": 4, "width": 6, "encoding": encoding, "step": 18, "data": pixels.tolist()}
    return from_fields(IMAGE, fields)


def test_patterns_select_topics(tmp_path: Path) -> None:
    bus, options = Bus(), RecordingOptions(topics=("/a/*", "/odom", "/oddm"), exclude=("*/secret",))
    with Recorder(bus, tmp_path / "a.mcap", lambda: 0.0, options) as recorder:
        for name in ("/a/x", "/a/secret", "/odom", "/b"):
            bus.publish(name, FLOAT, number(1.0))
        recorder.subscribe_new_topics()
    assert [name for name, _, _ in read(tmp_path / "a.mcap")] == ["/a/x", "/odom"]
    names = ["/robot/odom", "/b"]
    assert options.unused(names) == [
        "no topic matches `/a/*`",
        "no topic matches `/odom`; did you mean `/robot/odom`?",
        "no topic matches `/oddm`; did you mean `*/odom`?",
        "no topic matches `*/secret`",
    ]  # fmt: skip


def test_topics_have_the_quality_with_which_they_are_published(tmp_path: Path) -> None:
    """``ros2 bag play`` publishes with it; without it, nodes that start later would miss fixed transforms."""
    from rosbags.rosbag2 import Reader

    bus = Bus()
    for name, type in (
        ("/tf_static", "tf2_msgs/msg/TFMessage"),
        ("/clock", "rosgraph_msgs/msg/Clock"),
        ("/odom", FLOAT),
    ):
        bus.publish(name, type, from_fields(type, None))
    Recorder(bus, tmp_path / "a.mcap", lambda: 0.0).close()
    with Reader(tmp_path / "a.mcap") as reader:
        found = {each.topic: each.ext.offered_qos_profiles for each in reader.connections}
    assert {name: (qos.reliability.name, qos.durability.name, qos.depth) for name, (qos,) in found.items()} == {
        "/tf_static": ("RELIABLE", "TRANSIENT_LOCAL", 1),
        "/clock": ("BEST_EFFORT", "VOLATILE", 1),
        "/odom": ("RELIABLE", "VOLATILE", 10),
    }


@pytest.mark.parametrize("compression", [True, False])
def test_compression_is_lossless_and_makes_images_small(tmp_path: Path, compression: bool) -> None:
    bus, path = Bus(), tmp_path / "a.mcap"
    with Recorder(bus, path, lambda: 0.0, RecordingOptions(compression=compression)) as recorder:
        bus.publish("/image", IMAGE, (sent := image()))
        recorder.subscribe_new_topics()
        for _ in range(200):
            bus.publish("/image", IMAGE, sent)
    found = read(path)
    assert len(found) == 201
    assert all(message.data.tolist() == sent.data.tolist() for _, _, message in found)
    assert (path.stat().st_size < 201 * 72) == compression


def test_images_are_recorded_as_jpeg_and_depths_as_they_are(tmp_path: Path) -> None:
    bus, path = Bus(), tmp_path / "a.mcap"
    bus.publish("/image", IMAGE, image("bgr8"))
    depth = {"height": 1, "width": 2, "encoding": "32FC1", "step": 8, "data": [0] * 8}
    bus.publish("/depth", IMAGE, from_fields(IMAGE, depth))
    Recorder(bus, path, lambda: 0.0, RecordingOptions(jpeg=95)).close()
    (name, _, message), (other, _, same) = read(path)
    assert (name, other, same.encoding) == ("/image/compressed", "/depth", "32FC1")
    assert message.format == "bgr8; jpeg compressed bgr8"
    pixels = np.asarray(Image.open(io.BytesIO(message.data.tobytes())), dtype=int)
    assert pixels.shape == (4, 6, 3)
    np.testing.assert_allclose(pixels, np.arange(72).reshape(4, 6, 3)[:, :, ::-1], atol=12)  # chroma is halved in JPEG


@pytest.mark.parametrize("limit", ["2s", "0.000036MB"])
def test_a_recording_continues_in_other_files(tmp_path: Path, limit: str) -> None:
    bus, t = Bus(), 0.0
    bus.publish("/robot/robot_description", FLOAT, number(-1.0))
    options = RecordingOptions(**parse_split(limit))  # type: ignore[arg-type]
    with Recorder(bus, tmp_path / "a.mcap", lambda: t, options) as recorder:
        for t in (0.0, 1.0, 2.0, 3.0):
            bus.publish("/x", FLOAT, number(t))
            recorder.subscribe_new_topics()
    assert [path.name for path in recorder.files] == ["a_0.mcap", "a_1.mcap"]
    assert sorted(tmp_path.iterdir()) == recorder.files
    first, second = ([(t / 1e9, message.data) for _, t, message in read(path)] for path in recorder.files)
    assert second[0] == (2.0, -1.0)
    assert [value for _, value in [*first, *second] if value >= 0] == [0.0, 1.0, 2.0, 3.0]


@pytest.mark.parametrize("text", ["0s", "5", "5TB", "-3s"])
def test_a_limit_of_another_form_is_refused(text: str) -> None:
    with pytest.raises(UsageError, match="such as 30s, 5min, 500MB"):
        parse_split(text)
