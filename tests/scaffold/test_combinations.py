"""Any two options go together: the robot expands, lints clean and loads, and publishes what its README says."""

import itertools
import re

import pytest
import yaml

from urdfkit.description import load
from urdfkit.lint import lint
from urdfkit.resources import find_model
from urdfkit.scaffold import create
from urdfkit.sim import Simulator


def pairs_of(row):
    """Return every two options of a row, with their values."""
    return set(itertools.combinations(sorted(row.items()), 2))


def covering(options, never):
    """Yield rows, few of them, until every pair of values has been in one; rows with one of `never` are left out.

    Greedy: each row begins with a pair that is still missing and takes, option by option, the value that brings most.
    """

    def allowed(row):
        return not any(pair.items() <= row.items() for pair in never)

    missing = {
        pair
        for one, other in itertools.combinations(sorted(options), 2)
        for pair in itertools.product([(one, v) for v in options[one]], [(other, v) for v in options[other]])
        if allowed(dict(pair))
    }
    while missing:
        row = dict(min(missing))
        for name in options:
            if name not in row:
                fitting = [value for value in options[name] if allowed(row | {name: value})]
                row[name] = max(fitting, key=lambda v, n=name: len(pairs_of(row | {n: v}) & missing))
        missing -= pairs_of(row)
        yield row


SENSORS = ("lidar", "lidar3d", "camera", "depth", "imu", "gps")
OPTIONS = {
    "ros": ("humble", "jazzy", "kilted", "lyrical", "noetic", "none"),
    "sim": ("gz", "classic"),
    "drive": ("diff", "skid", "ackermann", "omni", "none"),
    "license": ("Apache-2.0", "BSD-3-Clause", "MIT"),
    **dict.fromkeys(SENSORS, ("no", "yes")),
}
NEVER = [
    {"ros": "noetic", "drive": "ackermann"},
    {"ros": "noetic", "sim": "gz"},
    *({"ros": ros, "sim": "classic"} for ros in ("jazzy", "kilted", "lyrical", "none")),
    {"sim": "classic", "drive": "ackermann"},
]
ROWS = list(covering(OPTIONS, NEVER))


def given(row):
    """Return what is answered for a row of options."""
    sensors = " ".join(sensor for sensor in SENSORS if row[sensor] == "yes")
    return {"name": "scout", "sensor": sensors} | {name: row[name] for name in ("ros", "sim", "drive", "license")}


def made(template, folder, answers):
    create(template, template.answers(answers) | {"year": "2026", "into": "."}, folder)
    return find_model([f"{folder}/scout_description"]).path


def test_every_pair_is_there():
    seen = set().union(*map(pairs_of, ROWS))
    for one, other in itertools.combinations(sorted(OPTIONS), 2):
        for values in itertools.product(OPTIONS[one], OPTIONS[other]):
            pair = dict(zip((one, other), values, strict=True))
            assert pair in NEVER or tuple(sorted(pair.items())) in seen


@pytest.mark.parametrize("row", ROWS, ids=lambda row: "-".join(row.values()))
def test_lints_clean_and_loads(robot_template, tmp_path, row):
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
