from __future__ import annotations

import re
import subprocess
from collections.abc import Callable
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import pytest

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import UrdfkitError
from urdfkit.kinematics import TransformTree
from urdfkit.kinematics.frame_tree_drawing import as_dot, as_svg, as_text

CORPUS = Path(__file__).parents[2].parent / "shared" / "corpus"
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def tree(arm: Robot) -> TransformTree:
    return TransformTree(arm)


def test_text(tree: TransformTree) -> None:
    assert as_text(tree) == (
        "world\n"
        "└── turntable  [turn, continuous]\n"
        "    └── mast  [post, fixed]\n"
        "        └── lift  [slide, prismatic]\n"
        "            ├── plate  [bolted, fixed]\n"
        "            │   └── elbow  [bend, revolute]\n"
        "            │       ├── finger_a  [grip, prismatic]\n"
        "            │       └── finger_b  [grip_mirror, prismatic, mimics grip]\n"
        "            └── dial  [dial_joint, revolute, mimics bend]\n"
        "                └── camera  [camera_mount, fixed]\n"
        "                    └── camera_optical  [camera_optical_joint, fixed]\n"
    )
    plain = as_text(tree, ascii_only=True)
    assert plain.isascii()
    assert "    |-- plate" in plain
    assert "`-- dial" in plain


def test_svg_shows_every_frame_and_joint(tree: TransformTree) -> None:
    shown = [element.text for element in ElementTree.fromstring(as_svg(tree)).iter(f"{SVG}text")]
    assert sorted(shown) == sorted(
        [
            *tree.frames,
            *(edge.joint for edge in tree.edges),
            *(f"{edge.type}, mimics {edge.mimics}" if edge.mimics else edge.type for edge in tree.edges),
        ]
    )


def test_svg_marks_what_moves(tree: TransformTree) -> None:
    paths = [path.get("class") for path in ElementTree.fromstring(as_svg(tree)).iter(f"{SVG}path")]
    assert paths.count("moves") == 4
    assert paths.count("mimics") == 2
    assert paths.count(None) == 4


def test_a_drawing_of_one_link(robot_of: Callable[[str], Robot]) -> None:
    tree = TransformTree(robot_of('<robot name="r"><link name="only"/></robot>'))
    assert as_text(tree) == "only\n"
    assert len(list(ElementTree.fromstring(as_svg(tree)).iter(f"{SVG}rect"))) == 1
    assert '"only";' in as_dot(tree)


def _boxes(svg: str) -> list[tuple[float, float, float, float]]:
    return [
        tuple(float(rect.get(key, "")) for key in ("x", "y", "width", "height"))  # type: ignore[misc]
        for rect in ElementTree.fromstring(svg).iter(f"{SVG}rect")
    ]


def assert_tidy(svg: str) -> None:
    """Frames overlap neither each other nor the edge of the drawing."""
    root = ElementTree.fromstring(svg)
    width, height = float(root.get("width", "")), float(root.get("height", ""))
    boxes = _boxes(svg)
    for x, y, w, h in boxes:
        assert x >= 0
        assert y >= 0
        assert x + w <= width
        assert y + h <= height
    for (x, y, w, h), (x2, y2, w2, h2) in combinations(boxes, 2):
        assert x + w < x2 or x2 + w2 < x or y + h < y2 or y2 + h2 < y


def test_the_layout_is_tidy(tree: TransformTree) -> None:
    assert_tidy(as_svg(tree))


@pytest.mark.slow
@pytest.mark.skipif(not CORPUS.is_dir(), reason="the corpus is not next to the checkout")
def test_the_layout_of_real_robots_is_tidy() -> None:
    drawn = 0
    for path in sorted((CORPUS / "example-robot-data").rglob("*.urdf")):
        try:
            tree = TransformTree(load(path))
        except UrdfkitError:
            continue
        assert_tidy(as_svg(tree))
        drawn += 1
    assert drawn > 5


HOSTILE = (
    '<robot name="a&quot;b&lt;c"><link name="x&amp;&lt;script&gt;"/><link name="quo&quot;te\\n"/><link name="底盘"/>'
    '<joint name="&quot;];evil[" type="fixed"><parent link="x&amp;&lt;script&gt;"/>'
    '<child link="quo&quot;te\\n"/></joint>'
    '<joint name="轮" type="fixed"><parent link="x&amp;&lt;script&gt;"/><child link="底盘"/></joint></robot>'
)


def test_names_are_escaped(robot_of: Callable[[str], Robot]) -> None:
    tree = TransformTree(robot_of(HOSTILE))
    shown = [element.text for element in ElementTree.fromstring(as_svg(tree)).iter(f"{SVG}text")]
    assert 'quo"te\\n' in shown
    assert "x&<script>" in shown
    dot = as_dot(tree)
    assert '"quo\\"te\\\\n"' in dot
    assert_tidy(as_svg(tree))


@pytest.mark.graphviz
def test_graphviz_reads_the_dot(tree: TransformTree, robot_of: Callable[[str], Robot]) -> None:
    for drawn in (tree, TransformTree(robot_of(HOSTILE))):
        done = subprocess.run(["dot", "-Tplain"], input=as_dot(drawn).encode(), capture_output=True, check=True)
        plain = done.stdout.decode()
        assert len(re.findall(r"^node ", plain, re.MULTILINE)) == len(drawn.frames)
        assert len(re.findall(r"^edge ", plain, re.MULTILINE)) == len(drawn.edges)
