"""The browser app's line: pose frames of 30 links at 60 Hz to one, then twenty watchers, three of them stalled."""

from __future__ import annotations

import json
import statistics
import struct
import subprocess
import sys
import time

import numpy as np

from urdfkit.view.server.server import Server

LINKS, RATE, SECONDS = 30, 60.0, 5.0
WATCHER = """
import json, struct, sys, time, websocket
url, origin, cookie, seconds, acknowledge = json.loads(sys.argv[1])
line = websocket.create_connection(url, origin=origin, cookie=cookie, timeout=10)
print("ready", flush=True)
if not acknowledge:
    time.sleep(seconds + 2)
    sys.exit()
late, sent = [], 0.0
while sent >= 0.0:
    frame = line.recv()
    if isinstance(frame, bytes) and frame[0] == 1:
        _, _, _, sequence, sent = struct.unpack_from("<BBHId", frame)
        if sent > 0.0:
            late.append(time.monotonic() - sent)
        line.send(json.dumps({"type": "ack", "sequence": sequence}))
        size = len(frame)
print(json.dumps({"late": late, "size": size}), flush=True)
"""


def measure(watchers: int, stalled: int) -> str:
    """Return one line of results."""
    poses = np.tile([0.0, 0, 0, 0, 0, 0, 1], (LINKS, 1))
    with Server("sim", port=0) as server:
        nodes = [f"/robot/links/{i}" for i in range(LINKS)]
        server.show(name="bench", nodes=nodes, draw=lambda window: None)
        origin = f"http://127.0.0.1:{server.port}"
        cookie = f"{server.access.cookie}={server.access.session}"
        processes = []
        for number in range(watchers):
            words = [f"{origin.replace('http', 'ws')}/ws", origin, cookie, SECONDS, number >= stalled]
            command = [sys.executable, "-c", WATCHER, json.dumps(words)]
            processes.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True))
        for process in processes:
            assert process.stdout is not None
            assert process.stdout.readline() == "ready\n"
        calls, cpu, begin = [], time.process_time(), time.monotonic()
        frames = round(SECONDS * RATE)
        for number in range(frames):
            before = time.perf_counter()
            server.publish(time.monotonic(), poses)
            calls.append(time.perf_counter() - before)
            time.sleep(max(0.0, begin + (number + 1) / RATE - time.monotonic()))
        spent = time.process_time() - cpu
        results = []
        server.publish(-1.0, poses)
        for number, process in enumerate(processes):
            out = process.communicate(timeout=20)[0]
            if number >= stalled:
                results.append(json.loads(out))
    spent_each = 1000 * spent / frames
    late = sorted(1000 * t for result in results for t in result["late"])
    rate = statistics.mean(len(result["late"]) for result in results) / SECONDS
    return (
        f"{watchers:2d} watchers, {stalled} stalled: {rate:.1f} frames/s of {results[0]['size']} bytes, latency p50 "
        f"{late[len(late) // 2]:.2f} ms p95 {late[int(0.95 * len(late))]:.2f} ms; per frame {spent_each:.3f} ms "
        f"CPU in all, {1e6 * statistics.median(calls):.0f} µs for the caller"
    )


if __name__ == "__main__":
    assert struct.calcsize("<BBHId") == 16
    for watchers, stalled in ((1, 0), (20, 3)):
        print(measure(watchers, stalled))
