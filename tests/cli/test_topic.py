"""`urdfkit topic` on a simulation that runs in a thread of this process."""

from __future__ import annotations

import json
import math
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager
from pathlib import Path

import pytest
import yaml

pytest.importorskip("meshcat")
pytest.importorskip("numba")

from tests.processes import running
from tests.served_simulation import driven
from tests.time_limit import PATIENCE
from urdfkit.app.simulation.loop import DriveLoop
from urdfkit.cli import main
from urdfkit.cli.topic.echo import as_yaml, part
from urdfkit.cli.topic.pub import message_of
from urdfkit.cli.topic.rates import Window, report
from urdfkit.cli.topic.service import succeeded
from urdfkit.errors import UsageError
from urdfkit.sim import Simulator
from urdfkit.view.server.running_simulations import registered
from urdfkit.view.server.server import Server

ODOM, COMMAND = "/simpleton/odom", "/simpleton/cmd_vel"


@pytest.fixture(scope="module")
def ride(tmp_path_factory) -> Iterator[DriveLoop]:
    """Simpleton, as `sim teleop` runs it."""
    with driven(Simulator("simpleton", note=lambda _: None), tmp_path_factory.mktemp("runtime")) as ride:
        yield ride


@pytest.fixture
def topic(ride, capsys):
    """Runs ``urdfkit topic …`` and returns what it printed."""

    def run(*words: str, code: int = 0) -> str:
        assert main(["topic", *words]) == code
        printed = capsys.readouterr()
        if code:
            assert printed.out == ""
            assert printed.err.count("\n") == 1
            return printed.err
        assert "dropped" in printed.err or not printed.err  # a busy machine
        return printed.out

    return run


def subscribers(ride: DriveLoop, name: str) -> int:
    return next(len(each.subscribers) for each in ride.simulator.bus.topics if each.name == name)


@pytest.mark.slow
def test_the_topics_are_listed(ride, topic) -> None:
    names = topic("list").splitlines()
    assert names == sorted(names)
    assert {ODOM, COMMAND, "/clock", "/tf"} <= set(names)
    assert f"{ODOM} [nav_msgs/msg/Odometry]" in topic("list", "-t").splitlines()
    command = next(line for line in topic("list", "-v").splitlines() if line.startswith(COMMAND))
    assert command.startswith(f"{COMMAND} [geometry_msgs/msg/Twist] ")
    assert command.endswith(" messages, 1 subscribers")
    rows = json.loads(topic("list", "--json"))
    assert [row["name"] for row in rows] == names
    assert topic("info", ODOM).splitlines()[0] == "Type: nav_msgs/msg/Odometry"
    assert json.loads(topic("info", COMMAND, "--json"))["subscribers"] == 1
    assert topic("type", ODOM) == "nav_msgs/msg/Odometry\n"
    assert topic("find", "nav_msgs/Odometry") == f"{ODOM}\n"
    assert "did you mean `nav_msgs/msg/Odometry`?" in topic("find", "nav_msgs/Odomety", code=1)


@pytest.mark.slow
def test_echo_prints_messages_as_rostopic_does(topic) -> None:
    first, second, end = topic("echo", ODOM, "-n", "2").split("---\n")
    assert end == ""
    one, two = (yaml.safe_load(text) for text in (first, second))
    assert one["header"]["frame_id"] == "odom"
    assert len(one["pose"]["covariance"]) == 36
    assert "  covariance: [" in first
    times = [each["header"]["stamp"]["sec"] + each["header"]["stamp"]["nanosec"] * 1e-9 for each in (one, two)]
    assert times[1] - times[0] == pytest.approx(0.01)  # none in between is ignored
    message = json.loads(topic("echo", "simpleton/odom", "--once", "--json"))
    assert message["child_frame_id"] == "base_footprint"
    assert topic("echo", ODOM, "--once", "--field", "header.frame_id") == "odom\n---\n"
    assert float(topic("echo", ODOM, "--once", "--json", "--field", "pose.covariance[0]")) == 1e-5


@pytest.mark.slow
def test_echo_prints_a_latched_message(topic) -> None:
    (joint, *_) = json.loads(topic("echo", "/tf_static", "--once", "--json"))["transforms"]
    assert joint["header"]["frame_id"] == "base_footprint"


@pytest.mark.slow
def test_a_camera_renders_while_its_topic_has_a_subscriber(ride, topic, until) -> None:
    name = "/simpleton/camera1/image_raw"
    before = subscribers(ride, name)
    cut = json.loads(topic("echo", name, "--once", "--json"))
    assert cut["data"] == f"{cut['height'] * cut['step']} bytes"
    until(lambda: subscribers(ride, name) == before)
    whole = json.loads(topic("echo", name, "--once", "--json", "--full-length"))
    assert len(whole["data"]) == cut["height"] * cut["step"]
    until(lambda: subscribers(ride, name) == before)


@pytest.mark.slow
def test_rates_are_of_simulated_time(topic) -> None:
    found = json.loads(topic("hz", ODOM, "--once", "--json"))
    assert found["rate"] == pytest.approx(100.0)
    assert (found["min"], found["max"]) == pytest.approx((0.01, 0.01))
    assert found["std"] == pytest.approx(0.0, abs=1e-9)
    assert topic("hz", ODOM, "--once", "--window", "5").endswith("std dev: 0.00000s window: 5\n")
    found = json.loads(topic("bw", ODOM, "--once", "--json"))
    assert found["min"] == found["max"] == found["mean"] > 8 * (36 + 7)  # covariance and pose, in doubles


@pytest.mark.slow
def test_what_is_published_moves_the_robot(ride, topic, until) -> None:
    target = f"geometry_msgs/msg/Twist to {COMMAND}"
    printed = topic("pub", COMMAND, "geometry_msgs/Twist", "{linear: {x: 0.5}}", "--rate", "50", "-n", "3")
    assert printed == f"publishing {target} at 50 Hz\npublished 3 messages of type {target}\n"
    until(lambda: ride.simulator.state.v[0] > 0.4)
    assert topic("pub", COMMAND, "--once") == f"published 1 message of type {target}\n"  # all zero
    until(lambda: abs(ride.simulator.state.v[0]) < 0.01)
    topic("pub", COMMAND, "geometry_msgs/msg/Twist", "[-0.5, 0, 0]", "[0, 0, 0]", "--once")
    until(lambda: ride.simulator.state.v[0] < -0.4)
    assert topic("pub", COMMAND, "{linear: {x: 0}}", "--once", "--quiet") == ""
    until(lambda: abs(ride.simulator.state.v[0]) < 0.01)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["echo", "/odm"], f"unknown topic `/odm`; did you mean `{ODOM}`?"),
        (["hz", "/clok"], "unknown topic `/clok`; did you mean `/clock`?"),
        (["pub", "/simpleton/cmd_vl", "--once"], f"unknown topic `/simpleton/cmd_vl`; did you mean `{COMMAND}`?"),
        (["pub", COMMAND, "geometry_msgs/Twst"], "did you mean `geometry_msgs/msg/Twist`?"),
        (["pub", COMMAND, "geometry_msgs/Twist", "{linaer: {x: 1}}"], "no field `linaer` in geometry_msgs/msg/Twist"),
        (["pub", COMMAND, "geometry_msgs/Twist", "{linear: {x: fast}}"], "field `x` of geometry_msgs/msg/Vector3"),
        (["pub", COMMAND, "geometry_msgs/Twist", "{linear: {x: .inf}}"], "contains a value that no message supports"),
        (["pub", COMMAND, "geometry_msgs/Twist", "{linear: [}"], "the message is not YAML"),
        (["pub", COMMAND, "-r", "0"], "`0` is not a rate"),
        (["echo", ODOM, "-n", "0"], "`0` is not a whole number of at least 1"),
        (["echo", ODOM, "--field", "pose.pos"], "no field `pos` in pose; did you mean `pose`?"),
        (["echo", ODOM, "--field", "pose.covariance[36]"], "no entry 36 in pose.covariance: it has 36 entries"),
        (["list", "--url", "http://127.0.0.1:1/?token=x"], "http://127.0.0.1:1: cannot connect: Connection refused"),
        (["lst"], "did you mean `list`?"),
    ],
)
def test_wrong_arguments_of_topic_are_one_line_and_exit_2(topic, words: list[str], expected: str) -> None:
    assert expected in topic(*words, code=2)


@pytest.mark.slow
def test_publishing_to_an_unknown_topic_prints_a_note(ride, capsys) -> None:
    assert main(["topic", "pub", "/simpleton/cmd_vl", "geometry_msgs/Twist", "--once"]) == 0
    assert capsys.readouterr().err == f"urdfkit: /simpleton/cmd_vl has no subscribers; did you mean `{COMMAND}`?\n"
    assert main(["topic", "pub", "/other", "geometry_msgs/Twist", "--once"]) == 0
    assert f"topics of this type with subscribers: {COMMAND}" in capsys.readouterr().err


@pytest.mark.slow
def test_services_are_listed_and_called(ride, capsys) -> None:
    def service(*words: str, code: int = 0) -> str:
        assert main(["service", *words]) == code
        printed = capsys.readouterr()
        return printed.err if code == 2 else printed.out

    names = service("list").splitlines()
    assert names == sorted(ride.services)
    assert {"name": "/step_simulation", "type": "simulation_interfaces/srv/StepSimulation"} in json.loads(
        service("list", "--types", "--json")
    )
    assert service("type", "/gazebo/delete_model") == "gazebo_msgs/srv/DeleteModel\n"
    states = yaml.safe_load(service("call", "/get_entity_state", "simpleton"))
    assert states["state"]["header"]["frame_id"] == "world"
    assert service("call", "/pause_physics", "std_srvs/srv/Empty", "{}") == "{}\n"
    assert ride.simulator.paused
    stepped, t = service("call", "/step_simulation", "{steps: 3}", "--json"), ride.simulator.t
    assert json.loads(stepped) == {"result": {"result": 1, "error_message": ""}}
    assert t == ride.simulator.t
    service("call", "/unpause_physics")
    assert not ride.simulator.paused
    refused = service("call", "/step_simulation", "{steps: 3}", code=1)
    assert yaml.safe_load(refused)["result"] == {"result": 4, "error_message": "the simulation is not paused"}
    refused = service("call", "/gazebo/delete_model", "{model_name: nobody}", code=1)
    assert "no model or robot `nobody`" in yaml.safe_load(refused)["status_message"]
    for words, expected in (
        (["call", "/step_simulatio"], "unknown service `/step_simulatio`; did you mean `/step_simulation`?"),
        (["type", "delete_model"], "did you mean `/gazebo/delete_model`?"),
        (["call", "/step_simulation", "{step: 3}"], "did you mean `steps`?"),
        (["call", "/pause_physics", "std_srvs/Trigger"], "has type std_srvs/srv/Empty, not std_srvs/srv/Trigger"),
        (["cal"], "did you mean `call`?"),
    ):
        line = service(*words, code=2)
        assert expected in line
        assert line.count("\n") == 1


def test_without_a_simulation_the_error_shows_how_to_start_one(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    assert main(["topic", "list"]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("urdfkit: no simulation is running; start one with `urdfkit sim teleop ROBOT`")
    assert printed.err.count("\n") == 1


def test_a_simulation_that_is_starting_is_found_and_reports_its_progress(tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    with Server("sim", port=0) as server, registered(server.port, server.url, "simpleton"):
        server.publish_latched("progress", label="compiling …")
        monkeypatch.setattr("urdfkit.cli.topic.connection.READY", 0.3)
        assert main(["topic", "list"]) == 2
        first, second = capsys.readouterr().err.splitlines()
        assert first == "urdfkit: the simulation is starting: compiling …"
        assert "try again when it has started" in second
        server.publish_latched("progress", label=None)
        server.publish_latched("fault", message="no such wheel")
        assert main(["topic", "list"]) == 2
        assert capsys.readouterr().err == "urdfkit: the simulation reports: no such wheel\n"


def start(*words: str) -> AbstractContextManager[subprocess.Popen[str]]:
    command = [sys.executable, "-m", "urdfkit", "topic", *words]
    return running(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.mark.slow
def test_ctrl_c_ends_it_quietly(ride, until) -> None:
    with start("echo", "/clock", "--json") as echo:
        assert echo.stdout is not None
        assert "clock" in echo.stdout.readline()
        echo.send_signal(signal.SIGINT)
        assert echo.communicate(timeout=PATIENCE)[1] == ""
        assert echo.returncode == 0
    until(lambda: subscribers(ride, "/clock") == 0)


@pytest.mark.slow
def test_a_closed_pipe_ends_it_quietly(ride, until) -> None:
    with start("echo", "/clock") as echo:
        assert echo.stdout is not None
        assert echo.stdout.readline() == "clock:\n"
        echo.stdout.close()
        assert echo.wait(timeout=PATIENCE) == 141
        assert echo.stderr is not None
        assert echo.stderr.read() == ""
    until(lambda: subscribers(ride, "/clock") == 0)


def test_nothing_heavy_is_imported_for_the_help() -> None:
    code = "import sys; from urdfkit.cli import main\ntry: main(['topic', '--help'])\nexcept SystemExit: pass\n"
    code += "heavy = {'numpy', 'pinocchio', 'tornado', 'yaml'} & set(sys.modules); assert not heavy, heavy"
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


# Without a simulation


def test_figures_of_a_window() -> None:
    window = Window(3)
    assert window.periods() is None
    for t, size in ((0.0, 900), (1.0, 10), (1.5, 20), (2.5, 60)):
        window.add(t, size)
    periods, sizes = window.periods(), window.sizes()
    assert periods is not None
    assert sizes is not None
    assert (periods.rate, periods.mean, periods.std, periods.window) == pytest.approx((2 / 1.5, 0.75, 0.25, 3))
    assert (sizes.rate, sizes.mean, sizes.min, sizes.max) == pytest.approx((80 / 1.5, 30.0, 10.0, 60.0))
    assert sizes.std == pytest.approx(math.sqrt((400 + 100 + 900) / 3))
    assert report(periods, is_hz=True).splitlines() == [
        "average rate: 1.333",
        "\tmin: 0.500s max: 1.000s std dev: 0.25000s window: 3",
    ]
    window.add(0.5)  # a reset
    assert window.periods() is None


def test_yaml_of_a_message() -> None:
    message = {"a": {"b": 1e-5, "c": []}, "d": [1, "inf"], "e": [{"f": "x: y"}, {"f": "nan"}], "g": "é"}
    text = as_yaml(message)
    assert text.splitlines() == [
        "a:",
        "  b: 1.0e-05",
        "  c: []",
        "d: [1, .inf]",
        "e:",
        "- f: 'x: y'",
        "- f: .nan",
        "g: é",
    ]
    assert as_yaml(0.5) == "0.5\n"
    assert part(message, "e[1].f") == "nan"
    with pytest.raises(UsageError, match="it is not an array"):
        part(message, "a[0]")
    with pytest.raises(UsageError, match="write a path such as"):
        part(message, "a b")


def test_messages_on_the_command_line() -> None:
    assert message_of([]) is None
    assert message_of(["{data: 1}"]) == {"data": 1}
    assert message_of(["0.5"]) == [0.5]
    assert message_of(["[1, 2]", "[3]"]) == [[1, 2], [3]]
    with pytest.raises(UsageError, match="contains a value that no message supports"):
        message_of(["2024-01-01"])


@pytest.mark.parametrize(
    ("response", "good"),
    [
        ({}, True),
        ({"success": False}, False),
        ({"ok": False}, False),  # of controller_manager
        ({"ok": True}, True),
        ({"result": {"result": 1, "error_message": ""}}, True),
        ({"result": {"result": 2, "error_message": "no"}}, False),
    ],
)
def test_a_response_may_report_a_failure(response: dict, good: bool) -> None:
    assert succeeded(response) == good
