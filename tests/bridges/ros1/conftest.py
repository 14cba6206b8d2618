"""A master of ROS 1, Debian's, and programs that use it."""

from __future__ import annotations

import os
import socket
import subprocess
import time
from collections.abc import Iterator

import pytest

from tests.time_limit import PATIENCE

DEBIAN = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin"}


def debian_environment(uri: str) -> dict[str, str]:
    """Return variables with which Debian's ROS runs, without those of this Python."""
    return {**DEBIAN, "HOME": os.environ["HOME"], "ROS_MASTER_URI": uri, "ROS_IP": "127.0.0.1"}


class Master:
    """A running rosmaster; `stop` and `start` again at the same address."""

    def __init__(self) -> None:
        with socket.create_server(("127.0.0.1", 0)) as free:
            self.port = free.getsockname()[1]
        self.uri = f"http://127.0.0.1:{self.port}"
        self.start()

    def start(self) -> None:
        command = ["/usr/bin/rosmaster", "--core", "-p", str(self.port)]
        self._process = subprocess.Popen(
            command, env=debian_environment(self.uri), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            try:
                socket.create_connection(("127.0.0.1", self.port)).close()
                return
            except OSError:
                time.sleep(0.05)
        pytest.fail("rosmaster has not started")

    def stop(self) -> None:
        self._process.kill()
        self._process.wait()


@pytest.fixture
def master(monkeypatch: pytest.MonkeyPatch) -> Iterator[Master]:
    running = Master()
    monkeypatch.setenv("ROS_MASTER_URI", running.uri)
    yield running
    running.stop()
