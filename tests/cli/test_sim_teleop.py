import math
import os
import signal
import subprocess
import sys
from concurrent.futures import Future
from pathlib import Path
from threading import Event

import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("meshcat")
pytest.importorskip("numba")

from urdfkit.app.simulation.clock_rate import BEHIND, FRAME
from urdfkit.app.simulation.loop import SERVED, DriveLoop
from urdfkit.cli import main
from urdfkit.view.protocol.websocket_messages import Axes

X = "urdfkit.link().position.x"
SPEED = "parseFloat(document.getElementById('velocity').textContent)"
REMEMBER = """
  window.remembered = [];
  urdfkit.page.on("status", ({ time, pose, driver }) =>
    remembered.push({ t: time, x: pose.x, y: pose.y, drives: driver !== null }));
"""
"""Keep time, place and whether somebody drives as the simulation tells them, of one moment, however late heard."""
IN_THE_WAY = """
  (() => {
    const { scene, viewport } = urdfkit, THREE = MeshCat.THREE;
    const box = scene.bounds(), ray = new THREE.Raycaster(), eye = viewport.viewer.camera.position;
    const others = [...scene.groups.visual.values()].filter((group) => !scene.own.includes(group.parent));
    const found = [];
    for (const to of [box.getCenter(new THREE.Vector3()), new THREE.Vector3(0, box.max.y, 0)]) {
      ray.set(eye, to.clone().sub(eye).normalize());
      ray.far = eye.distanceTo(to) - 0.1;
      found.push(...ray.intersectObjects(others, true).map(({ object }) => scene.owner(object)));
    }
    return found;
  })()
"""
"""The bodies of the world between the camera and the robot."""
AHEAD = Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0)


@pytest.fixture(scope="module")
def simpleton(serve_for_all):
    return serve_for_all("sim", "teleop", "simpleton")


@pytest.fixture
def driving(simpleton, visits, until):
    """Simpleton on the page, where it starts."""
    page = visits.open(simpleton.url, viewport={"width": 960, "height": 600})
    page.wait_for_selector("#progress", state="hidden")
    page.get_by_role("button", name="Reset").click()
    until(lambda: max(map(abs, at(page))) < 1e-3)
    return simpleton, page


def at(page) -> tuple[float, float]:
    return tuple(page.evaluate("[urdfkit.link().position.x, urdfkit.link().position.y]"))


def stands(page, until) -> tuple[float, float]:
    """Wait until the robot stands still, for a tenth of a second of simulated time; return where."""
    until(lambda: page.evaluate(SPEED) == 0)

    def still() -> bool:
        before, frames = at(page), page.evaluate("Number(document.body.dataset.frames)")
        until(lambda: page.evaluate("Number(document.body.dataset.frames)") > frames + 3)
        return math.dist(before, at(page)) < 1e-4

    until(still)
    return at(page)


@pytest.mark.browser
def test_holding_a_key_drives_and_letting_go_stops(driving, visits, keep, until) -> None:
    _, page = driving
    start = at(page)
    keep(page, "start")
    page.evaluate(REMEMBER)
    page.keyboard.down("w")
    until(lambda: at(page)[0] - start[0] >= 0.5)
    page.keyboard.up("w")
    keep(page, "driven")
    rest = stands(page, until)
    rows = page.evaluate("remembered")
    driven = [k for k, row in enumerate(rows) if row["drives"]]
    held = sum(rows[k]["t"] - rows[k - 1]["t"] for k in driven if k - 1 in driven)
    first, last, free = rows[driven[0]], rows[driven[-1]], rows[driven[-1] + 1]
    assert (
        last["x"] - first["x"] >= 0.25 * held > 0.0
    )  # this is what is promised: half a metre in two seconds of holding
    assert max(abs(row["y"] - start[1]) for row in rows) < 0.01
    # Somewhere between these two the wheel was let go: until then it may have gone on at its speed.
    assert rest[0] - last["x"] < 0.3 + 0.5 * (free["t"] - last["t"])
    assert visits.problems == []


@pytest.mark.browser
def test_every_layout_drives(driving, until) -> None:
    _, page = driving
    for key, sign in (("i", 1), ("s", -1), ("ArrowUp", 1), (",", -1), ("ArrowDown", -1)):
        start = at(page)[0]
        page.keyboard.down(key)
        until(lambda start=start, sign=sign: sign * (at(page)[0] - start) > 0.1)
        page.keyboard.up(key)
    stands(page, until)


@pytest.mark.browser
def test_keys_turn_and_change_speed(driving, until) -> None:
    _, page = driving
    yaw = "2 * Math.atan2(urdfkit.link().quaternion.z, urdfkit.link().quaternion.w)"
    for _ in range(3):
        page.keyboard.press("q")
    assert page.locator("#speed-value").inner_text() == "0.67 m/s"
    assert page.locator("#turn-value").inner_text() == "1.33 rad/s"
    page.keyboard.press("z")
    page.keyboard.press("c")
    assert page.locator("#turn-value").inner_text() == "1.08 rad/s"
    page.keyboard.down("a")
    until(lambda: page.evaluate(yaw) > 0.3)
    page.keyboard.up("a")
    page.keyboard.down("d")
    until(lambda: page.evaluate(yaw) < 0)
    page.keyboard.press("k")  # stops although d is still down
    stands(page, until)
    page.keyboard.up("d")


@pytest.mark.browser
def test_the_pad_drives_by_mouse(driving, keep, until) -> None:
    _, page = driving
    start = at(page)[0]
    box = page.locator("#pad").bounding_box()
    assert box is not None
    page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    page.mouse.down()
    page.mouse.move(box["x"] + box["width"] / 2, box["y"], steps=4)
    until(lambda: at(page)[0] - start > 0.2)
    keep(page, "pad")
    page.mouse.up()
    stands(page, until)


@pytest.mark.browser
def test_a_page_that_loses_the_keyboard_stops_the_robot(driving, until) -> None:
    _, page = driving
    for event in ("blur", "pagehide"):
        page.keyboard.down("w")
        until(lambda: page.evaluate(SPEED) > 0.3)
        page.evaluate("(event) => window.dispatchEvent(new Event(event))", event)
        stands(page, until)
        page.keyboard.up("w")


@pytest.mark.browser
@pytest.mark.parametrize("how", ["close", "hang", "cut"])
def test_a_page_that_goes_away_stops_the_robot(driving, visits, until, how: str) -> None:
    served, page = driving
    watching = visits.open(served.url, viewport={"width": 480, "height": 360})
    page.bring_to_front()
    page.keyboard.down("w")
    until(lambda: watching.evaluate(SPEED) > 0.3 and watching.locator("#driver-other").is_visible())
    if how == "close":
        page.close()
    elif how == "hang":  # the worker of the connection lives, but the page does nothing for ten seconds
        page.evaluate("setTimeout(() => { for (const end = performance.now() + 10000; performance.now() < end; ); })")
    else:
        page.evaluate("urdfkit.connection.socket.close()")
    stands(watching, until)
    until(lambda: not watching.locator("#driver-other").is_visible())


@pytest.mark.browser
def test_pause_and_reset(driving, keep, until) -> None:
    _, page = driving
    page.keyboard.down("w")
    until(lambda: at(page)[0] > 0.1)
    page.get_by_role("button", name="Pause").click()
    until(lambda: page.locator("#rtf").inner_text() == "paused")
    clock = page.locator("#sim-time").inner_text()
    keep(page, "paused")
    page.keyboard.up("w")
    assert page.locator("#sim-time").inner_text() == clock
    page.keyboard.press("p")
    until(lambda: page.locator("#sim-time").inner_text() != clock)
    page.get_by_role("button", name="Reset").click()
    until(lambda: abs(at(page)[0]) < 0.01)
    until(lambda: float(page.locator("#sim-time").inner_text().split()[0]) < 5)


@pytest.mark.browser
def test_the_camera_follows_and_time_keeps_pace(driving, until) -> None:
    _, page = driving
    until(lambda: 0.9 < float(page.locator("#rtf").inner_text().lstrip("×")) < 1.1)
    offset = "[viewport.viewer.controls.target, viewport.viewer.camera.position].map((p) => p.x - link().position.x)"
    offset = f"(({{ viewport, link }}) => {offset})(urdfkit)"
    before = page.evaluate(offset)
    page.keyboard.down("w")
    until(lambda: at(page)[0] > 0.3)
    page.keyboard.up("w")
    stands(page, until)
    assert page.evaluate(offset) == pytest.approx(before, abs=1e-3)


@pytest.mark.browser
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_drives_by_thumb(simpleton, visits, keep, until, scheme: str) -> None:
    phone = {"viewport": {"width": 390, "height": 844}, "is_mobile": True, "has_touch": True}
    page = visits.open(simpleton.url, color_scheme=scheme, **phone)
    page.get_by_role("button", name="Reset").tap()
    until(lambda: max(map(abs, at(page))) < 1e-3)
    box = page.locator("#pad").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    thumb = page.context.new_cdp_session(page)
    thumb.send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
    thumb.send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [{"x": x, "y": y - 60}]})
    until(lambda: at(page)[0] > 0.2)
    keep(page, f"phone-{scheme}")
    thumb.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    stands(page, until)


@pytest.mark.browser
def test_nobody_gets_in_without_the_key(simpleton, visits) -> None:
    other = visits.open("about:blank", ready=False)
    answer = other.goto(f"{simpleton.origin}/")
    assert answer is not None
    assert answer.status == 403


@pytest.mark.slow
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_ending_is_clean_and_leaves_nothing_behind(serve, how: signal.Signals) -> None:
    served = serve("sim", "teleop", "simpleton")
    pid = served.process.pid
    assert served.end(how) in (0, 130)
    with pytest.raises(ProcessLookupError):
        os.kill(pid, 0)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["simpelton"], "did you mean `simpleton`?"),
        (["simpleton", "--world", "hous"], "hous"),
        (["{folder}/massless.urdf", "--strict"], "massless.urdf:"),
        (["simpleton", "--port", "-5"], "outside 0..65535"),
    ],
)
def test_bad_input_is_one_line_and_exit_2(tmp_path: Path, capfd, words: list[str], expected: str) -> None:
    (tmp_path / "massless.urdf").write_text(
        '<robot name="x"><link name="a"/><link name="b"/><joint name="j" type="continuous">\n'
        '<parent link="a"/><child link="b"/></joint></robot>'
    )
    assert main(["sim", "teleop", *(word.format(folder=tmp_path) for word in words), "--no-browser"]) == 2
    output = capfd.readouterr()
    assert output.out == ""
    error = [line for line in output.err.splitlines() if not line.startswith("compiling")]
    assert len(error) == 1
    assert expected in error[0]


def test_nothing_heavy_is_imported_for_the_help() -> None:
    code = "import sys; from urdfkit.cli import main\ntry: main(['sim', 'teleop', '--help'])\nexcept SystemExit: pass\n"
    code += "heavy = {'numpy', 'pinocchio', 'tornado', 'meshcat', 'numba'} & set(sys.modules); assert not heavy, heavy"
    subprocess.run([sys.executable, "-c", code], check=True, capture_output=True)


# The loop, without browser and without waiting: a clock that is ours.


class Wall:
    now = 0.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def ride():
    from urdfkit.sim import Simulator
    from urdfkit.view.server.server import Server

    wall = Wall()
    server = Server("sim", port=0)  # not started: nobody looks
    made = DriveLoop(Simulator("simpleton", note=lambda text: None), server, clock=wall)
    made.wall = wall
    made.server.drive_lock._clock = wall
    made.pace.begin(0.0)
    yield made
    server.stop()


def spend(ride: DriveLoop, seconds: float) -> None:
    for _ in range(round(seconds / FRAME)):
        ride.wall.now += FRAME
        ride.tick()


def test_the_loop_advances_with_the_clock(ride: DriveLoop) -> None:
    spend(ride, 3.0)
    assert ride.simulator.t == pytest.approx(3.0, abs=0.002)


def test_the_loop_lets_the_clock_go_after_a_long_pause_of_the_machine(ride: DriveLoop) -> None:
    spend(ride, 1.0)
    ride.wall.now += 60.0  # the lid was closed
    ride.tick()
    assert ride.simulator.t <= 1.0 + BEHIND + 0.002
    before = ride.simulator.t
    spend(ride, 1.0)
    assert ride.simulator.t - before == pytest.approx(1.0, abs=0.002)


def test_the_robot_moves_while_a_page_drives_and_then_stops(ride: DriveLoop) -> None:
    sent: list = []
    topic = ride.simulator.command_topics[0]
    ride.simulator.subscribe(topic, "geometry_msgs/msg/Twist", sent.append)
    for _ in range(60):
        ride.server.drive_lock.update(1, AHEAD)
        spend(ride, FRAME)
    assert ride.simulator.state.v[0] == pytest.approx(0.5, abs=0.02)
    spend(ride, 2.0)  # the driver states nothing more
    assert abs(ride.simulator.state.v[0]) < 1e-3
    assert sent[-1].linear.x == 0.0
    assert sum(message.linear.x == 0.0 for message in sent) == 1  # said once, then quiet
    assert max(message.linear.x for message in sent) == 0.5


def test_pause_play_reset(ride: DriveLoop) -> None:
    spend(ride, 0.5)
    ride.server.inbox.put_action("pause")
    spend(ride, 0.5)
    assert ride.simulator.t == pytest.approx(0.5, abs=0.02)
    ride.server.inbox.put_action("play")
    spend(ride, 0.5)
    assert ride.simulator.t == pytest.approx(1.0, abs=0.04)
    ride.server.inbox.put_action("reset")
    spend(ride, 0.1)
    assert ride.simulator.t == pytest.approx(0.1, abs=0.02)


def test_a_simulation_that_diverges_pauses_with_an_error(ride: DriveLoop, capfd, monkeypatch) -> None:
    from urdfkit.errors import SimulationError

    def diverge(steps: int) -> None:
        raise SimulationError("the simulation diverged at t = 1 s")

    monkeypatch.setattr(ride.simulator, "step", diverge)
    spend(ride, 2 * FRAME)
    assert ride.simulator.paused
    assert capfd.readouterr().err == "urdfkit: the simulation diverged at t = 1 s\n"


class Calls:
    """Bridges whose peer calls at the third wait; each wait takes as long as it may."""

    def __init__(self, wall: Wall, stop: Event) -> None:
        self.calls = self  # of bridges and queue, what the loop uses
        self.waits: list[float] = []
        self._wall, self._stop = wall, stop

    def wait(self, seconds: float) -> bool:
        self.waits.append(seconds)
        self._wall.now += max(seconds, 1e-4)
        if len(self.waits) == 40:
            self._stop.set()
        return len(self.waits) == 3

    def take(self) -> None:
        pass


@pytest.mark.parametrize("paused", [False, True])
def test_after_a_call_of_a_peer_each_step_is_taken_when_it_is_due(ride: DriveLoop, paused: bool) -> None:
    stop = Event()
    ride.bridges = calls = Calls(ride.wall, stop)  # type: ignore[assignment]
    ride.simulator.paused = paused
    ride.run(stop)
    before, after, later = calls.waits[:3], calls.waits[3:8], calls.waits[-3:]
    assert before == pytest.approx([SERVED] * 3)
    assert max(after) <= (SERVED if paused else ride.simulator.dt) + 1e-9
    assert max(later) > ride.simulator.dt
    assert paused or max(after) < min(before)


def test_what_is_spawned_appears_on_the_page_and_what_is_removed_vanishes() -> None:
    from urdfkit.sim import Simulator
    from urdfkit.view.server.server import Server

    simulator = Simulator("simpleton", note=lambda text: None)
    with Server("sim", port=0) as server:
        ride = DriveLoop(simulator, server)

        def shown() -> set[str]:
            ride.tick()
            done: Future[list[str]] = Future()
            server._post(lambda: done.set_result(list(server.hub._scene)))
            return {path.split("/")[3] for path in done.result(10) if "world%2F" in path}

        ride.show()
        assert shown() == set()
        name = simulator.world.spawn("crate", (2.0, 0.0, 0.0))
        assert shown() == {f"world%2F{name}"}
        simulator.world.remove(name)
        assert shown() == set()


@pytest.mark.browser
def test_the_view_is_of_the_robot_not_of_the_house_around_it(serve, visits, keep, until) -> None:
    page = visits.open(serve("sim", "teleop", "simpleton", "--world", "house").url)
    keep(page, "house")
    robot, everything = page.evaluate("[urdfkit.scene.own.length, urdfkit.scene.nodes.length]")
    assert robot == 7 < everything
    assert 0.2 < page.evaluate("urdfkit.viewport.radius") < 0.6
    far = "urdfkit.viewport.viewer.camera.position.distanceTo(urdfkit.viewport.viewer.controls.target)"
    assert page.evaluate(far) < 5.0
    assert page.evaluate(IN_THE_WAY) == []  # nothing of the house is between camera and robot
    # A wall that comes in between is seen through, until it is no longer in the way.
    build = """([eye]) => { const { scene, viewport, page } = urdfkit; page.following = false;
      const THREE = MeshCat.THREE, { camera, controls } = viewport.viewer;
      const at = scene.own[0].getWorldPosition(new THREE.Vector3());
      const [x, , z] = at.clone().lerp(camera.position, 0.5).toArray();
      return page.connection.request("walls", { corners: [[x - 1, -z - 1], [x + 1, -z + 1]], thickness: 0.05 }); }"""
    name = page.evaluate(build, [None])["name"]
    until(lambda: page.evaluate("urdfkit.scene.faded.size") > 0)
    keep(page, "house-through-a-wall")
    page.evaluate("(name) => urdfkit.connection.request('remove', { name })", name)
    until(lambda: page.evaluate("urdfkit.scene.faded.size") == 0)
    page.keyboard.press("f")
    assert page.evaluate(IN_THE_WAY) == []
    page.locator("#open-camera").click()
    page.get_by_label("Follow", exact=True).check()
    x = page.evaluate(X)
    page.keyboard.down("w")  # the keys drive, though a button of the panel has the focus
    until(lambda: page.evaluate(X) > x + 0.2)
    page.keyboard.up("w")


@pytest.mark.slow
def test_driving_is_recorded_until_it_is_interrupted(serve, tmp_path, until) -> None:
    from rosbags.rosbag2 import Reader

    served = serve("sim", "teleop", "simpleton", "--record", "ride.mcap")
    until(lambda: "Drive with" in served.errors.read_text())
    echo = [sys.executable, "-m", "urdfkit", "topic", "echo", "/clock", "-n", "20"]  # finds it by its note
    env = os.environ | {"XDG_RUNTIME_DIR": str(tmp_path)}
    until(lambda: subprocess.run(echo, env=env, stdout=subprocess.DEVNULL, check=False).returncode == 0)
    served.end()
    assert not list((tmp_path / "urdfkit").glob("running-*.json"))
    assert " topics to ride.mcap" in served.errors.read_text()
    with Reader(tmp_path / "ride.mcap") as reader:
        assert reader.message_count > 10
        assert {"/clock", "/tf", "/simpleton/odom"} <= set(reader.topics)
