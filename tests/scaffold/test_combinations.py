"""Any two options go together: the robot expands, lints clean and loads, and publishes what its README states."""

import itertools
import math
import re

import pytest
import yaml

from tests.scaffold.drive_search import errors
from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.resources import find_model
from urdfkit.scaffold import create
from urdfkit.sim import Simulator

ALL_OF = ("drive", "arm", "sim")
"""Every combination of these is made, and every pair of the others."""


def groups_of(row):
    """Return every two options of a row, with their values, and those of `ALL_OF`."""
    found = set(itertools.combinations(sorted(row.items()), 2))
    return found | {tuple((name, row[name]) for name in ALL_OF)} if set(ALL_OF) <= set(row) else found


def covering(options, never):
    """Yield rows, few of them, until every group of values has been in one; rows with one of `never` are ignored.

    Greedy: each row begins with a group that is still missing and takes, option by option, the value that brings most.
    """

    def allowed(row):
        return not any(group.items() <= row.items() for group in never)

    missing = {
        group
        for names in (*itertools.combinations(sorted(options), 2), ALL_OF)
        for group in itertools.product(*([(name, value) for value in options[name]] for name in names))
        if allowed(dict(group))
    }
    while missing:
        row = dict(min(missing))
        for name in options:
            if name not in row:
                fitting = [value for value in options[name] if allowed(row | {name: value})]
                row[name] = max(fitting, key=lambda v, n=name: len(groups_of(row | {n: v}) & missing))
        missing -= groups_of(row)
        yield row


SENSORS = ("lidar", "lidar3d", "camera", "depth", "imu", "gps")
SIZES = {
    "usual": {},
    "heavy": {"mass": "20", "wheel_radius": "0.1"},
    "large": {"base_length": "0.9", "base_width": "0.6", "base_height": "0.2", "wheel_radius": "0.12", "mass": "60"},
}
OPTIONS = {
    "ros": ("humble", "jazzy", "kilted", "lyrical", "noetic", "none"),
    "sim": ("gz", "classic"),
    "drive": ("diff", "skid", "ackermann", "omni", "none"),
    "arm": ("none", "3", "4", "5", "6", "7"),
    "gripper": ("no", "yes"),
    "size": tuple(SIZES),
    "license": ("Apache-2.0", "BSD-3-Clause", "MIT"),
    **dict.fromkeys(SENSORS, ("no", "yes")),
}
NEVER = [
    {"ros": "noetic", "sim": "gz"},
    *({"ros": ros, "sim": "classic"} for ros in ("jazzy", "kilted", "lyrical", "none")),
    {"ros": "humble", "sim": "classic", "drive": "ackermann"},
    {"arm": "none", "gripper": "yes"},
]
ROWS = list(covering(OPTIONS, NEVER))


def given(row):
    """Return what is answered for a row of options."""
    answers = {"name": "scout", "sensor": " ".join(sensor for sensor in SENSORS if row[sensor] == "yes")}
    answers |= {name: row[name] for name in ("ros", "sim", "drive", "arm", "license")} | SIZES[row["size"]]
    if row["drive"] == "none":
        answers.pop("wheel_radius", None)
    return answers | ({"gripper": row["gripper"]} if row["arm"] != "none" else {})


def made(template, folder, answers):
    create(template, template.answers(answers) | {"year": "2026", "into": "."}, folder)
    return find_model([f"{folder}/scout_description"]).path


def test_every_pair_and_every_drive_with_every_arm_is_there():
    assert len(ROWS) >= 60
    seen = set().union(*map(groups_of, ROWS))
    for one, other in itertools.combinations(sorted(OPTIONS), 2):
        for values in itertools.product(OPTIONS[one], OPTIONS[other]):
            pair = dict(zip((one, other), values, strict=True))
            assert pair in NEVER or tuple(sorted(pair.items())) in seen
    for values in itertools.product(*(OPTIONS[name] for name in ALL_OF)):
        assert tuple(zip(ALL_OF, values, strict=True)) in seen


RAMP, SECONDS = 0.5, 2.25
ARM_TARGETS = (0.5, -0.3, 0.8, 0.4, -0.6)


def driven(simulator, command):
    """Drive for a while, from rest; return how far it is from where it should be, and has come on [m]."""
    vx, vy, w = command
    while simulator.t < RAMP:
        share = (simulator.t + simulator.dt / 2) / RAMP
        simulator.command((vx * share, vy * share, 0), (0, 0, w * share))
        simulator.step()
    while simulator.t < SECONDS - 0.1:  # controllers forget
        simulator.command((vx, vy, 0), (0, 0, w))
        simulator.run(0.25)
    t = SECONDS - RAMP / 2
    s, c = (math.sin(w * t) / w, (1 - math.cos(w * t)) / w) if w else (t, 0.0)
    x, y = simulator.link_poses()[0, :2]
    return math.dist((x, y), (vx * s - vy * c, vx * c + vy * s)), math.hypot(vx, vy) * t


@pytest.mark.slow
@pytest.mark.parametrize("row", ROWS, ids=lambda row: "-".join(row.values()))
def test_lints_clean_loads_is_seen_and_moves(robot_template, tmp_path, arm_joints, tell, row):
    path = made(robot_template, tmp_path, given(row))
    assert [str(finding) for finding in lint([tmp_path], package_path=[tmp_path])] == []
    robot = load(path)
    for sensor in SENSORS:
        assert (f"{sensor}_link" in robot.link_by_name) == (row[sensor] == "yes")
        optical = row[sensor] == "yes" and sensor in ("camera", "depth")
        assert (f"{sensor}_optical_frame" in robot.link_by_name) == optical
    for file in tmp_path.rglob("*"):
        if file.is_file():
            assert not re.search(r"@[a-z_0-9]+@", file.read_text()), file
    assert main(["format", "--check", str(tmp_path)]) == 0
    assert main(["view", str(path), "--html", f"{tmp_path}/page.html", "--quiet"]) == 0

    notes = []
    simulator = Simulator(robot, note=notes.append)
    assert not [note for note in notes if "controllers of" not in note and "spherical_coordinates" not in note]
    if row["drive"] != "none":
        # Where a robot that skids bears more on one side it turns about another point: straight on, then, and turned.
        command = {"skid": (0.4, 0, 0), "omni": (0.4, 0.1, 0.3)}.get(row["drive"], (0.4, 0, 0.3))
        off, way = driven(simulator, command)
        assert off <= 0.01 * way
        if row["drive"] == "skid":
            assert errors(robot, 0.0, 0.5)[1] < 0.01
            assert max(errors(robot, 0.4, 0.3)[:2]) < 0.02  # The load on its four wheels stays even.
    if row["arm"] != "none":
        targets = dict(zip(arm_joints[row["arm"]], itertools.cycle(ARM_TARGETS), strict=False))
        tell(simulator, row["ros"], targets, 1)
        if row["gripper"] == "yes":
            fingers = ["left_finger_joint", *(["right_finger_joint"] if row["ros"] == "noetic" else [])]
            tell(simulator, row["ros"], dict.fromkeys(fingers, 0.01), 1)
        simulator.run(2.0)
        for joint, target in targets.items():
            assert simulator.state.position(joint) == pytest.approx(target, abs=1e-2), joint
        for finger in ("left_finger_joint", "right_finger_joint") if row["gripper"] == "yes" else ():
            assert simulator.state.position(finger) == pytest.approx(0.01, abs=2e-4)


@pytest.mark.parametrize(
    ("ros", "sim", "drive"),
    [
        ("jazzy", "gz", "ackermann"),
        ("humble", "gz", "diff"),
        ("humble", "classic", "omni"),
        ("noetic", "classic", "skid"),
    ],
)
def test_publishes_what_it_says(robot_template, tmp_path, ros, sim, drive):
    answers = {"name": "scout", "ros": ros, "sim": sim, "drive": drive, "sensor": " ".join(SENSORS)}
    notes = []
    simulator = Simulator(load(made(robot_template, tmp_path, answers)), note=notes.append)
    readme = (tmp_path / "scout_gazebo/README.md").read_text()
    rows = re.findall(r"^\| `(/[\w/]+)` \| ([\w/]+) \|", readme, re.MULTILINE)
    told = {topic: kind for topic, kind in rows if kind.startswith("sensor_msgs") and "joint" not in topic}
    assert len(told) == 10
    heard = {}
    for topic, kind in told.items():
        simulator.subscribe(
            topic,
            f"sensor_msgs/msg/{kind.split('/')[-1]}",
            lambda message, topic=topic: heard.setdefault(topic, message),
        )
    simulator.run(0.25)
    assert set(heard) == set(told)
    name = "/scout" if ros == "noetic" else ""
    assert heard[f"{name}/scan"].header.frame_id == "lidar_link"
    assert heard[f"{name}/camera/image_raw"].header.frame_id == "camera_optical_frame"
    frame = "depth_link" if sim == "gz" else "depth_optical_frame"  # of points with x, or with z forward
    assert heard[f"{name}/depth/points"].header.frame_id == frame
    # It does not see itself.
    assert all(reading == float("inf") for reading in heard[f"{name}/scan"].ranges)
    assert heard[f"{name}/imu"].linear_acceleration.z == pytest.approx(9.81, abs=0.3)
    assert heard[f"{name}/fix"].latitude == pytest.approx(47.378 if name else 0.0, abs=0.01)
    if sim == "gz":
        bridge = yaml.safe_load((tmp_path / "scout_gazebo/config/bridge.yaml").read_text())
        bridged = {f"/{entry['ros_topic_name']}": entry["ros_type_name"] for entry in bridge}
        assert bridged == dict(rows)
