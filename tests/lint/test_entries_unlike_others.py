"""Entries of YAML files that differ from others and are right."""

from __future__ import annotations

from time import process_time

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint import lint
from urdfkit.lint.facts.parameters.misspelt_names import is_misspelt
from urdfkit.lint.facts.parameters.odd_entries import odd_entries

ROBOT = """<robot name="arm"><link name="base"/><link name="tool"/>
<joint name="slide" type="prismatic"><parent link="base"/><child link="tool"/>
<limit lower="0" upper="1" effort="9" velocity="1"/></joint></robot>"""
PACKAGE = """<package format="3"><name>arm</name><version>1.0.0</version><description>Arm.</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>"""
CORRECT = {
    "other scripts": "left: {клавиша: 1}\nright: {клавиши: 1}",
    "signed values": "min_yaw_rate: -1.5\nyaw_rate: -0.3\nmultiplier: -0.5\nlearning_rate: -3\noffset_tolerance: -0.1",
    "texts of digits": 'serial_no: "138422075015"\nutm_zone: "33"\nprotocol: "2.0"\nfirmware: "1.10"\ngpio_pin: "17"',
    "codes of digits": 'a: {pin: 1234, n: 1}\nb: {pin: 4321, n: 1}\nc: {pin: "0000", n: 1}',
    "versions": 'a: {version: 1.1, n: 1}\nb: {version: 1.2, n: 1}\nc: {version: "1.10", n: 1}',
    "zones": "goals: [goal_a, goal_c]\ngoal_a: {x: 1}\ngoal_b: {x: 1}\ngoal_d: {x: 1}\nimus: [imu_a1, imu_a2, imu_b1]",
    "axes": "walk: {axes: {linear-x: 1, angular-z: 0}}\nturbo: {axes: {linear-y: 1, angular-z: 0}}\nlinear-x: 1",
    "modes": "a: {mode: heating}\nb: {mode: heating}\nc: {mode: heading}",
    "optional keys": "a: {x: 1, y: 1, yaw: 0}\nb: {x: 1, y: 1, yaw: 0}\nc: {x: 1, y: 1, yaw: 0}\nd: {x: 1, y: 1}",
    "nullspace": "stiff: [1, 1, 1, 1]\ndamping: [1, 1, 1, 1]\nwrench: [1, 1, 1, 1]\nnullspace: [1, 1, 1, 1, 1]",
    "points of gestures": "wave: {times: [0, 1, 2, 3]}\nbow: {times: [0, 1, 2, 3]}\nnod: {times: [0, 1, 2]}",
    "other styles": "a_frame: base\nb_frame: odom\nmap_frame: map\nocc_thresh: 0.2\nmap_z: 3\nmap_x: 3\nmaxUrange: 3",
    "buses": "interfaces: [can0, can0, can1, can1]\ncritics: [a, a, b, b]",
    "sector over zero": "min_angle: 300.0\nmax_angle: 60.0\nservo_min: 2500\nservo_max: 500",
    "bounds that K971 checks": "lower_angle: 2.0\nupper_angle: -2.0",
    "parameter in the code": "left: {charge: 1}\nright: {charge: 1}\nrear: {chagre: 1}",
}


def found(folder, text, file="config/nodes.yaml", parameters="ros__parameters"):
    entries = "\n".join(f"    {line}" for line in text.splitlines())
    texts = {
        "arm.urdf": ROBOT,
        "package.xml": PACKAGE,
        "scripts/node.py": "from rclpy.node import Node\nNode('arm').declare_parameter('chagre', 1)\n",
        file: f"arm:\n  {parameters}:\n{entries}\n",
    }
    for name, content in texts.items():
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(content)
    return [(one.code, one.line, one.message) for one in lint(folder) if one.code in ("K992", "E999")]


@pytest.mark.parametrize("text", CORRECT.values(), ids=CORRECT)
def test_entries_that_differ_rightly_give_no_finding(tmp_path, text):
    assert found(tmp_path, text) == []


@pytest.mark.parametrize(("file", "lines"), [("config/nodes.yaml", [3]), ("docker-compose.yml", [])])
def test_only_files_of_nodes_are_compared(tmp_path, file, lines):
    text = "left: {iamge: 1}\nright: {image: 1}\nrear: {image: 1}"
    assert [line for _, line, _ in found(tmp_path, text, file, "services")] == lines


NAMES = [
    ("joint", "jonit", True),
    ("feed_forward_gain", "feed_forwrad_gain", True),
    ("wheel_base", "wheelbase", True),
    ("track_unknown_space", "track_unknwn_space", True),
    ("hip", "hipp", True),
    ("charge", "change", True),
    *(("zone_a", "zone_b", False), ("posx", "posy", False), ("FL_hip", "LF_hip", False), ("rgb", "bgr", False)),
    *(
        ("lgripper", "rgripper", False),
        ("enable", "enabled", False),
        ("stop", "step", False),
        ("lamp_1", "lamp_2", False),
    ),
]


@pytest.mark.parametrize(("name", "other", "expected"), NAMES)
def test_a_slip_is_told_from_a_letter_that_enumerates(name, other, expected):
    assert (is_misspelt(name, other), is_misspelt(other, name)) == (expected, expected)


def test_the_time_grows_with_the_size_of_the_file():
    def time_of(count):
        keys = ((f"co{i // 3}m{j}: 1, u{i}xa{j}: 1" for j in range(8)) for i in range(count))
        text = "n:\n  ros__parameters:\n" + "".join(f"    s{i}: {{{', '.join(each)}}}\n" for i, each in enumerate(keys))
        source = Source("config/a.yaml", text)
        list(odd_entries(source))
        start = process_time()
        assert not list(odd_entries(source))
        return process_time() - start

    assert time_of(400) < 12.0 * max(time_of(100), 0.05)


def test_the_time_does_not_grow_with_the_number_of_words_in_a_name():
    names = ["base_link"] * 4 + ["a_" * 28 + "?"]
    text = "n:\n  ros__parameters:\n" + "".join(f"    s{i}: {{frame: {name}}}\n" for i, name in enumerate(names))
    start = process_time()
    assert not list(odd_entries(Source("config/a.yaml", text)))
    assert process_time() - start < 2.0
