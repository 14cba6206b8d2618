"""`--ros2` seen by nodes of real rclpy, Kilted and Jazzy, in environments of their own: ``make ros2-nodes``."""

from __future__ import annotations

import json
import os
import site
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("cyclonedds")

from tests.processes import running
from tests.time_limit import PATIENCE
from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode
from urdfkit.errors import ResourceError
from urdfkit.sim import Simulator

ROOT = Path(__file__).parents[3]
DISTRIBUTIONS = ("kilted", "jazzy")
LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}


def node_python(distribution: str) -> Path:
    """Return the Python of the environment with rclpy; skip the test without one."""
    found = ROOT / ".venv" / f"ros2-{distribution}" / "bin" / "python"
    if not found.exists():
        pytest.skip(f"needs rclpy of {distribution}: make ros2-nodes")
    return found


@contextmanager
def simulated(
    robot: str,
    domain: int,
    python: Sequence[str | Path] = (sys.executable, "-m", "urdfkit"),
    library: str = "cyclonedds",
) -> Iterator[subprocess.Popen[str]]:
    """Run ``urdfkit sim run ROBOT --ros2`` until the end of the block.

    Args:
        robot: its name.
        domain: of ROS 2.
        python: command that runs urdfkit.
        library: that publishes the topics.
    """
    command = [*python, "sim", "run", robot, "--for", "600", "--ros2", "--ros-domain", str(domain)]
    environment = {**os.environ, **LOCAL}
    process = subprocess.Popen(command, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True, env=environment)
    assert process.stderr is not None
    try:
        for line in process.stderr:
            if line.startswith(f"ros2: topics are published by {library}"):
                break
        else:
            pytest.fail("the simulation has not started")
        yield process
    finally:
        process.kill()
        process.wait()
        process.stderr.close()


def node(
    distribution: str, domain: int, seconds: float, command: str = "", odometry: str = "", awaited: str = ""
) -> dict[str, Any]:
    """Run a real node and return what it has seen."""
    words = [str(Path(__file__).parent / "real_node.py"), str(seconds), command, odometry, awaited]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {**LOCAL, "ROS_DOMAIN_ID": str(domain)}
    done = subprocess.run(
        [node_python(distribution), *words], capture_output=True, text=True, env=environment, check=False
    )
    assert done.returncode == 0, done.stderr
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


@pytest.mark.slow
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_a_real_node_drives_the_robot_a_metre(distribution: str) -> None:
    domain = 41 + DISTRIBUTIONS.index(distribution)
    node_python(distribution)
    with simulated("simpleton", domain):
        time.sleep(1.0)  # the node joins late
        found = node(distribution, domain, 90.0, "/simpleton/cmd_vel", "/simpleton/odom")
    assert found["x"] > 1.0
    assert found["odometry"] > 20
    assert found["descriptions"] == 1


@pytest.mark.slow
@pytest.mark.parametrize("robot", ["simpleton", "mybot", "rrbot", "diff_wheeled_robot", "heterogeneous"])
def test_a_real_node_sees_all_topics_with_their_types_and_quality(robot: str) -> None:
    node_python("kilted")
    expected = {each.name: each.type for each in Simulator(robot).bus.topics if "/msg/" in each.type}
    with simulated(robot, 43):
        found = node("kilted", 43, 4.0)
    types = {name: kinds for name, kinds in found["types"].items() if name in expected}
    assert types == {name: [kind] for name, kind in expected.items()}
    latched = {name for name, quality in found["publishers"].items() if quality[1] == "TRANSIENT_LOCAL"}
    assert latched - {"/rosout", "/parameter_events"} == {"/robot_description", "/tf_static"} & found["types"].keys()
    assert found["publishers"]["/clock"][0] == "BEST_EFFORT"


@pytest.mark.slow
def test_a_late_joiner_gets_the_static_transforms_by_cyclonedds_alone() -> None:
    code = (
        "import sys, time; from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode; "
        "from urdfkit.bridges.node.node import Quality; from urdfkit.messages import typestore; "
        "found = []; node = CycloneddsNode(44); "
        "quality = Quality(reliable=True, latched=True, depth=1); "
        "node.subscribe('/tf_static', 'tf2_msgs/msg/TFMessage', quality, found.append)\n"
        "end = time.monotonic() + 30\n"
        "while not found and time.monotonic() < end: time.sleep(0.05)\n"
        "message = typestore().deserialize_cdr(found[0], 'tf2_msgs/msg/TFMessage')\n"
        "print(*(each.child_frame_id for each in message.transforms)); node.close()"
    )
    with simulated("simpleton", 44):
        time.sleep(1.0)
        done = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, env={**os.environ, **LOCAL}, check=False
        )
    assert done.returncode == 0, done.stderr
    assert "camera" in done.stdout


def test_a_configuration_that_cyclonedds_refuses_is_named() -> None:
    with pytest.raises(ResourceError, match="cannot join ROS domain 49") as caught:
        CycloneddsNode(49, {"CYCLONEDDS_URI": "file:///nowhere.xml"})
    assert str(caught.value).endswith("the configuration CYCLONEDDS_URI=file:///nowhere.xml")


@pytest.mark.slow
def test_a_publisher_that_leaves_the_graph_does_not_stop_its_listing() -> None:
    code = (
        "import sys; from urdfkit.bridges.node.node import Quality; "
        "from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode; node = CycloneddsNode(50); "
        "writer = node.writer('/odom', 'nav_msgs/msg/Odometry', Quality()); sys.stdin.read(); del writer; node.close()"
    )
    listing, end = CycloneddsNode(50, LOCAL), time.monotonic() + PATIENCE
    with running([sys.executable, "-c", code], env={**os.environ, **LOCAL}, stdin=subprocess.PIPE) as leaving:
        while "/odom" not in listing.topics():
            assert time.monotonic() < end, "/odom is not listed"
            time.sleep(0.05)
        leaving.communicate(timeout=PATIENCE)
    for _ in range(20):
        listing.topics()
        time.sleep(0.05)
    listing.close()


@pytest.mark.slow
def test_nodes_list_the_topics_of_each_other_beside_cyclonedds() -> None:
    """Cyclone DDS answered their requests for types, so that about half of them never listed the odometry."""
    domain, words = 48, [str(node_python("kilted")), str(Path(__file__).parent / "real_node.py")]
    code = (
        "import sys; from urdfkit.bridges.ros2.cyclonedds_node import CycloneddsNode; "
        f"node = CycloneddsNode({domain}); print('ready', flush=True); sys.stdin.read(); node.close()"
    )
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {**LOCAL, "ROS_DOMAIN_ID": str(domain)}
    pipe = subprocess.PIPE
    beside = running(
        [sys.executable, "-c", code], env={**os.environ, **LOCAL}, stdin=pipe, stdout=pipe, stderr=pipe, text=True
    )
    with beside as silent, running([*words, "600", "/cmd_vel", "/odom", ""], env=environment):
        assert silent.stdout is not None
        assert silent.stdout.readline() == "ready\n"
        for _ in range(5):
            assert "/odom" in node("kilted", domain, PATIENCE, awaited="/odom")["types"]
        assert silent.communicate(timeout=PATIENCE) == ("", "")


def urdfkit_by(distribution: str, code: str = "from urdfkit.cli import main; sys.exit(main())") -> list[str | Path]:
    """Return the command that runs urdfkit, or code with it, with rclpy; skip the test if its Python is another."""
    python = node_python(distribution)
    version = "import sys; import std_srvs; print(sys.version_info[:2] == " + repr(sys.version_info[:2]) + ")"
    done = subprocess.run([python, "-c", version], capture_output=True, text=True, check=False)
    if done.stdout.strip() != "True":
        pytest.skip("needs rclpy for this version of Python, and std_srvs: make ros2-nodes")
    run = f"import site, sys; sys.path.insert(0, {str(ROOT)!r}); site.addsitedir({site.getsitepackages()[0]!r}); {code}"
    return [python, "-c", run]


@pytest.mark.slow
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_rclpy_publishes_the_topics_and_serves_the_services(distribution: str) -> None:
    python, domain = node_python(distribution), 45 + DISTRIBUTIONS.index(distribution)
    with simulated("simpleton", domain, urdfkit_by(distribution), library="rclpy"):
        found = node(distribution, domain, 90.0, "/simpleton/cmd_vel", "/simpleton/odom")
        words: list[str | Path] = [python, Path(__file__).parent / "real_client.py"]
        environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
        environment |= {**LOCAL, "ROS_DOMAIN_ID": str(domain)}
        done = subprocess.run(words, capture_output=True, text=True, env=environment, check=False)
    assert found["x"] > 1.0
    assert found["descriptions"] == 1
    assert done.stdout.splitlines()[-1:] == ["answered"], done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_best_effort_subscribers_get_the_images_of_rclpy(distribution: str) -> None:
    """With the shared memory of Fast DDS's default, most images of 800 × 800 pixels are lost."""
    here, sent = Path(__file__).parent, 60
    writer = urdfkit_by(distribution, f"import runpy; runpy.run_path({str(here / 'image_writer.py')!r})")
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {**LOCAL, "ROS_DOMAIN_ID": str(61 + DISTRIBUTIONS.index(distribution))}
    reader = [str(node_python(distribution)), str(here / "image_reader.py"), str(sent)]
    with (
        running([*map(str, writer), str(sent)], env=environment),
        running(reader, env=environment, stdout=subprocess.PIPE, text=True) as viewer,
    ):
        received = int(viewer.communicate(timeout=90.0)[0].split()[-1])
    assert received >= 0.75 * sent


@pytest.mark.slow
@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_the_command_calls_a_service_of_a_real_node(distribution: str) -> None:
    command = [*urdfkit_by(distribution), "service"]
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {**LOCAL, "ROS_DOMAIN_ID": str(58 + DISTRIBUTIONS.index(distribution))}

    def service(*words: str) -> subprocess.CompletedProcess[str]:
        line = [*command, *words, "--live", "ros2"]
        return subprocess.run(line, capture_output=True, text=True, env=environment, check=False)

    server = [str(node_python(distribution)), str(Path(__file__).parent / "real_service.py")]
    with running(server, env=environment, stdout=subprocess.PIPE, text=True) as lamp:
        assert lamp.stdout is not None
        assert lamp.stdout.readline() == "ready\n"
        assert service("type", "/switch").stdout == "std_srvs/srv/SetBool\n"
        on, off = service("call", "/switch", "{data: true}", "--json"), service("call", "/switch", "--json")
    assert (on.returncode, json.loads(on.stdout)) == (0, {"success": True, "message": "on"}), on.stderr
    assert (off.returncode, json.loads(off.stdout)) == (1, {"success": False, "message": "stays on"}), off.stderr
