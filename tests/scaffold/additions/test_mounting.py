"""What is added goes where nothing else is: no two parts overlap, and each has names and topics of its own."""

from itertools import combinations

import numpy as np
import pytest

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.errors import ResourceError
from urdfkit.lint import lint
from urdfkit.scaffold.additions.free_placement import Part, free_place, overlapped, spot
from urdfkit.scaffold.additions.link_boxes import Boxes, gap
from urdfkit.scaffold.additions.mounting import exact, mount, written

BASE = ((-0.2, -0.15, 0.0), (0.2, 0.15, 0.1))
CUBE = ((-0.05, -0.05, -0.05), (0.05, 0.05, 0.05))
PART = Part((CUBE,), CUBE)


@pytest.fixture(scope="module")
def scouts(tmp_path_factory):
    """New robots with what can be added to them already there, by the generation of ROS."""
    made = tmp_path_factory.mktemp("scouts")
    having = ["--sensor", "lidar,camera,imu,gps", "--arm", "4", "--base-length", "0.6", "--base-width", "0.5"]
    for ros in ("jazzy", "noetic"):
        command = ["new", "robot", "scout", "--ros", ros, *having, "--mass", "20", "--into", str(made / ros)]
        assert main([*command, "--no-picture", "--yes"]) == 0
    return made


@pytest.fixture
def scout(scouts, request, tmp_path):
    """The files of one of them, to be changed."""
    import shutil

    shutil.copytree(scouts / request.param, tmp_path / "src")
    return tmp_path / "src/scout_description"


def overlaps(robot):
    """Return the pairs of links of which one is overlapped the other, but for what is in the middle of the base."""
    base = robot.link_by_name["base_link"]
    boxes = [(name, box) for name, box in Boxes(robot).seen_from(base) if "imu" not in name]
    named = ("lidar", "camera", "gps", "arm", "depth")
    return [
        (one, other)
        for (one, a), (other, b) in combinations(boxes, 2)
        if gap(a, b) < -1e-3 and one != other and (one.startswith(named) and other.startswith((*named, "base_link")))
    ]


@pytest.mark.slow
@pytest.mark.parametrize("scout", ["jazzy", "noetic"], indirect=True)
def test_a_second_of_each_has_a_place_a_name_and_a_topic_of_its_own(scout, capsys):
    for kind in ("lidar", "lidar3d", "camera", "imu", "gps", "lidar"):
        assert main(["new", "sensor", kind, "--into", str(scout)]) == 0
        assert f"`{kind}" in capsys.readouterr().err  # what it is called, and where it is
    assert main(["new", "arm", "--into", str(scout), "--reach", "0.3"]) == 0
    reported = capsys.readouterr().err
    robot = load(scout / "urdf/scout.urdf.xacro")
    assert {"lidar_2_link", "lidar_3_link", "camera_2_link", "imu_2_link", "gps_2_link"} <= set(robot.link_by_name)
    place = robot.joint_by_name["arm_2_arm_mount_joint"].origin.xyz
    assert f"`arm_2` on `base_link` at {' '.join(f'{x:.6g}' for x in place)}" in reported
    assert overlaps(robot) == []
    imus = {robot.joint_by_name[name].origin.xyz for name in ("imu_joint", "imu_2_joint")}
    assert len(imus) == 2
    assert [str(finding) for finding in lint([scout]) if finding.severity != "note"] == []


@pytest.mark.parametrize("scout", ["jazzy"], indirect=True)
def test_a_place_that_is_asked_for_is_taken_and_told_about(scout, capsys):
    assert main(["new", "sensor", "camera", "--into", str(scout), "--xyz", "0.1", "0", "0.05"]) == 0
    assert "urdfkit: at 0.1 0 0.05 it overlaps `base_link`" in capsys.readouterr().err
    robot = load(scout / "urdf/scout.urdf.xacro")
    assert robot.joint_by_name["camera_2_joint"].origin.xyz == (0.1, 0, 0.05)


@pytest.mark.parametrize("scout", ["jazzy"], indirect=True)
def test_where_no_room_is_left_it_is_refused(scout, capsys):
    before = (scout / "urdf/scout.urdf.xacro").read_bytes()
    assert main(["new", "arm", "--into", str(scout), "--reach", "2.4"]) == 2
    reported = capsys.readouterr().err
    assert "`base_link` has no free space next to `arm_foot`" in reported
    assert "or a place with --xyz" in reported
    assert (scout / "urdf/scout.urdf.xacro").read_bytes() == before


def test_the_usual_place_if_it_is_free():
    assert free_place([BASE], [], PART) == spot([BASE], PART) == (0, 0, 0.15)


def test_the_nearest_place_that_is_free():
    there = ((-0.05, -0.05, 0.1), (0.05, 0.05, 0.2))
    x, y, z = free_place([BASE], [there], PART)
    assert (y, z) == (0, 0.15)
    assert 0.1 < abs(x) <= 0.15
    assert overlapped(PART, (x, y, z), [("there", there)]) is None
    assert overlapped(PART, (0.09, 0, 0.15), [("there", there)]) == "there"


def test_what_looks_about_goes_as_far_as_it_can():
    there = ((-0.05, -0.05, 0.1), (0.05, 0.05, 0.2))
    assert free_place([BASE], [there], Part((CUBE,), CUBE, far_from_others=True)) == (0.15, 0.0, 0.15)
    tower = ((-0.2, -0.15, 0.1), (-0.1, 0.15, 0.5))  # on top, the other part is not in sight
    assert free_place([BASE, tower], [there], Part((CUBE,), CUBE, far_from_others=True)) == (0.15, 0.0, 0.15)


def test_at_the_front_beside_the_other_and_then_below():
    one, tall = ((0.2, -0.06, 0.0), (0.3, 0.06, 0.1)), ((-0.2, -0.15, 0.0), (0.2, 0.15, 0.3))
    front = Part((CUBE,), CUBE, "front")
    assert free_place([BASE], [], front) == (0.25, 0, 0.05)
    assert free_place([BASE], [one], front) is None
    assert free_place([tall], [((0.2, -0.06, 0.2), (0.3, 0.06, 0.3))], front) == (0.25, 0, 0.14)


def test_on_a_link_of_several_shapes_it_stands_on_what_is_below_it():
    tower = ((-0.2, -0.15, 0.1), (-0.1, 0.15, 0.5))
    assert spot([BASE, tower], PART) == (0, 0, 0.15)
    x, _, z = free_place([BASE, tower], [((-0.1, -0.15, 0.1), (0.2, 0.15, 0.2))], PART)
    assert (x, z) == (-0.15, 0.55)


def test_numbers_are_written_without_a_negative_zero():
    assert written((-0.0, 0.15, -0.2)) == "0 0.15 -0.2"


def test_numbers_that_were_given_keep_their_digits():
    assert exact((3.141592653589793, -0.25123456, -0.0)) == "3.141592653589793 -0.25123456 0"
    assert exact((0.1, 1e-9, 0.1 + 0.2)) == "0.1 1e-09 0.30000000000000004"


def test_on_a_frame_it_goes_up_until_nothing_is_there():
    assert free_place([], [], PART) == (0, 0, 0.05)
    assert free_place([], [((-1, -1, -1), (1, 1, 0.1))], PART) == (0, 0, 0.16)


def test_boxes_of_meshes_are_read(tmp_path):
    (tmp_path / "wedge.stl").write_text(
        "solid wedge\nfacet normal 0 0 1\nouter loop\nvertex 100 50 20\nvertex 200 50 20\nvertex 100 70 300\nendloop\n"
        "endfacet\nendsolid wedge\n"
    )
    model = tmp_path / "cart.urdf"
    mesh = '<geometry><mesh filename="{}" scale="0.001 0.001 0.001"/></geometry>'
    model.write_text(
        f'<robot name="cart"><link name="a"><visual>{mesh.format("wedge.stl")}</visual></link>'
        f'<link name="b"><visual>{mesh.format("none.stl")}</visual></link>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
    )
    robot = load(model)
    (box,) = Boxes(robot).of(robot.link_by_name["a"])
    assert np.array(box) == pytest.approx(np.array(((0.1, 0.05, 0.02), (0.2, 0.07, 0.3))))
    assert Boxes(robot).of(robot.link_by_name["b"]) is None
    assert mount(robot, robot.link_by_name["a"], PART, None) == ((0.15, 0.06, 0.35), [])
    _, notes = mount(robot, robot.link_by_name["b"], PART, None)
    assert notes == ["the meshes of `b` cannot be read: check that the part does not overlap it, and use --xyz"]


def test_a_cylinder_that_lies(tmp_path):
    model = tmp_path / "roll.urdf"
    model.write_text(
        '<robot name="roll"><link name="a"><collision><origin rpy="0.785398163 0 0"/><geometry>'
        '<cylinder radius="0.1" length="0.4"/></geometry></collision></link></robot>'
    )
    robot = load(model)
    ((low, high),) = Boxes(robot).of(robot.link_by_name["a"])
    reach = (0.2 + 0.1) * 0.5**0.5
    assert high == pytest.approx((0.1, reach, reach))
    assert low == pytest.approx((-0.1, -reach, -reach))
    tall = Part((((-1, -1, -9), (1, 1, 0.05)),), CUBE)  # its foot is in the middle of it
    with pytest.raises(ResourceError, match=r"`a` has no free space for a part of 2 × 2 × 9\.1 m"):
        mount(robot, robot.link_by_name["a"], tall, None)
