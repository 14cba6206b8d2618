"""Requests of the simulation page without a browser: the response to each request and its effect."""

from __future__ import annotations

import json
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

pytest.importorskip("meshcat")
pytest.importorskip("numba")

from urdfkit.app.simulation import loop
from urdfkit.app.simulation.bridging.action_requests import SimulationActions, action_requests
from urdfkit.app.simulation.bridging.service_requests import SimulationServices, service_requests
from urdfkit.app.simulation.clock_rate import FRAME, ClockRate
from urdfkit.app.simulation.features import topic_stream
from urdfkit.app.simulation.features.feature import Feature
from urdfkit.app.simulation.features.message_values import as_json, number_at, numbers_in
from urdfkit.app.simulation.loop import FEATURES, DriveLoop
from urdfkit.errors import SimulationError, UsageError
from urdfkit.messages import from_fields
from urdfkit.sim import Simulator
from urdfkit.view.protocol.page_requests import check
from urdfkit.view.protocol.websocket_messages import Axes, RawRequest


class Wall:
    now = 0.0

    def __call__(self) -> float:
        return self.now


class Page:
    """A server that keeps what it is told, and one page that wants what a test states."""

    def __init__(self) -> None:
        from urdfkit.view.server.drive_lock import DriveLock
        from urdfkit.view.server.request_inbox import Inbox

        self.inbox, self.drive_lock, self.requests = Inbox(), DriveLock(), {}
        self.wanted: set[str] = set()
        self.hub = SimpleNamespace(accepts=lambda key: key in self.wanted, watchers=1)
        self.reported: dict[str, dict[str, Any]] = {}
        self.streamed: list[dict[str, Any]] = []
        self.sensed: dict[str, bytes] = {}
        self.answers: list[tuple[str | None, dict[str, Any]]] = []
        self.files: dict[str, bytes] = {}
        self.poses: tuple[float, Any] = (0.0, None)
        self.geometries = SimpleNamespace(add=lambda mesh: mesh.hash, keep_only=lambda names: None)
        self.shown: list[list[str]] = []

    def __getattr__(self, name: str) -> Any:
        if name == "hub.subscribed_keys":
            return self.wanted
        raise AttributeError(name)

    def send(self, command: Any) -> None:
        command.lower()

    def show(self, *, nodes: list[str], draw: Any, **_: Any) -> None:
        draw(self)
        self.shown.append(nodes)

    def publish(self, t: float, poses: Any) -> None:
        self.poses = t, poses

    def publish_latched(self, type: str, **values: Any) -> None:
        json.dumps(values, allow_nan=False)
        self.reported[type] = values

    broadcast = publish_latched

    def send_to_subscribers(self, key: str, type: str, **values: Any) -> None:
        assert key in self.wanted
        self.publish_latched(type, **values)

    def send_chunk(self, key: str, type: str, **values: Any) -> None:
        json.dumps(values, allow_nan=False)
        self.streamed.append(values)

    def sense(self, key: str, index: int, t: float, kind: int, content: bytes) -> None:
        self.sensed[key] = content

    def answer(self, request: Any, error: str | None = None, **values: Any) -> None:
        json.dumps(values, allow_nan=False)
        self.answers.append((error, values))

    def send_file(self, request: Any, name: str, content: bytes) -> None:
        self.files[name] = content


@pytest.fixture
def made():
    def make(robot: str = "simpleton", **options: Any) -> DriveLoop:
        wall, page = Wall(), Page()
        page.hub.subscribed_keys = page.wanted
        ride = DriveLoop(Simulator(robot, note=lambda _: None, **options), page, clock=wall)  # type: ignore[arg-type]
        ride.wall, ride.page = wall, page  # type: ignore[attr-defined]
        page.drive_lock._clock = wall
        ride.pace.begin(0.0)
        ride.show()
        return ride

    return make


@pytest.fixture
def ride(made):
    return made()


def spend(ride: Any, seconds: float) -> None:
    for _ in range(round(seconds / FRAME)):
        ride.wall.now += FRAME
        ride.tick()


def do(ride: Any, order: str, /, **values: Any) -> dict[str, Any]:
    """Have something done; return the answer's values, or fail with its reason."""
    ride.page.inbox.put_request(check(ride.page.requests, 1, RawRequest(1, order, values)))
    ride.tick()
    error, found = ride.page.answers.pop()
    if error is not None:
        raise SimulationError(error)
    return found


def test_every_part_is_at_work(ride) -> None:
    def below(kind: type) -> set[type]:
        return {kind, *(each for one in kind.__subclasses__() for each in below(one))}

    defined = {each for each in below(Feature) if each.__module__.startswith("urdfkit.app.simulation.")}
    assert defined - {Feature} == set(FEATURES)
    of_commands = {*service_requests(SimulationServices(dict)), *action_requests(SimulationActions(ride.simulator.bus))}
    assert set(ride.page.requests) == {name for part in ride.features for name in part.takes} | of_commands


def test_steps_and_speed(ride) -> None:
    ride.simulator.paused = True
    assert do(ride, "step", steps=7)["time"] == pytest.approx(0.007)
    ride.simulator.paused = False
    with pytest.raises(SimulationError, match="pause it"):
        do(ride, "step", steps=1)
    do(ride, "speed", factor=0.25)
    before = ride.simulator.t
    spend(ride, 2.0)
    assert ride.simulator.t - before == pytest.approx(0.5, abs=0.01)
    assert ride.page.reported["status"]["real_time_factor"] == pytest.approx(0.25, abs=0.02)
    do(ride, "speed", factor=4.0)
    before = ride.simulator.t
    spend(ride, 1.0)
    assert ride.simulator.t - before == pytest.approx(4.0, abs=0.05)


def test_steps_that_would_keep_everybody_waiting_are_done_in_part(ride, monkeypatch) -> None:
    step = ride.simulator.step

    def slow(steps: int) -> None:
        step(steps)
        ride.wall.now += 0.01 * steps

    monkeypatch.setattr(ride.simulator, "step", slow)
    ride.simulator.paused = True
    with pytest.raises(SimulationError, match="100 of 300 steps done"):
        do(ride, "step", steps=300)


def test_orders_that_take_long_are_spread_over_rounds(ride, monkeypatch) -> None:
    take = ride._do

    def slow(request: Any) -> None:
        ride.wall.now += 0.02
        take(order)

    monkeypatch.setattr(ride, "_do", slow)
    for k in range(10):
        order = check(ride.page.requests, 1, RawRequest(k, "get_pose", {"name": "simpleton"}))
        ride.page.inbox.put_request(order)
    ride.tick()
    assert len(ride.page.answers) == 3
    for _ in range(3):
        ride.tick()
    assert len(ride.page.answers) == 10


def test_as_fast_as_it_can_fills_the_round_and_no_more() -> None:
    wall = Wall()
    pace = ClockRate(0.001, wall)
    pace.factor = math.inf
    t = 0.0
    for _ in range(20):
        steps = pace.steps(t)
        pace.took(steps, 2e-6 * steps, t)  # a step takes two microseconds
        t += steps * 0.001
    assert steps == pytest.approx(0.75 * FRAME / 2e-6, rel=0.01)


def test_topics_rates_and_the_last_message(ride) -> None:
    ride.page.wanted |= {"topics", "echo:/simpleton/odom"}
    spend(ride, 4.0)
    rows = {row[0]: row for row in ride.page.reported["topics"]["rows"]}
    _, kind, count, rate, _ = rows["/simpleton/odom"]
    assert kind == "nav_msgs/msg/Odometry"
    assert rate == pytest.approx(ride.simulator.bus.topics[1].count / ride.simulator.t, rel=0.1)
    assert count > 50
    assert all("/msg/" in row[1] for row in rows.values())
    assert ride.page.reported["echo"]["message"]["child_frame_id"]
    with pytest.raises(AssertionError):
        ride.page.send_to_subscribers("other", "x")


def test_publishing_by_a_form(ride) -> None:
    heard: list[Any] = []
    ride.simulator.subscribe("/simpleton/cmd_vel", "geometry_msgs/msg/Twist", heard.append)
    form = do(ride, "form", topic="/simpleton/cmd_vel", type="geometry_msgs/Twist")
    assert form["message"]["linear"] == {"x": 0.0, "y": 0.0, "z": 0.0}
    form["message"]["linear"]["x"] = 0.25
    do(ride, "publish", topic="/simpleton/cmd_vel", type="geometry_msgs/msg/Twist", message=form["message"])
    assert heard[-1].linear.x == 0.25
    for topic, kind, message, line in (
        ("/simpleton/cmd_vel", "std_msgs/msg/Bool", {}, "carries geometry_msgs/msg/Twist"),
        ("/x", "geometry_msgs/msg/Twits", {}, "did you mean"),
        ("/x", "geometry_msgs/msg/Twist", {"liner": {}}, "did you mean `linear`"),
        ("/x", "geometry_msgs/msg/Twist", {"linear": {"x": "fast"}}, "float64"),
        ("/", "geometry_msgs/msg/Twist", {}, "the name of the topic is missing"),
        ("/cmd vel", "geometry_msgs/msg/Twist", {}, "`/cmd vel` is not a topic name"),
        (" simpleton/cmd_vel", "geometry_msgs/msg/Twist", {}, "did you mean `/simpleton/cmd_vel`"),
        ("/1st", "geometry_msgs/msg/Twist", {}, "is not a topic name"),
        ("/x\ty", "geometry_msgs/msg/Twist", {}, "is not a topic name"),
        ("/grüße", "geometry_msgs/msg/Twist", {}, "is not a topic name"),
        ("/x", "std_msgs/msg/UInt8MultiArray", {"data": [2**40]}, "must be uint8, 0 to 255"),
        ("/gazebo/delete_model", "gazebo_msgs/srv/DeleteModel_Request", {}, "is not a message type"),
    ):
        with pytest.raises(SimulationError, match=line):
            do(ride, "publish", topic=topic, type=kind, message=message)


def test_every_type_that_is_published_has_a_form(made) -> None:
    ride = made("seven_dof_arm_with_rgbd")
    ride.simulator.step(100)
    for topic in ride.simulator.bus.topics:
        if "/msg/" in topic.type and "image" not in topic.name and "points" not in topic.name:
            form = do(ride, "form", topic=topic.name, type=topic.type)
            from_fields(topic.type, form["message"])


def test_a_curve_has_every_sample_from_when_it_is_wanted_until_it_is_not(ride) -> None:
    key = "field:/simpleton/odom:pose.pose.position.x"
    ride.page.wanted |= {key, "field:/simpleton/odom:pose.q", "field:/nowhere:x"}
    topic = next(each for each in ride.simulator.bus.topics if each.name == "/simpleton/odom")
    spend(ride, 0.1)
    before = topic.count
    ride.page.streamed.clear()
    for _ in range(60):
        ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0))
        spend(ride, FRAME)
    parts = [part for part in ride.page.streamed if part["curve"] == key]
    t = [each for part in parts for each in part["t"]]
    values = [each for part in parts for each in part["values"]]
    assert t == sorted(t)
    assert len(t) == pytest.approx(topic.count - before, abs=3)
    assert values[-1] > 0.3
    assert topic.subscribers
    ride.page.wanted.clear()
    spend(ride, 0.2)
    assert not topic.subscribers


def test_a_plot_of_an_unknown_topic_is_an_error(ride) -> None:
    ride.page.wanted |= {"field:/simpleton/odom:pose.pose.psition.x", "field:/nowhere:x"}
    spend(ride, 0.3)
    errors = {part["curve"]: part["error"] for part in ride.page.streamed}
    assert "did you mean `position`" in errors["field:/simpleton/odom:pose.pose.psition.x"]
    assert errors["field:/nowhere:x"] == "unknown topic /nowhere"


def test_numbers_of_messages_by_path() -> None:
    message = from_fields("sensor_msgs/msg/JointState", {"name": ["a", "b"], "position": [1.0, 2.0]})
    assert number_at(message, "position[1]") == 2.0
    assert math.isnan(number_at(message, "position[9]"))
    assert "position[1]" in list(numbers_in(message))
    assert "name[0]" not in list(numbers_in(message))
    for path, line in (
        ("position", "not a number"),
        ("name[0]", "not a number"),
        ("positon[0]", "did you mean"),
        ("[x]", "not the path"),
        ("header[0]", "not an array"),
    ):
        with pytest.raises(UsageError, match=line):
            number_at(message, path)


def test_long_messages_are_cut_and_values_that_are_not_finite_are_sent() -> None:
    scan = from_fields("sensor_msgs/msg/LaserScan", {"ranges": [float("inf")] * 1000})
    shown = as_json(scan)
    assert shown["ranges"][0] == "inf"
    assert shown["ranges"][-1] == "… 1000 in all"
    image = from_fields("sensor_msgs/msg/Image", {"data": [0] * 5000})
    assert as_json(image)["data"] == "5000 bytes"
    json.dumps(shown, allow_nan=False)


def test_requests_that_change_nothing_need_no_permission_to_drive(ride) -> None:
    reading = {"actions", "form", "get_pose", "goal_state", "save", "service_type", "services"}
    assert {name for name, schema in ride.page.requests.items() if not schema.changes} == reading


def test_objects_come_move_and_go(ride) -> None:
    first = len(ride.page.shown[-1])
    # Where the kernels are not compiled yet, the first insertion warns about it.
    assert do(ride, "spawn", model="crate", pose=[1.0, 2.0, 0.0, 0.5])["name"] == "crate"
    assert do(ride, "spawn", model="crate", pose=[3.0, 2.0, 0.0]) == {"name": "crate_1"}
    assert len(ride.page.shown[-1]) == first + 2
    where = do(ride, "get_pose", name="crate")["pose"]
    assert where == pytest.approx([1.0, 2.0, where[2], 0, 0, 0.5], abs=1e-3)
    do(ride, "place", name="crate", pose=[-1.0, 0.0, 0.3, 0.0, 0.0, 1.0])
    assert do(ride, "get_pose", name="crate")["pose"][5] == pytest.approx(1.0, abs=0.01)
    assert ride.page.reported["objects"]["objects"][0]["name"] == "simpleton"
    shown = len(ride.page.shown)
    do(ride, "remove", name="crate")
    assert len(ride.page.shown) == shown + 1
    assert do(ride, "restore", name="crate") == {"name": "crate"}
    assert do(ride, "get_pose", name="crate")["pose"] == pytest.approx([-1.0, 0.0, 0.3, 0, 0, 1.0], abs=0.02)
    assert do(ride, "duplicate", name="crate", pose=[5.0, 0.0, 0.3]) == {"name": "crate_2"}
    do(ride, "remove", name="crate")
    for order, values, line in (
        ("remove", {"name": "simpleton"}, "cannot be removed"),
        ("remove", {"name": "crait"}, "did you mean"),
        ("restore", {"name": "crait"}, "was not removed from this world; did you mean `crate`"),
        ("duplicate", {"name": "simpleton", "pose": [0.0, 0.0, 0.0]}, "insert another one from the library"),
        ("spawn", {"model": "crait"}, "did you mean `crate`"),
        ("spawn", {"model": "../../etc/passwd"}, "unknown model or robot"),
        ("spawn", {"model": "model://crate"}, "unknown model or robot"),
        ("spawn", {"model": "/etc"}, "unknown model or robot"),
    ):
        with pytest.raises(SimulationError, match=line):
            do(ride, order, **values)


@pytest.mark.parametrize(("rest", "heading"), [((), 0.0), ((0.5,), 0.5), ((0.3, 0.2, 0.7), 0.7), ((0.2, 0.1), 0.0)])
def test_a_robot_from_the_library_stands_on_the_ground_with_the_heading_of_its_pose(ride, rest, heading: float) -> None:
    do(ride, "spawn", model="mybot", pose=[2.0, 1.0, 3.0, *rest], name="other")
    x, y, z, *angles = do(ride, "get_pose", name="other")["pose"]
    assert (x, y, *angles) == pytest.approx((2.0, 1.0, 0.0, 0.0, heading), abs=1e-3)
    assert z < 0.5


def test_what_comes_and_goes_for_an_hour_leaves_nothing_behind() -> None:
    from urdfkit.view.server.server import Server

    server = Server("sim", port=0)  # not started: nobody looks, but what is kept for pages is kept
    ride = DriveLoop(Simulator("simpleton", note=lambda _: None), server, clock=Wall())
    try:
        ride.show()
        sizes = []
        for k in range(6):
            for model in ("coke_can", "chair", "crate"):
                ride.simulator.world.spawn(model, (2.0, 0.3 * k, 0.0), name=model)
                ride.tick()
            for model in ("coke_can", "chair", "crate"):
                ride.simulator.world.remove(model)
                ride.tick()
            loop = server._thread.loop
            loop.call_soon(loop.stop)
            loop.run_forever()  # what was posted is done
            kept = sum(len(frame) for frame in server.hub.snapshot())
            sizes.append((len(server.hub._scene), len(server.geometries), kept // 64))
        assert len(set(sizes[1:])) == 1
    finally:
        server.stop()


def test_a_pose_frame_of_thirty_links_is_below_a_kilobyte() -> None:
    from urdfkit.view.protocol.websocket_messages import pack_poses

    assert len(pack_poses(1, 0.0, np.zeros((30, 7)))) == 856


def test_what_stands_and_is_moved_is_not_drawn_again(ride) -> None:
    do(ride, "walls", corners=[[2, 0], [4, 0]])
    shown = len(ride.page.shown)
    do(ride, "place", name="walls", pose=[0.0, 1.0, 0.0])
    assert len(ride.page.shown) == shown
    names = [name.rpartition("%2F")[2] for name in ride.page.shown[-1]]
    assert ride.page.poses[1][names.index("walls")][1] == pytest.approx(1.0)


def test_walls_have_doors_one_can_drive_through(ride) -> None:
    do(ride, "walls", corners=[[1, -2], [1, 2]], doors=[{"segment": 0, "at": 2.0, "width": 1.0}], height=2.4)
    for _ in range(300):
        ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0))
        spend(ride, FRAME)
    assert ride.simulator.state.base_pose[0] > 1.8  # through the door
    ride._act("reset")
    do(ride, "place", name="simpleton", pose=[0.0, 1.5, ride.simulator.state.base_pose[2]])
    for _ in range(300):
        ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0))
        spend(ride, FRAME)
    assert ride.simulator.state.base_pose[0] < 1.0  # against the wall


def test_the_world_is_saved_as_it_is(ride, tmp_path) -> None:
    do(ride, "spawn", model="crate", pose=[1.0, 2.0, 0.0])
    spend(ride, 0.5)
    assert do(ride, "save", name="my world/..")["bytes"] > 500
    ((name, content),) = ride.page.files.items()
    assert name == "my_world___.sdf"
    (tmp_path / name).write_bytes(content)
    again = Simulator("simpleton", world=tmp_path / name, note=lambda _: None)
    assert again.world.pose("crate")[:2] == pytest.approx((1.0, 2.0), abs=0.01)


def test_arms_go_where_their_sliders_are_put(made) -> None:
    ride = made("rrbot")
    rows = {row["name"]: row for row in ride.page.reported["arms"]["arms"]}
    name = next(name for name in rows if "joint1" in name)
    joint = rows[name]["joints"][0]
    assert rows[name]["of"] == "position"
    ride.page.wanted.add("arms")
    do(ride, "arm", controller=name, joint=joint["name"], value=0.5)
    spend(ride, 4.0)
    now = ride.page.reported["arms_now"]["values"][name][joint["name"]]
    assert now == pytest.approx(0.5, abs=0.15)  # its PID has no integral: gravity pulls it a little off
    do(ride, "controller", controller=name, running=False)
    assert not {row["name"]: row for row in ride.page.reported["arms"]["arms"]}[name]["running"]
    with pytest.raises(SimulationError, match="unknown joint"):
        do(ride, "arm", controller=name, joint="nothing", value=0.5)


@pytest.mark.slow
def test_a_trajectory_controller_takes_sliders_too(made) -> None:
    ride = made("seven_dof_arm")
    arms = ride.page.reported["arms"]["arms"]
    assert arms
    for row in arms:
        joint = row["joints"][0]
        goal = 0.3 * joint["upper"] + 0.7 * joint["lower"] if row["of"] == "position" else 0.0
        do(ride, "arm", controller=row["name"], joint=joint["name"], value=goal)
        if row["of"] == "position":
            spend(ride, 6.0)
            assert ride.simulator.state.position(joint["name"]) == pytest.approx(goal, abs=0.1)


def test_gravity_mass_friction_and_gains(made) -> None:
    ride = made("rrbot")
    do(ride, "gravity", gravity=[0, 0, -1.6])
    assert ride.page.reported["parameters"]["gravity"] == [0.0, 0.0, -1.6]
    row = next(row for row in ride.page.reported["parameters"]["rows"] if row["mass"] is not None)
    do(ride, "mass", name=row["name"], link=row["link"], mass=3.5)
    assert any(each["mass"] == 3.5 for each in ride.page.reported["parameters"]["rows"])
    path = ride.page.reported["parameters"]["gains"][0]["path"]
    do(ride, "gains", path=path, p=50, i=0, d=1)
    assert ride.page.reported["parameters"]["gains"][0]["p"] == 50.0
    with pytest.raises(SimulationError, match="no link `nothing`"):
        do(ride, "mass", name=row["name"], link="nothing", mass=1)


def test_a_robot_without_plugins_is_a_robot_if_it_was_loaded_first(made, tmp_path) -> None:
    inertial = '<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    box = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
    (tmp_path / "sled.urdf").write_text(f'<robot name="sled"><link name="base">{inertial}{box}</link></robot>')
    ride = made(str(tmp_path / "sled.urdf"))
    do(ride, "spawn", model="barrel", pose=[3.0, 0.0, 0.0, 0.0])
    spend(ride, 1.0)
    reported = ride.page.reported
    assert reported["teleop"]["robots"] == [{"name": "sled", "drives": False}]
    assert [*reported["status"]["robots"]] == ["sled"]
    objects = {row["name"]: (row["robot"], row["first"]) for row in reported["objects"]["objects"]}
    assert (objects["sled"], objects["barrel"]) == ((True, True), (False, False))
    rows = [(row["name"], row["link"], row["mass"]) for row in reported["parameters"]["rows"]]
    assert ("sled", "base", 2.0) in rows
    assert [row[:2] for row in rows if row[0] == "barrel"] == [("barrel", "")]


def test_a_push_lasts_as_long_as_it_is_held(ride) -> None:
    name = do(ride, "spawn", model="ball", pose=[2.0, 0.0, 3.0])["name"]
    mass = next(row["mass"] for row in ride.page.reported["parameters"]["rows"] if row["name"] == name)
    do(ride, "gravity", gravity=[0, 0, 0])
    before = ride.simulator.world.bodies[name].twist[0]
    centre = list(ride.simulator.world.bodies[name].body.centre)
    push = {"link": name, "force": [mass, 0, 0], "torque": [0, 0, 0], "at": centre}
    do(ride, "push", **push)
    spend(ride, 1.0)
    gained = ride.simulator.world.bodies[name].twist[0] - before
    assert gained == pytest.approx(0.3, abs=0.005)  # 0.3 s of 1 m/s², then nobody held it any more
    do(ride, "push", **push)
    do(ride, "release")
    spend(ride, 0.5)
    assert ride.simulator.world.bodies[name].twist[0] - before == pytest.approx(gained, abs=0.06)
    with pytest.raises(SimulationError, match="did you mean"):
        do(ride, "push", link="chasis", force=[0, 0, 1], torque=[0, 0, 0], at=[0, 0, 0])


def test_forces_and_slip_are_sent_while_requested(ride) -> None:
    do(ride, "spawn", model="crate", pose=[2.0, 2.0, 0.0])  # which touches the ground, but is no robot
    spend(ride, 0.5)
    assert not ride.page.sensed
    ride.page.wanted |= {"contacts", "slip"}
    spend(ride, 0.5)
    forces = np.frombuffer(ride.page.sensed["contacts"], "<f4").reshape(-1, 6)
    assert forces[:, 5].sum() == pytest.approx(1.55 * 9.81, rel=1e-3)
    assert {link for link, _ in ride.page.reported["slip"]["rows"]} == {"left_wheel", "right_wheel", "caster"}
    ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0))
    spend(ride, 0.3)
    slip = dict(ride.page.reported["slip"]["rows"])
    assert slip["caster"] > 0.1 > 10 * slip["left_wheel"]  # the caster slides, the wheels roll


def test_motion_is_recorded_and_shown_again(ride) -> None:
    with pytest.raises(SimulationError, match="nothing has been recorded"):
        do(ride, "replay", action="play")
    do(ride, "record", on=True)
    begun = ride.simulator.t
    for _ in range(120):
        ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.5, 1.0))
        spend(ride, FRAME)
    there = float(ride.page.poses[1][0][0])
    do(ride, "record", on=False)
    assert ride.page.reported["recorder"]["frames"] == pytest.approx(120, abs=5)
    do(ride, "replay", action="show", at=begun)
    assert ride.page.poses[1][0][0] == pytest.approx(0.0, abs=0.02)
    now = ride.simulator.t
    do(ride, "replay", action="play", speed=2.0)
    spend(ride, 0.5)
    half = ride.page.poses[1][0][0]
    assert 0.2 * there < half < 0.8 * there
    spend(ride, 1.0)
    assert ride.page.poses[1][0][0] == pytest.approx(there, abs=0.05)
    assert ride.simulator.t == now  # the simulation waited
    do(ride, "replay", action="end")
    spend(ride, 0.1)
    assert ride.simulator.t > now


def test_a_recording_ends_when_something_comes_or_time_begins_anew(ride) -> None:
    do(ride, "record", on=True)
    spend(ride, 0.2)
    do(ride, "spawn", model="crate", pose=[2, 0, 0])
    assert "an entity was spawned or removed" in ride.page.reported["notice"]["text"]
    with pytest.raises(SimulationError, match="entities were spawned or removed"):
        do(ride, "replay", action="play")
    do(ride, "record", on=True)
    spend(ride, 0.2)
    ride._act("reset")
    spend(ride, 0.1)
    assert "the simulation was reset" in ride.page.reported["notice"]["text"]


def test_a_tape_has_an_end(ride, monkeypatch) -> None:
    from urdfkit.app.simulation.features import replay

    monkeypatch.setattr(replay, "MOST_BYTES", 20_000)
    do(ride, "record", on=True)
    spend(ride, 3.0)
    assert "the memory limit was reached" in ride.page.reported["notice"]["text"]
    assert not ride.page.reported["recorder"]["recording"]


def test_topics_are_recorded_to_a_file_that_the_page_gets(ride, tmp_path, monkeypatch) -> None:
    from rosbags.rosbag2 import Reader

    do(ride, "record", on=True, topics=True)
    spend(ride, 0.5)
    done = do(ride, "record", on=False)
    (tmp_path / "a.mcap").write_bytes(ride.page.files["simpleton.mcap"])
    with Reader(tmp_path / "a.mcap") as reader:
        assert reader.message_count == done["messages"] > 20
        assert not any("image_raw" in topic for topic in reader.topics)
        assert reader.topics["/robot_description"].msgcount == 1
    do(ride, "record", on=True, topics=True, pictures=True)
    spend(ride, 0.1)
    assert do(ride, "record", on=False)["messages"] > 5
    (tmp_path / "b.mcap").write_bytes(ride.page.files["simpleton.mcap"])
    with Reader(tmp_path / "b.mcap") as reader:
        assert any("image_raw" in topic for topic in reader.topics)
    monkeypatch.chdir(tmp_path)
    do(ride, "record", on=True, topics=True)
    spend(ride, 0.2)
    ride.replay.close()  # as at the end of the program
    assert (tmp_path / "simpleton.mcap").stat().st_size > 1000


def test_several_robots_are_driven_one_at_a_time(ride) -> None:
    name = do(ride, "spawn", model="mybot", pose=[2.0, 2.0, 0.0, 0.0])["name"]
    assert {robot["name"] for robot in ride.page.reported["teleop"]["robots"]} == {"simpleton", name}
    before = ride.simulator.world.pose(name)[0]
    for _ in range(60):
        ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.4, 1.0, name))
        spend(ride, FRAME)
    assert ride.simulator.world.pose(name)[0] > before + 0.1
    assert abs(ride.simulator.state.base_pose[0]) < 0.01
    ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.4, 1.0))
    spend(ride, 2.0)
    assert abs(ride.simulator.world.robots[name].state.base_velocity[0]) < 0.02  # the other one was told to stop
    ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.4, 1.0, "nobody"))
    spend(ride, 0.1)  # harmless


def test_stop_ends_what_a_published_command_began(ride) -> None:
    message = {"linear": {"x": 0.3}}
    do(ride, "publish", topic="/simpleton/cmd_vel", type="geometry_msgs/msg/Twist", message=message)
    spend(ride, 1.0)
    assert ride.simulator.state.v[0] == pytest.approx(0.3, abs=0.02)
    ride.page.inbox.put_action("stop")
    spend(ride, 1.0)
    assert abs(ride.simulator.state.v[0]) < 0.01
    assert not ride.simulator.paused


def test_stop_holds_for_every_robot_whoever_drives(ride) -> None:
    name = do(ride, "spawn", model="mybot", pose=[2.0, 2.0, 0.0, 0.0])["name"]
    heard: dict[str, list[float]] = {}
    for robot in ride.simulator.world.robots.values():
        for topic, kind in loop.command_topics(robot).items():
            speeds = heard[robot.name] = []
            ride.simulator.subscribe(topic, kind, lambda sent, speeds=speeds: speeds.append(sent.linear.x))
    ride.page.drive_lock.update(1, Axes((1.0, 0.0, 0.0, 0.0), 0.4, 1.0, name))
    spend(ride, FRAME)
    assert heard[name] == [0.4]
    ride.page.inbox.put_action("stop")
    spend(ride, FRAME)
    assert heard == {"simpleton": [0.0], name: [0.4, 0.0]}
    assert ride.page.drive_lock.holder is None
    assert "stop" in ride.page.reported  # the pages let go


def test_overlap_of_a_spawned_body_is_reported_each_time(ride) -> None:
    for _ in range(2):
        done = do(ride, "spawn", model="barrel", pose=[0.0, 0.1, 0.0, 0.0])
        assert any("inside `chassis`; place `barrel` elsewhere" in remark for remark in done["warnings"])
        assert ride.page.reported["notice"]["tone"] == "warning"
        assert "warnings" not in do(ride, "remove", name="barrel")
    done = do(ride, "walls", corners=[[-1.0, 0.0], [1.0, 0.0]])
    assert any("`walls` starts 200 mm inside `chassis`" in remark for remark in done["warnings"])
    assert "warnings" not in do(ride, "walls", corners=[[-1.0, 3.0], [1.0, 3.0]])


@pytest.mark.slow
def test_random_orders_never_break_the_loop(ride) -> None:
    import random

    chance = random.Random(11)
    texts = ["simpleton", "crate", "", "chassis", "nothing", "/x", "/simpleton/odom", "nav_msgs/msg/Odometry", "play"]

    def anything() -> Any:
        kind = chance.randrange(6)
        if kind == 0:
            return chance.choice(texts)
        if kind == 1:
            return chance.choice([0, 1, 2, 0.5, -1, 1e5])
        if kind == 2:
            return chance.choice([True, False])
        if kind == 3:
            return [chance.uniform(-2, 2) for _ in range(chance.choice([2, 3, 7]))]
        return {} if kind == 4 else [[0, 0], [chance.uniform(-3, 3), 1]]

    from urdfkit.view.protocol.websocket_messages import ProtocolError

    done = 0
    for _ in range(3000):
        name = chance.choice([each for each in ride.page.requests if each not in ("spawn", "save")])
        schema = ride.page.requests[name]
        keys = [*schema.values, *(key for key in schema.optional if chance.random() < 0.3)]
        try:
            order = check(ride.page.requests, 1, RawRequest(1, name, {key: anything() for key in keys}))
        except ProtocolError:
            continue
        ride.page.inbox.put_request(order)
        ride.wall.now += FRAME
        ride.tick()
        done += 1
    assert done > 200
    assert loop.FEATURES


def test_after_a_divergence_nothing_falls_over_and_reset_starts_again(ride) -> None:
    ride.simulator.world.builder.engine.arrays["v"][:] = 1e200
    spend(ride, 0.1)
    assert "diverged" in ride.page.reported["fault"]["message"]
    with pytest.raises(SimulationError, match="press Reset"):
        do(ride, "gravity", gravity=[0, 0, 0])
    ride.page.inbox.put_action("play")
    spend(ride, 0.1)
    assert ride.simulator.paused
    ride.page.inbox.put_action("reset")
    spend(ride, 0.2)
    assert ride.page.reported["fault"]["message"] is None
    assert ride.simulator.t == pytest.approx(0.2, abs=0.03)


def test_a_fault_in_an_order_is_answered_in_a_line(ride) -> None:
    with pytest.raises(SimulationError) as caught:
        do(ride, "place", name="nothing", pose=[0, 0, 0])
    assert "\n" not in str(caught.value)


def test_every_message_is_sent_to_a_page_that_requests_all(ride) -> None:
    odom = next(topic for topic in ride.simulator.bus.topics if topic.name == "/simpleton/odom")
    before = len(odom.subscribers)
    keys = {f"{kind}:/simpleton/odom": [] for kind in ("times", "sizes", "messages", "full_messages")}
    ride.page.wanted |= {*keys, "messages:/nowhere"}
    ride.tick()
    assert len(odom.subscribers) == before + 4
    count = odom.count
    spend(ride, 0.5)
    for part in ride.page.streamed:
        assert part["missed"] == 0
        assert part["rows"]  # nothing is sent without a message
        keys[part["source"]] += part["rows"]
    assert odom.count - count - 5 <= len(keys["times:/simpleton/odom"]) <= odom.count - count
    times, sizes, every, _ = keys.values()
    assert np.diff([t for t, _ in times]) == pytest.approx(0.01)
    assert [row[:2] for row in every] == times
    assert {size for _, _, size in sizes} == {sizes[0][2]}
    assert all(message["child_frame_id"] == "base_footprint" for _, _, message in every)
    ride.page.wanted.clear()
    ride.tick()
    assert len(odom.subscribers) == before


def test_messages_for_which_there_is_no_time_are_counted(ride, monkeypatch) -> None:
    """Putting one into words takes ten milliseconds; a quarter of the time is what may be spent."""

    def slowly(message: Any, long: int) -> Any:
        ride.wall.now += 0.01
        return {"long": long}

    monkeypatch.setattr(topic_stream, "as_json", slowly)
    odom = next(topic for topic in ride.simulator.bus.topics if topic.name == "/simpleton/odom")
    ride.page.wanted.add("full_messages:/simpleton/odom")
    ride.tick()
    begin, count = ride.wall.now, odom.count
    spend(ride, 4.0)
    ride.simulator.paused = True
    spend(ride, 0.1)
    rows = [row for part in ride.page.streamed for row in part["rows"]]
    missed = sum(part["missed"] for part in ride.page.streamed)
    assert len(rows) + missed == odom.count - count
    assert len(rows) * 0.01 == pytest.approx(0.25 * (ride.wall.now - begin), rel=0.1)
    assert rows[0][2] == {"long": topic_stream.ALL}


def test_repairs_are_findings_on_the_page(made, tmp_path) -> None:
    path = tmp_path / "cart.urdf"
    ball = '<collision><geometry><sphere radius="0.1"/></geometry></collision>'
    inertia = '<mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>'
    path.write_text(
        f'<robot name="cart"><link name="base"><inertial>{inertia}</inertial>{ball}</link>\n'
        f'<link name="wheel">{ball}</link>\n'
        '<joint name="axle" type="continuous"><parent link="base"/><child link="wheel"/><axis xyz="0 1 0"/></joint>'
        "</robot>"
    )
    (row,) = made(str(path)).page.reported["findings"]["findings"]
    assert (row["code"], row["severity"], row["link"], row["line"]) == ("I511", "warning", "wheel", 2)
    assert row["lines"] == [f'<link name="wheel">{ball}</link>']
    assert made().page.reported["findings"]["findings"] == []
