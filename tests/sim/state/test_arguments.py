"""What a caller of the library gives wrongly: one line with the value and the nearest right thing, no bare error."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from urdfkit.errors import SimulationError, UnknownNameError, UrdfkitError
from urdfkit.resources import robots_dir
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.state.arguments import ByName, nearest, number, vector


@pytest.fixture(scope="module")
def town() -> Simulator:
    return Simulator("artoo", world=robots_dir() / "artoo/artoo_gazebo/worlds/town.sdf", note=lambda text: None)


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda s: s.world.bodies["crt"], "no body `crt` in the simulation; did you mean `crate`?"),
        (lambda s: s.world.robots["arto"], "no robot `arto` in the simulation; did you mean `artoo`?"),
        (lambda s: s.state.position("hed"), "no joint `hed` in robot `artoo`"),
        (
            lambda s: s.state.velocity("left_wheel_joint"),
            "no joint `left_wheel_joint` in robot `artoo`; did you mean `rear_left_wheel_joint`?",
        ),
        (lambda s: s.state.effort("camera_joint"), "joint `camera_joint` is fixed: it has no single position"),
        (lambda s: s.world.push("crt"), "no body or link `crt` in the simulation; did you mean `crate`?"),
        (lambda s: s.world.pose("town"), "no model or robot `town` in world `town`; did you mean `town_hall`?"),
    ],
)
def test_a_name_that_is_not_there(town: Simulator, ask: Callable[[Simulator], Any], message: str) -> None:
    with pytest.raises(UnknownNameError) as caught:
        ask(town)
    assert str(caught.value) == message
    assert isinstance(caught.value, KeyError)
    assert isinstance(caught.value, SimulationError)


def test_what_there_is_is_listed_where_nothing_is_near(town: Simulator) -> None:
    with pytest.raises(SimulationError, match=r"no body or link `xyz` .*\(available: \w+, \w+, "):
        town.world.push("xyz")
    assert nearest("box", []) == "; none exists"
    assert nearest("box", ["unit_box", "sphere"]) == "; did you mean `unit_box`?"


def test_names_are_a_mapping_all_the_same(town: Simulator) -> None:
    assert town.world.bodies.get("crt") is None
    assert "crt" not in town.world.bodies
    assert ByName("thing", {"a": 1})["a"] == 1


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda: Simulator("simpleton", gravity=-9.81), r"gravity is -9\.81; it must be three finite numbers \[m/s²\]"),  # type: ignore[arg-type]
        (lambda: Simulator("simpleton", gravity=(0, 0)), r"gravity is \(0, 0\); it must be three"),
        (lambda: Simulator("simpleton", dt="fast"), r"the step is 'fast'; it must be a number \[s\]"),  # type: ignore[arg-type]
        (lambda: Simulator("simpleton", seed=-1), r"`-1` is not a valid seed"),
        (lambda: Simulator("simpleton", spawn=(0, 0, 1)), r"`spawn` is \(0, 0, 1\); it must be a Spawn"),  # type: ignore[arg-type]
        (lambda: Simulator("simpleton", spawn=Spawn(x="here")), r"the start pose is \('here', "),  # type: ignore[arg-type]
        (lambda: Simulator("simpleton", spawn=Spawn(twist=3)), r"the initial velocity is 3; "),  # type: ignore[arg-type]
        (lambda: Simulator("simpleton", world="xyz.world"), r"no such file: xyz\.world .*cylinders, empty"),
        (lambda: Simulator("simpleton", world="huse.sdf"), r"no such file: huse\.sdf; did you mean `house`\?"),
    ],
)
def test_an_argument_that_makes_no_sense(ask: Callable[[], Any], message: str) -> None:
    with pytest.raises(UrdfkitError, match=message):
        ask()


@pytest.mark.parametrize(
    ("ask", "message"),
    [
        (lambda s: s.command(0.5, 0.2), r"the linear velocity is 0\.5; it must be three numbers \[m/s\]"),
        (lambda s: s.command((0.5, 0, 0), (0.2,)), r"the angular velocity is \(0\.2,\); .* \[rad/s\]"),
        (lambda s: s.run("x"), r"the time to run for is 'x'"),
        (lambda s: s.at("x", print), r"the time of a call is 'x'"),
        (lambda s: s.every(0.0, print), r"the period is 0 s; it must be greater than zero"),
        (
            lambda s: s.world.bodies["crate"].place((0, 0, 0), twist=3),
            r"the velocity is 3; it must be six finite numbers",
        ),
        (lambda s: s.world.place("crate", (0, 0, 0), twist=3), r"the velocity is 3; it must be six finite numbers"),
    ],
)
def test_a_call_that_makes_no_sense(town: Simulator, ask: Callable[[Simulator], Any], message: str) -> None:
    with pytest.raises(SimulationError, match=message):
        ask(town)


def test_numbers_and_vectors_are_what_they_were() -> None:
    assert number("2.5", "it", "m") == 2.5
    assert vector([1, 2, 3], 3, "it", "m") == (1.0, 2.0, 3.0)


def test_a_limit_is_reported_with_its_unit() -> None:
    arm = Simulator("seven_dof_arm", note=lambda text: None)
    with pytest.raises(SimulationError, match=r"cannot move to 9 rad: its limits are -?[\d.]+ … [\d.]+ rad"):
        arm.motors.hold("elbow_pitch_joint", 9.0)
    with pytest.raises(SimulationError, match=r"cannot move to 9 m: its limits are -?[\d.]+ … [\d.]+ m$"):
        arm.motors.hold("finger_joint1", 9.0)


@pytest.mark.parametrize("value", [[0.0, 0.0], 1.0, None])
@pytest.mark.parametrize("name", ["q", "v"])
def test_an_assignment_to_the_state_names_where_to_set_it(town: Simulator, name: str, value: Any) -> None:
    with pytest.raises(SimulationError, match=rf"^state\.{name} is read-only: set .* with Simulator\(…, spawn=Spawn\("):
        setattr(town.state, name, value)
