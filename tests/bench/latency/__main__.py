"""Time from a velocity command to the odometry that shows it, over a bridge, with and without camera images.

Run it as ``python -m tests.bench.latency [foxglove] [rosbridge] [ros2] [--commands N]``; it starts the simulation of a
copy of simpleton, whose odometry is published in every step instead of 100 times per second: otherwise the time until
the next message, up to 10 ms, is most of what is measured. One client drives and receives the images of the camera of
800 × 800 pixels, 30 per second. For ROS 2 it is a real node of rclpy: ``make ros2-nodes``, or ``--rclpy PYTHON``.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import cbor2
import numpy as np
import websocket

from tests.bench.latency.measurement import measured
from tests.processes import running
from urdfkit.messages import from_fields, typestore

ROBOT = Path(__file__).parents[3] / "robots" / "simpleton"
COMMAND, ODOMETRY, IMAGE = "/simpleton/cmd_vel", "/simpleton/odom", "/simpleton/camera1/image_raw"
TWIST = "geometry_msgs/msg/Twist"
LOCAL = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
NODE = Path(__file__).parent / "ros2_node.py"
RCLPY = Path(__file__).parents[3] / ".venv" / "ros2-kilted" / "bin" / "python"


class Foxglove:
    """A client of the Foxglove protocol."""

    option = "--foxglove"

    def __init__(self, port: int, *, images: bool) -> None:
        self._line = websocket.create_connection(
            f"ws://127.0.0.1:{port}", subprotocols=["foxglove.websocket.v1"], max_size=None
        )
        self._channels: dict[str, int] = {}
        while not {ODOMETRY, IMAGE} <= set(self._channels):
            message = json.loads(self._line.recv())
            self._channels |= {each["topic"]: each["id"] for each in message.get("channels", [])}
        wanted = [ODOMETRY, IMAGE] if images else [ODOMETRY]
        rows = [{"id": number, "channelId": self._channels[name]} for number, name in enumerate(wanted)]
        self._send(op="subscribe", subscriptions=rows)
        self._send(op="advertise", channels=[{"id": 1, "topic": COMMAND, "encoding": "cdr", "schemaName": TWIST}])

    def _send(self, **message: Any) -> None:
        self._line.send(json.dumps(message))

    def command(self, x: float) -> None:
        """Publish a forward velocity [m/s]."""
        content = typestore().serialize_cdr(from_fields(TWIST, {"linear": {"x": x}}), TWIST)
        self._line.send_binary(struct.pack("<BI", 1, 1) + bytes(content))

    def receive(self) -> tuple[str, float]:
        """Return ``odometry`` and its velocity [m/s], or ``image`` and zero."""
        while True:
            frame = self._line.recv()
            if isinstance(frame, bytes) and frame[0] == 1:
                if frame[1] == 1:
                    return "image", 0.0
                odometry = typestore().deserialize_cdr(frame[13:], "nav_msgs/msg/Odometry")
                return "odometry", odometry.twist.twist.linear.x


class Rosbridge:
    """A client of rosbridge, with messages as CBOR."""

    option = "--rosbridge"

    def __init__(self, port: int, *, images: bool) -> None:
        self._line = websocket.create_connection(f"ws://127.0.0.1:{port}", max_size=None)
        for topic in (ODOMETRY, IMAGE) if images else (ODOMETRY,):
            self._send(op="subscribe", topic=topic, compression="cbor")
        self._send(op="advertise", topic=COMMAND, type="geometry_msgs/Twist")

    def _send(self, **message: Any) -> None:
        self._line.send(json.dumps(message))

    def command(self, x: float) -> None:
        """Publish a forward velocity [m/s]."""
        self._send(op="publish", topic=COMMAND, msg={"linear": {"x": x}})

    def receive(self) -> tuple[str, float]:
        """Return ``odometry`` and its velocity [m/s], or ``image`` and zero."""
        while True:
            frame = self._line.recv()
            if isinstance(frame, bytes):
                message = cbor2.loads(frame)
                if message["topic"] == IMAGE:
                    return "image", 0.0
                return "odometry", message["msg"]["twist"]["twist"]["linear"]["x"]


CLIENTS: dict[str, type[Foxglove | Rosbridge]] = {"foxglove": Foxglove, "rosbridge": Rosbridge}


@contextmanager
def simulated(*options: str, ready: str) -> Iterator[str]:
    """Start the simulation with options; yield the first group of the pattern of the line that says it is ready."""
    with tempfile.TemporaryDirectory() as folder:
        robot = Path(shutil.copytree(ROBOT, Path(folder) / "simpleton"))
        for file in robot.glob("*/urdf/gazebo.xacro"):
            file.write_text(file.read_text().replace("<updateRate>100<", "<updateRate>1000<"))
        command = [sys.executable, "-m", "urdfkit", "sim", "teleop", str(robot / "simpleton_description")]
        pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        with running(
            [*command, "--no-browser", "--port", "0", *options], **pipes, env={**os.environ, **LOCAL}
        ) as process:
            assert process.stdout is not None
            for line in process.stdout:
                if found := re.search(ready, line):
                    yield found[1]
                    return
            raise SystemExit("the simulation did not start")


def measured_by_node(python: Path, domain: str, commands: int, *, images: bool) -> tuple[list[float], float]:
    """Return the measurement of a real node of rclpy, run by the Python of its own environment."""
    environment = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}
    environment |= {**LOCAL, "ROS_DOMAIN_ID": domain}
    words = [python, NODE, commands, int(images), COMMAND, ODOMETRY, IMAGE]
    with running(words, stdout=subprocess.PIPE, text=True, env=environment) as process:
        times, rate = json.loads(process.communicate()[0].splitlines()[-1])
    return times, rate


def measurement(name: str, options: argparse.Namespace, *, images: bool) -> tuple[list[float], float]:
    """Return the times from a command to the odometry [ms], and the images per second, over a bridge."""
    renderer = ("--renderer", options.renderer)
    if name == "ros2":
        domain = str(random.randrange(60, 100))
        with simulated("--ros2", "--ros-domain", domain, *renderer, ready="(ros2): topics are published"):
            return measured_by_node(options.rclpy, domain, options.commands, images=images)
    kind = CLIENTS[name]
    with simulated(kind.option, "0", *renderer, ready=r"ws://127\.0\.0\.1:(\d+)") as port:
        return measured(kind(int(port), images=images), options.commands)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bridges", nargs="*", choices=[[], *CLIENTS, "ros2"], default=[])
    parser.add_argument("--commands", type=int, default=300)
    parser.add_argument("--renderer", choices=("auto", "ray", "gl"), default="auto")
    parser.add_argument("--rclpy", type=Path, default=RCLPY, help="Python that has rclpy")
    options = parser.parse_args()
    for name in options.bridges or [*CLIENTS, "ros2"]:
        for images in (False, True):
            times, rate = measurement(name, options, images=images)
            p50, p99, worst = np.percentile(times, [50, 99, 100])
            label = f"{name:10s} {'with' if images else 'without'} images"
            print(f"{label}: p50 {p50:.1f} p99 {p99:.1f} largest {worst:.1f} ms · images {rate:.1f} Hz", flush=True)


if __name__ == "__main__":
    main()
