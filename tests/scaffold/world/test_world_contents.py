"""What `urdfkit new world` writes: sdformat reads it, robots get through it, the same answers give the same bytes."""

import itertools
import math

import numpy as np
import pytest

from urdfkit.cli import main
from urdfkit.description.sdf import load_world
from urdfkit.description.urdf.robot import Box
from urdfkit.errors import UsageError
from urdfkit.resources import templates_dir
from urdfkit.scaffold import computed, load_template
from urdfkit.scaffold.world.floor_layouts import house, office, one_room
from urdfkit.scaffold.world.floor_plan import wall_shapes
from urdfkit.scaffold.world.furniture import PIECES, furnish
from urdfkit.scaffold.world.obstacles import clutter
from urdfkit.scaffold.world.random_numbers import Random
from urdfkit.scaffold.world.shapes import ModelShape, inertia
from urdfkit.sim import Simulator

TEMPLATE = load_template(templates_dir() / "world")
KINDS = ("room", "office", "house", "clutter")


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_walls_leave_out_their_doors_below_the_lintels():
    walls = one_room(4.0, 3.0, doors=6, door_width=0.8, thickness=0.1).walls
    shapes = wall_shapes(walls, thickness=0.1, height=2.5, door_width=0.8)
    for number, wall in enumerate(walls, 1):
        parts = {
            kind: [each for each in shapes if each.name.startswith(f"{kind}_{number}_")] for kind in ("wall", "lintel")
        }
        along = 1 if wall.axis else 0
        solid = sum(each.size[along] for each in parts["wall"])
        assert solid == pytest.approx(wall.end - wall.start - 0.8 * len(wall.doors))
        assert [each.size[along] for each in parts["lintel"]] == pytest.approx([0.8] * len(wall.doors))
        assert [each.centre[along] for each in parts["lintel"]] == pytest.approx(wall.doors)
        tops = {each.centre[2] + each.size[2] / 2 for kind in parts for each in parts[kind]}
        assert tops == {2.5}


def test_doors_of_a_room_are_in_the_middle_of_free_stretches():
    plan = one_room(4.0, 3.0, doors=6, door_width=0.8, thickness=0.1)
    assert [(room.x, room.y) for room in plan.rooms] == [((-2.0, 2.0), (-1.5, 1.5))]
    assert [(wall.axis, wall.at) for wall in plan.walls] == [(1, -2.0), (1, 2.0), (0, -1.5), (0, 1.5)]
    second = -(0.4 + 1.5 - 0.05) / 2  # between the first door and the end of the wall
    assert [wall.doors for wall in plan.walls] == [pytest.approx((second, 0.0))] * 2 + [(0.0,)] * 2


def test_rooms_of_an_office_share_the_length_on_both_sides_of_the_corridor():
    plan = office(10.0, 8.0, rooms=5, doors=1, door_width=0.8, thickness=0.1)
    corridor, *rooms = plan.rooms
    assert (corridor.x, corridor.y) == ((-5.0, 5.0), (-rooms[0].y[0], rooms[0].y[0]))
    thirds = [-5.0, -5.0 / 3, 5.0 / 3, 5.0]
    assert [end for room in rooms for end in room.x] == pytest.approx(
        [*itertools.chain(*itertools.pairwise(thirds)), -5.0, 0.0, 0.0, 5.0]
    )
    assert [room.y[1] for room in rooms[:3]] + [room.y[0] for room in rooms[3:]] == [4.0] * 3 + [-4.0] * 2
    assert [wall.doors for wall in plan.walls if wall.axis == 0 and abs(wall.at) < 4.0] == [
        pytest.approx((-10.0 / 3, 0.0, 10.0 / 3)),
        pytest.approx((-2.5, 2.5)),
    ]


@pytest.mark.parametrize("doors", range(5))
def test_the_first_doors_of_an_office_are_at_the_ends_of_its_corridor(doors):
    plan = office(10.0, 8.0, rooms=5, doors=doors, door_width=0.8, thickness=0.1)
    ends = [wall.doors for wall in plan.walls if wall.axis == 1 and abs(wall.at) == 5.0]
    assert [0.0 in places for places in ends] == [doors > 0, doors > 1]
    outer = [wall for wall in plan.walls if abs(wall.at) == (5.0 if wall.axis else 4.0)]
    assert sum(len(wall.doors) for wall in outer) == doors


@pytest.mark.parametrize("seed", range(3))
def test_furniture_stands_in_its_room_with_its_back_to_a_wall(seed):
    plan = house(12.0, 9.0, rooms=5, doors=1, door_width=0.9, thickness=0.1, random=Random(seed))
    pieces = furnish(plan, door_width=0.9, thickness=0.1, clear_radius=0.5, random=Random(seed))
    assert len(pieces) > 4
    for piece in pieces:
        x, y, yaw = piece.place
        along, depth = PIECES[piece.name.rpartition("_")[0]][0]
        (room,) = (each for each in plan.rooms if each.x[0] < x < each.x[1] and each.y[0] < y < each.y[1])
        size = (depth, along) if round(yaw / (math.pi / 2)) % 2 else (along, depth)
        gaps = [
            gap
            for middle, length, (low, high) in zip((x, y), size, (room.x, room.y), strict=True)
            for gap in (middle - length / 2 - low, high - middle - length / 2)
        ]
        side = (3, 0, 2, 1)[round(yaw / (math.pi / 2))]  # of its back: the gaps are those at -x, +x, -y, +y
        assert gaps[side] == pytest.approx(0.06, abs=1e-3)
        assert min(gaps) > 0.049


def new(name, *options):
    return main(["new", "world", name, *options, "--yes"])


def refusal(capsys, *options):
    assert new("lab", *options) == 2
    reported = capsys.readouterr().err
    assert reported.count("\n") == 1
    return reported


def free_space(path, radius, cell=0.1):
    """Return where the middle of a round robot may be, on a grid about the origin, and what it reaches from there."""
    world = load_world(path)
    n = 90
    axis = (np.arange(2 * n + 1) - n) * cell
    x, y = np.meshgrid(axis, axis, indexing="ij")
    free = np.ones_like(x, dtype=bool)
    for model in world.models:
        mx, my, _, _, _, yaw = (*model.pose.xyz, *model.pose.rpy)
        for shape in (shape for link in model.links for shape in link.collisions):
            dx, dy = x - mx, y - my
            lx, ly = dx * math.cos(yaw) + dy * math.sin(yaw), dy * math.cos(yaw) - dx * math.sin(yaw)
            lx, ly = lx - shape.pose.xyz[0], ly - shape.pose.xyz[1]
            geometry = shape.geometry
            if shape.name.startswith("lintel") or not isinstance(geometry, Box):
                continue
            half = np.array(geometry.size) / 2
            free &= np.hypot(np.maximum(abs(lx) - half[0], 0), np.maximum(abs(ly) - half[1], 0)) >= radius
    reached = np.zeros_like(free)
    edge = [(n, n)]
    while edge:
        i, j = edge.pop()
        if 0 <= i < len(axis) and 0 <= j < len(axis) and free[i, j] and not reached[i, j]:
            reached[i, j] = True
            edge += [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
    return axis, free, reached


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_answers_give_the_same_bytes(place, kind):
    for folder in ("one", "two"):
        assert new("lab", "--kind", kind, "--into", folder) == 0
    assert (place / "one/lab.sdf").read_bytes() == (place / "two/lab.sdf").read_bytes()


def test_another_seed_is_another_world(place):
    for seed in ("1", "2"):
        assert new(f"lab{seed}", "--kind", "house", "--seed", seed) == 0
    assert (place / "lab1.sdf").read_text().replace("lab1", "lab2") != (place / "lab2.sdf").read_text()


def test_random_numbers_are_the_same_for_ever():
    random_numbers = Random(0)
    assert [random_numbers.between(0, 1), random_numbers.between(-1, 1)] == [
        0.8444218515250481,
        2 * 0.7579544029403025 - 1,
    ]


@pytest.mark.slow
def test_the_real_sdformat_reads_them(place, sdformat):
    files = []
    for kind, version in itertools.product(KINDS, ("1.6", "1.9")):
        name = f"{kind}_{version.replace('.', '_')}"
        assert new(name, "--kind", kind, "--sdf-version", version, *(["--loose"] * (kind == "clutter"))) == 0
        files.append(place / f"{name}.sdf")
    assert new("old", "--kind", "house", "--sim", "classic") == 0
    lines = sdformat(*files, place / "old.world")
    assert [line for line in lines if line[0] == "error"] == []
    assert len(lines) > 100


@pytest.mark.parametrize("kind", KINDS)
def test_a_robot_drives_in_it(place, kind):
    assert new("lab", "--kind", kind, *(["--loose"] * (kind == "clutter"))) == 0
    simulator = Simulator("simpleton", world=str(place / "lab.sdf"), note=lambda _: None)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(1.5)
    assert simulator.link_poses()[0, :2] == pytest.approx([0.44, 0], abs=0.02)


@pytest.mark.parametrize(
    ("kind", "rooms", "seed"), [("office", 8, 0), *(("house", n, s) for n in (4, 7) for s in range(4))]
)
def test_every_room_is_reached(place, kind, rooms, seed):
    options = ["--kind", kind, "--rooms", str(rooms), "--seed", str(seed), "--doors", "2", "--length", "11"]
    assert new("lab", *options) == 0
    axis, free, reached = free_space(place / "lab.sdf", radius=0.25)
    assert reached[len(axis) // 2, len(axis) // 2]
    # What is free and not reached is no more than slits that a robot of this size is alone in.
    assert (free & ~reached).sum() < 0.01 * reached.sum()


def test_obstacles_are_apart_and_the_origin_is_free():
    things = clutter(6, 5, count=60, largest=0.5, movable=True, clear_radius=0.8, random=Random(3))
    circles = []
    for thing in things:
        (shape,) = thing.shapes
        x, y, _ = thing.place
        radius = math.hypot(*shape.size[:2]) / 2 if shape.kind == "box" else shape.size[0]
        assert math.hypot(x, y) - radius >= 0.8
        assert abs(x) + radius <= 3 + 1e-9
        assert abs(y) + radius <= 2.5 + 1e-9
        circles.append((x, y, radius))
    for (x, y, r), (a, b, s) in itertools.combinations(circles, 2):
        assert math.hypot(x - a, y - b) >= r + s
    assert len({thing.name for thing in things}) == 60


def test_the_shapes_weigh_as_solids_do():
    assert inertia(ModelShape("a", "box", (1, 2, 3), (0, 0, 0), (1, 1, 1)), 12) == (13, 10, 5)
    assert inertia(ModelShape("a", "cylinder", (1, 2), (0, 0, 0), (1, 1, 1)), 12) == (7, 7, 6)
    assert inertia(ModelShape("a", "sphere", (1,), (0, 0, 0), (1, 1, 1)), 10) == (4, 4, 4)


@pytest.mark.parametrize("doors", [0, 1, 4, 9])
def test_as_many_doors_as_asked_for(doors):
    sizes = {"doors": doors, "door_width": 0.9, "thickness": 0.15}
    plans = [
        one_room(8, 6, **sizes),
        office(12, 9, rooms=6, **sizes),
        house(12, 9, rooms=5, random=Random(doors), **sizes),
    ]
    inner = (0, 6, 4)
    for plan, inside in zip(plans, inner, strict=True):
        assert sum(len(wall.doors) for wall in plan.walls) == doors + inside
        for wall in plan.walls:
            assert all(b - a >= 0.9 for a, b in itertools.pairwise(wall.doors))
            assert all(wall.start + 0.45 <= door <= wall.end - 0.45 for door in wall.doors)


def test_lintels_are_above_doors_only(place):
    assert new("lab", "--doors", "3") == 0
    assert (place / "lab.sdf").read_text().count('_collision">') == 4 + 3 + 3
    assert new("low", "--doors", "3", "--height", "0.5") == 0
    assert "lintel" not in (place / "low.sdf").read_text()


@pytest.mark.parametrize(
    ("options", "says"),
    [
        (["--kind", "ofice"], "did you mean `office`?"),
        (["--knid", "office"], "did you mean `--kind`?"),
        (["--kind", "clutter", "--count", "2.5"], "--count 2.5 is not an integer"),
        (["--kind", "clutter", "--count", "900"], "no room for --count 900"),
        (["--kind", "clutter", "--doors", "2"], "--doors requires --kind room or office or house"),
        (["--doors", "40"], "no room for --doors 40"),
        (["--kind", "house", "--rooms", "40"], "no room for --rooms 40"),
        (["--kind", "office", "--width", "5"], "no room for a corridor and --rooms 6"),
        (["--length", "0.6"], "a wall is shorter than its door"),
        (["--sim", "classic", "--sdf-version", "1.9"], "Gazebo Classic supports SDF 1.6 and 1.7 only"),
    ],
)
def test_what_cannot_be_is_refused_and_nothing_written(place, capsys, options, says):
    assert says in refusal(capsys, *options)
    assert list(place.iterdir()) == []


@pytest.mark.parametrize(
    ("sim", "file", "plugin"),
    [("gz", "lab.sdf", "gz-sim-physics-system"), ("fortress", "lab.sdf", "ignition-gazebo-physics-system")],
)
def test_each_gazebo_has_its_plugins(place, sim, file, plugin):
    assert new("lab", "--sim", sim) == 0
    text = (place / file).read_text()
    assert f'filename="{plugin}"' in text
    assert "@" not in text


def test_gazebo_classic_has_its_own(place):
    assert new("lab", "--sim", "classic") == 0
    text = (place / "lab.world").read_text()
    assert "<plugin" not in text
    assert "model://ground_plane" in text


def test_nothing_is_overwritten(place, capsys):
    (place / "lab.sdf").write_text("mine")
    assert "lab.sdf already exists" in refusal(capsys)
    assert (place / "lab.sdf").read_text() == "mine"


def test_the_title_says_what_is_in_it():
    answers = TEMPLATE.answers({"name": "lab", "kind": "house", "rooms": "3", "seed": "5"})
    found = computed("world", answers)
    assert found["title"].startswith("A house of 10 m by 8 m, 3 rooms and 3 doors")
    assert "rooms 3" in found["arguments"]
    assert "seed 5" in found["arguments"]
    with pytest.raises(UsageError, match=r"--rooms 3\.5 is not an integer"):
        computed("world", answers | {"rooms": "3.5"})
