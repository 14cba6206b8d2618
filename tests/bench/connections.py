"""Time of answer to the driver, and memory of ``sim teleop``, with hundreds of other connections open.

Run it as ``python -m tests.bench.connections [--count N]``; it starts the simulation of simpleton. The other
connections are open at the same time: pages of another process, requests whose headers never end, and requests with a
wrong token. Exit status 1 if the driver got no answer, a new page was refused, or a stalled driver kept the robot.
"""

from __future__ import annotations

import argparse
import asyncio
import json
import re
import socket
import statistics
import subprocess
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from http.client import HTTPConnection
from urllib.parse import urlsplit

from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.websocket import websocket_connect

from tests.processes import running
from urdfkit.view.protocol.client import Client, connect

AHEAD = {"type": "axes", "axes": [1, 0, 0, 0], "speed": 0.5, "turn": 1}
REQUESTS = 100
PIPE = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}


def memory(process: int) -> float:
    """Return the resident memory of a process [MB]."""
    with open(f"/proc/{process}/status") as file:  # noqa: PTH123
        return int(re.findall(r"VmRSS:\s+(\d+)", file.read())[0]) / 1024


async def answers(client: Client) -> list[float]:
    """Drive, and return the times from a request to the answer of the simulation [ms]."""
    times = []
    for _ in range(REQUESTS):
        while await client.text(0.0) is not None:
            pass
        await client._line.write_message(json.dumps(AHEAD))
        start = time.perf_counter()
        await client.request("form", topic="/cmd_vel", type="geometry_msgs/msg/Twist")
        times.append((time.perf_counter() - start) * 1e3)
        await asyncio.sleep(0.05)
    return times


async def seconds_until_free(client: Client) -> float:
    """Return the time from the last input of a stalled driver until the status names no driver [s]."""
    while await client.text(0.0) is not None:
        pass
    await client._line.write_message(json.dumps(AHEAD))
    start, seen = time.perf_counter(), False
    while (message := await client.text(10.0)) is not None:
        if message["type"] == "status":
            seen |= message["driver"] is not None
            if seen and message["driver"] is None:
                break
    return time.perf_counter() - start


async def watch(url: str, cookie: str, count: int) -> None:
    """Open pages that read all frames and acknowledge none; print how many were accepted, and keep them open."""
    pages, place = [], urlsplit(url).netloc
    headers = {"Cookie": cookie, "Origin": f"http://{place}"}
    for _ in range(count):
        with suppress(HTTPClientError):
            request = HTTPRequest(f"ws://{place}/ws", headers=headers)
            pages.append(await websocket_connect(request, on_message_callback=lambda _: None))
    print(len(pages), flush=True)
    await asyncio.sleep(3600.0)


def slow_request(port: int) -> socket.socket:
    """Return a connection whose request has no end."""
    line = socket.create_connection(("127.0.0.1", port))
    line.sendall(f"GET / HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nX-A: ".encode())
    return line


def page(port: int, cookie: str, *, origin: str = "") -> tuple[socket.socket, str]:
    """Return the WebSocket of a page that reads nothing but the status line, and that line."""
    line = socket.create_connection(("127.0.0.1", port), timeout=30)
    host = f"127.0.0.1:{port}"
    lines = [
        "GET /ws HTTP/1.1",
        f"Host: {host}",
        f"Origin: {origin or f'http://{host}'}",
        f"Cookie: {cookie}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        "Sec-WebSocket-Version: 13",
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
    ]
    line.sendall("\r\n".join([*lines, "", ""]).encode())
    return line, line.recv(64).decode().partition("\r\n")[0]


def get(port: int, path: str, **headers: str) -> tuple[int, str]:
    """Return the status and the cookie of a response."""
    connection = HTTPConnection("127.0.0.1", port, timeout=30)
    connection.request("GET", path, headers=headers)
    response = connection.getresponse()
    connection.close()
    return response.status, (response.headers["Set-Cookie"] or "").split(";")[0]


async def measure(url: str, process: int, count: int) -> int:
    """Print the table; return the exit status."""
    port, failed = int(urlsplit(url).port or 0), 0
    _, cookie = get(port, f"/?{urlsplit(url).query}")
    lines: list[socket.socket] = []

    async def show(name: str) -> None:
        times = sorted(await answers(driver))
        print(
            f"{name:42} {memory(process):7.0f} MB   {statistics.median(times):6.1f} ms   {times[-2]:6.1f} ms",
            flush=True,
        )

    async with await connect(url) as driver:
        while (message := await driver.text(300.0)) is None or message["type"] != "status":
            pass  # until the robot is loaded
        print(f"{'other connections':42} {'memory':>10}   {'median':>9}   {'98 %':>9}")
        await show("none")
        with running(
            [sys.executable, "-m", "tests.bench.connections", "--watch", url, cookie, "--count", str(count)], **PIPE
        ) as watching:
            accepted = int(await asyncio.to_thread(watching.stdout.readline))
            await show(f"{accepted} pages")
            for _ in range(count):
                lines.append(await asyncio.to_thread(slow_request, port))
            await show(f"and {count} requests that never end")
            refused = [await asyncio.to_thread(get, port, "/?token=wrong") for _ in range(count)]
            await show(f"and {count} requests with a wrong token")
            foreign = {
                "without token": await asyncio.to_thread(get, port, "/"),
                "another site": await asyncio.to_thread(
                    lambda: get(port, "/", Origin="http://example.com", Cookie=cookie)
                ),
                "another host": await asyncio.to_thread(lambda: get(port, "/", Host="example.com", Cookie=cookie)),
            }
            line, after = await asyncio.to_thread(page, port, cookie)
            lines.append(line)
            print(f"page {count + 2}: {after}")
            start = time.perf_counter()
            other, _ = await asyncio.to_thread(get, port, "/", Cookie=cookie)
            print(f"the page itself: {other} after {(time.perf_counter() - start) * 1e3:.0f} ms")
            print(f"another site's WebSocket: {page(port, cookie, origin='http://example.com')[1]}")
            print("rejected:", {name: status for name, (status, _) in foreign.items()})
            freed = await seconds_until_free(driver)
            print(f"a stalled driver loses the robot after {freed:.2f} s")
            for line in lines:
                line.close()
    failed += (accepted < count) + (" 101 " not in after) + (other != 200) + (freed > 5.0)
    failed += any(status != 403 for status, _ in (*refused, *foreign.values()))
    return int(failed > 0)


def main(argv: Sequence[str] | None = None) -> int:
    """Start the simulation and measure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=300, help="connections of each kind (default: 300)")
    parser.add_argument("--watch", nargs=2, help=argparse.SUPPRESS)
    arguments = parser.parse_args(argv)
    if arguments.watch:
        asyncio.run(watch(*arguments.watch, arguments.count))
    command = [sys.executable, "-m", "urdfkit", "sim", "teleop", "simpleton", "--no-browser", "--port", "0"]
    with running(command, **PIPE) as process:
        for line in process.stdout:
            if found := re.search(r"http://\S+token=\S+", line):
                return asyncio.run(measure(found[0], process.pid, arguments.count))
            print(line, end="")
    return 1


if __name__ == "__main__":
    sys.exit(main())
