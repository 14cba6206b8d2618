"""Time from a velocity command to the odometry that shows it, over a bridge, with and without camera images.

Run it as ``python -m tests.bench.bench_latency [foxglove] [rosbridge] [--commands N]``; it starts the simulation of a
copy of simpleton, whose odometry is published in every step instead of 100 times per second: otherwise the time until
the next message, up to 10 ms, is most of what is measured. One client drives and receives the images of the camera of
800 × 800 pixels, 30 per second.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import cbor2
import numpy as np
import websocket

from tests.processes import running
from urdfkit.messages import from_fields, typestore

ROBOT = Path(__file__).parents[2] / "robots" / "simpleton"
COMMAND, ODOMETRY, IMAGE = "/simpleton/cmd_vel", "/simpleton/odom", "/simpleton/camera1/image_raw"
TWIST = "geometry_msgs/msg/Twist"
SPEEDS = (0.5, 0.2)
"""Commanded in turn [m/s]; the odometry of encoders has no sign, as in Gazebo."""

CHANGE = 0.01
"""Change of the velocity that shows a command [m/s]; the wheels accelerate by twice as much in one step."""


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
def simulated(option: str, renderer: str) -> Iterator[int]:
    """Start the simulation with a bridge; yield the port of the bridge."""
    with tempfile.TemporaryDirectory() as folder:
        robot = Path(shutil.copytree(ROBOT, Path(folder) / "simpleton"))
        for file in robot.glob("*/urdf/gazebo.xacro"):
            file.write_text(file.read_text().replace("<updateRate>100<", "<updateRate>1000<"))
        command = [sys.executable, "-m", "urdfkit", "sim", "teleop", str(robot / "simpleton_description")]
        pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        with running(
            [*command, "--no-browser", "--port", "0", option, "0", "--renderer", renderer], **pipes
        ) as process:
            assert process.stdout is not None
            for line in process.stdout:
                if found := re.search(r"ws://127\.0\.0\.1:(\d+)", line):
                    yield int(found[1])
                    return
            raise SystemExit("the simulation did not start")


def measured(client: Any, commands: int) -> tuple[list[float], float]:
    """Drive quickly and slowly in turn; return the times to the odometry [ms] and the images per second."""
    times: list[float] = []
    random = np.random.default_rng(1)
    begin, images, speed = time.perf_counter(), 0, 0.0
    while len(times) < commands:
        rest = time.perf_counter() + float(random.uniform(0.05, 0.15))
        while time.perf_counter() < rest:
            kind, x = client.receive()
            images += kind == "image"
            speed = x if kind == "odometry" else speed
        wanted = SPEEDS[len(times) % 2]
        sent = time.perf_counter()
        client.command(wanted)
        while True:
            kind, x = client.receive()
            images += kind == "image"
            if kind == "odometry" and abs(x - wanted) < abs(speed - wanted) - CHANGE:
                break
        times.append((time.perf_counter() - sent) * 1e3)
    return times, images / (time.perf_counter() - begin)


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("bridges", nargs="*", choices=[[], *CLIENTS], default=[])
    parser.add_argument("--commands", type=int, default=300)
    parser.add_argument("--renderer", choices=("auto", "ray", "gl"), default="auto")
    options = parser.parse_args()
    for name in options.bridges or CLIENTS:
        kind = CLIENTS[name]
        for images in (False, True):
            with simulated(kind.option, options.renderer) as port:
                client = kind(port, images=images)
                for _ in range(20 if not images else 30):
                    client.receive()
                times, rate = measured(client, options.commands)
            p50, p99, worst = np.percentile(times, [50, 99, 100])
            label = f"{name:10s} {'with' if images else 'without'} images"
            print(f"{label}: p50 {p50:.1f} p99 {p99:.1f} largest {worst:.1f} ms · images {rate:.1f} Hz", flush=True)


if __name__ == "__main__":
    main()
