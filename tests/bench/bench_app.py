"""The page of a simulation under load, by hand: ``python tests/bench/bench_app.py [frames|watchers|start|memory] …``.

frames: a robot of 30 links and one watcher: pose frames per second, bytes, latency, CPU of the server per frame.
watchers: the real-time factor with nobody, and with 20 watching of whom 3 are stalled.
start: seconds, and CPU seconds, from the command to a robot of 100,000 triangles on the screen of a browser.
memory: RSS of the server and heap of the page over some minutes of driving.
"""

from __future__ import annotations

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2]))

CHROMIUM = "/usr/bin/chromium"
FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-precise-memory-info"]
WATCHER = """
import json, struct, sys, time, websocket
url, origin, cookie, seconds, acknowledge = json.loads(sys.argv[1])
line = websocket.create_connection(url, origin=origin, cookie=cookie, timeout=10)
print("ready", flush=True)
if not acknowledge:
    time.sleep(seconds)
    sys.exit()
end, late, size = time.monotonic() + seconds, [], 0
while time.monotonic() < end:
    frame = line.recv()
    if isinstance(frame, bytes) and frame[0] == 1:
        _, _, _, sequence, sent = struct.unpack_from("<BBHId", frame)
        late.append(time.monotonic() - sent)
        line.send(json.dumps({"type": "ack", "sequence": sequence}))
        size = len(frame)
print(json.dumps({"late": late, "size": size}), flush=True)
"""


def chain(links: int) -> str:
    """Return a robot of so many links in a row, on wheels that drive."""
    box = "<geometry><box size='0.1 0.1 0.1'/></geometry>"
    inertia = (
        "<inertial><mass value='0.2'/><inertia ixx='.001' iyy='.001' izz='.001' ixy='0' ixz='0' iyz='0'/></inertial>"
    )
    parts = [f"<link name='l0'>{inertia}<visual>{box}</visual><collision>{box}</collision></link>"]
    for k in range(1, links):
        parts.append(f"<link name='l{k}'>{inertia}<visual>{box}</visual></link>")
        parts.append(
            f"<joint name='j{k}' type='revolute'><parent link='l{k - 1}'/><child link='l{k}'/><origin xyz='0.11 0 0'/>"
            "<axis xyz='0 0 1'/><limit lower='-0.5' upper='0.5' effort='5' velocity='2'/></joint>"
        )
    return f"<robot name='chain'>{''.join(parts)}</robot>"


class Running:
    """A ride in a thread of its own, as the command runs it."""

    def __init__(self, robot: Any, **options: Any) -> None:
        from urdfkit.app.simulation.loop import DriveLoop
        from urdfkit.sim import Simulator
        from urdfkit.view.server.server import Server

        self.server = Server("sim", port=0)
        self.ride = DriveLoop(Simulator(robot, note=lambda _: None, **options), self.server)
        self.ride.show()
        self.server.start()
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _run(self) -> None:
        from urdfkit.app.simulation.clock_rate import FRAME

        self.ride.pace.begin(0.0)
        due = time.monotonic()
        while not self._ended.is_set():
            self.ride.tick()
            due = max(due + FRAME, time.monotonic() - FRAME)
            time.sleep(max(0.0, due - time.monotonic()))

    def stop(self) -> None:
        self._ended.set()
        self._thread.join()
        self.server.stop()

    def watch(self, seconds: float, *, acknowledge: bool = True) -> subprocess.Popen[str]:
        origin = f"http://127.0.0.1:{self.server.port}"
        cookie = f"{self.server.access.cookie}={self.server.access.session}"
        words = json.dumps([f"{origin.replace('http', 'ws')}/ws", origin, cookie, seconds, acknowledge])
        return subprocess.Popen([sys.executable, "-c", WATCHER, words], stdout=subprocess.PIPE, text=True)


def ready(process: subprocess.Popen[str]) -> None:
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"


def load(text: str) -> Any:
    from urdfkit.description import load as read

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "robot.urdf"
        path.write_text(text)
        return read(path)


def frames(seconds: float, rounds: int) -> None:
    """Time frames from the loop's publishing to a client's reading; CPU with a watcher and without, in turn."""
    running = Running(load(chain(30)))
    publish = running.server.publish
    running.server.publish = lambda t, poses: publish(time.monotonic(), poses)  # type: ignore[method-assign]
    thread = time.pthread_getcpuclockid(running.server._thread.ident or 0)
    late: list[float] = []
    rates, size = [], 0
    spent: dict[str, list[tuple[float, float]]] = {"alone": [], "watched": []}
    for _ in range(rounds):
        for kind, rows in spent.items():
            watcher = running.watch(seconds + 1) if kind == "watched" else None
            if watcher is not None:
                ready(watcher)
            time.sleep(0.5)
            before, begin = (time.process_time(), time.clock_gettime(thread)), time.monotonic()
            sent = running.server._sequence
            time.sleep(seconds)
            count = running.server._sequence - sent
            rates.append(count / (time.monotonic() - begin))
            after = time.process_time(), time.clock_gettime(thread)
            rows.append((1000 * (after[0] - before[0]) / count, 1000 * (after[1] - before[1]) / count))
            if watcher is not None:
                found = json.loads(watcher.communicate(timeout=20)[0])
                late += [1000 * each for each in found["late"]]
                size = found["size"]
    running.stop()
    late.sort()
    process = [watched[0] - alone[0] for alone, watched in zip(spent["alone"], spent["watched"], strict=True)]
    own = [watched[1] for watched in spent["watched"]]
    print(
        f"frames: {len(late) / rounds / (seconds + 1):.1f}/s delivered of {statistics.median(rates):.1f}/s sent "
        f"(target 60), {size} bytes (1000), latency p50 {late[len(late) // 2]:.1f} ms p95 "
        f"{late[int(0.95 * len(late))]:.1f} ms (30), CPU per frame {statistics.median(process):.2f} ms for the watcher "
        f"({min(process):.2f}..{max(process):.2f}), {statistics.median(own):.2f} ms of the server's thread in all (0.5)"
    )


def watchers(seconds: float, rounds: int) -> None:
    """Compare real-time factors, alone and watched, in turn."""
    running = Running("simpleton")
    factors: dict[str, list[float]] = {"alone": [], "watched": []}
    for _ in range(rounds):
        for kind in factors:
            lines = []
            if kind == "watched":
                lines = [running.watch(seconds + 3, acknowledge=k >= 3) for k in range(20)]
                for line in lines:
                    ready(line)
            time.sleep(0.5)
            wall, t = time.monotonic(), running.ride.simulator.t
            time.sleep(seconds)
            factors[kind].append((running.ride.simulator.t - t) / (time.monotonic() - wall))
            for line in lines:
                line.kill()
                line.communicate()
    running.stop()
    alone, watched = (statistics.median(values) for values in factors.values())
    print(
        f"watchers: real-time factor {alone:.4f} alone, {watched:.4f} with 20 watching, 3 of them stalled: "
        f"{100 * (watched / alone - 1):+.2f} % (2 %)"
    )


def mesh_robot(folder: Path, triangles: int) -> Path:
    import trimesh

    sphere = trimesh.creation.icosphere(subdivisions=6)  # 81,920
    rest = trimesh.creation.icosphere(subdivisions=4)
    several = trimesh.util.concatenate([sphere, *[rest.copy().apply_translation([3 * k, 0, 0]) for k in range(1, 5)]])
    assert len(several.faces) >= triangles
    several.apply_scale(0.1)
    several.export(folder / "body.stl")
    (folder / "robot.urdf").write_text(
        "<robot name='heavy'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
        "ixz='0' iyz='0'/></inertial><visual><geometry><mesh filename='body.stl'/></geometry></visual>"
        "<collision><geometry><sphere radius='0.1'/></geometry></collision></link></robot>"
    )
    return folder / "robot.urdf"


def cpu(process: int) -> float:
    """Return the CPU seconds that a process has taken."""
    fields = Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def start(rounds: int) -> None:
    """Time from the command to the picture, of the viewer and of a ride; the browser is open already."""
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        robot = mesh_robot(Path(folder), 100_000)
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        for words in (["view"], ["sim", "teleop"]):
            took = []
            for _ in range(rounds):
                page = browser.new_page()
                begin = time.monotonic()
                command = [sys.executable, "-m", "urdfkit", *words, str(robot), "--port", "0", "--no-browser"]
                process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
                assert process.stdout is not None
                url = process.stdout.readline().strip()
                served = time.monotonic() - begin
                page.goto(url, wait_until="commit")
                page.wait_for_selector("body[data-ready=true]", timeout=120_000)
                seen, spent = time.monotonic() - begin, cpu(process.pid)
                took.append(
                    f"{served:.2f} s to the address, {seen:.2f} s to the picture, {spent:.2f} CPU s of the server"
                )
                process.send_signal(2)
                process.wait()
                page.close()
            print(f"start of {words[-1]} (3 s) at load {os.getloadavg()[0]:.1f}: " + "; ".join(took))
        browser.close()


def memory(minutes: float) -> None:
    """Drive about, look through sensors, plot; write down RSS and heap."""
    from playwright.sync_api import sync_playwright

    command = [
        sys.executable,
        "-m",
        "urdfkit",
        "sim",
        "teleop",
        "simpleton",
        "--world",
        "house",
        "--port",
        "0",
        "--no-browser",
    ]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    assert process.stdout is not None
    rows = []
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=FLAGS)
        page = browser.new_page(viewport={"width": 640, "height": 480})
        page.goto(process.stdout.readline().strip())
        page.wait_for_selector("body[data-ready=true]", timeout=120_000)
        page.evaluate("urdfkit.plots.add('/simpleton/odom', 'twist.twist.linear.x')")
        page.evaluate("urdfkit.connection.subscribe('contacts', true); urdfkit.connection.subscribe('topics', true)")
        devtools = page.context.new_cdp_session(page)
        end = time.monotonic() + 60 * minutes
        begin = time.monotonic()
        while time.monotonic() < end:
            for key in "wasd":
                page.keyboard.down(key)
                page.wait_for_timeout(2500)
                page.keyboard.up(key)
            devtools.send("HeapProfiler.collectGarbage")
            heap = page.evaluate("performance.memory.usedJSHeapSize") / 1e6
            status = Path(f"/proc/{process.pid}/status").read_text()
            rss = int(next(line for line in status.splitlines() if line.startswith("VmRSS")).split()[1]) / 1e3
            rows.append((time.monotonic() - begin, rss, heap))
            print(f"  {rows[-1][0]:5.0f} s  server {rss:6.1f} MB  page {heap:5.1f} MB", flush=True)
        browser.close()
    process.send_signal(2)
    process.wait()
    later = np.array(rows[len(rows) // 3 :])  # without the first third, in which things are loaded
    rss, heap = (np.polyfit(later[:, 0], later[:, k], 1)[0] * 3600 for k in (1, 2))
    print(
        f"memory: {rss:+.1f} MB/h of the server, {heap:+.1f} MB/h of the page, extrapolated from {later[-1, 0]:.0f} s"
    )


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", nargs="*", default=["frames", "watchers", "start"])
    parser.add_argument("--seconds", type=float, default=6.0)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--minutes", type=float, default=4.0)
    given = parser.parse_args()
    for what in given.what:
        if what == "frames":
            frames(given.seconds, given.rounds)
        elif what == "watchers":
            watchers(given.seconds, given.rounds)
        elif what == "start":
            start(given.rounds)
        else:
            memory(given.minutes)
