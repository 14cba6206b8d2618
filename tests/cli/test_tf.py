"""`urdfkit tf`: what it prints, what it draws, and how it refuses."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.cli import main

LIMITED = """<robot name="limited">
  <link name="base"/><link name="arm"/><link name="finger"/>
  <joint name="bend" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/>
  </joint>
  <joint name="follow" type="revolute">
    <parent link="arm"/><child link="finger"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/><mimic joint="bend" multiplier="3"/>
  </joint>
</robot>
"""


LOOP = """<robot name="r"><link name="a"/><link name="b"/>
<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
<joint name="k" type="fixed"><parent link="b"/><child link="a"/></joint></robot>"""


@pytest.fixture
def limited(tmp_path: Path) -> str:
    path = tmp_path / "limited.urdf"
    path.write_text(LIMITED, encoding="utf-8")
    return str(path)


def ran(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Return exit code, standard output and standard error of ``urdfkit tf WORDS``."""
    code = main(["tf", *words])
    out, err = capsys.readouterr()
    return code, out, err


def test_one_transform_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = ran(
        capsys, "simpleton", "base_footprint", "left_wheel", "--joint", "left_wheel_joint=0.8", "--json"
    )
    assert (code, err) == (0, "")
    found = json.loads(out)
    assert (found["parent"], found["child"]) == ("base_footprint", "left_wheel")
    expected = pin.XYZQUATToSE3(np.array(found["translation"] + found["quaternion"]))
    np.testing.assert_allclose(found["matrix"], expected.homogeneous, rtol=0, atol=1e-15)
    np.testing.assert_allclose(found["quaternion"], [0, np.sin(0.4), 0, np.cos(0.4)], rtol=0, atol=1e-15)
    assert len(found["matrix"]) == 4


def test_one_transform_as_text(capsys: pytest.CaptureFixture[str], limited: str) -> None:
    code, out, err = ran(capsys, limited, "base", "arm", "--joint", "bend=0.5")
    assert code == 0
    assert out == (
        "base → arm\n"
        "- Translation: [0.000000, 0.000000, 1.000000] m\n"
        "- Rotation: in Quaternion (xyzw) [0.000000, 0.247404, 0.000000, 0.968912]\n"
        "- Rotation: in RPY (radian) [0.000000, 0.500000, 0.000000]\n"
        "- Rotation: in RPY (degree) [0.000, 28.648, 0.000]\n"
        "- Matrix:\n"
        "    0.877583   0.000000   0.479426   0.000000\n"
        "    0.000000   1.000000   0.000000   0.000000\n"
        "   -0.479426   0.000000   0.877583   1.000000\n"
        "    0.000000   0.000000   0.000000   1.000000\n"
    )
    assert err.count("warning") == 1  # the follower is at 1.5 rad


def test_all_transforms(capsys: pytest.CaptureFixture[str], limited: str) -> None:
    _, out, _ = ran(capsys, limited)
    assert [line.split()[0] for line in out.splitlines()[2:]] == ["base", "arm", "finger"]
    assert out.startswith("frames in `base`\n")
    _, out, _ = ran(capsys, limited, "--json", "--joint", "bend=0.2")
    transforms = json.loads(out)
    assert [(t["parent"], t["child"]) for t in transforms] == [("base", name) for name in ("base", "arm", "finger")]
    assert transforms[2]["rpy"][1] == pytest.approx(0.8)


def test_a_value_outside_its_limits_is_computed_with_a_warning(
    capsys: pytest.CaptureFixture[str], limited: str
) -> None:
    code, out, err = ran(capsys, limited, "base", "arm", "--joint", "bend=-2", "--json")
    assert code == 0
    assert json.loads(out)["rpy"][1] != 0.0
    assert err == (
        "urdfkit: warning: joint `bend` at -2 rad is outside its limits [-1, 1] rad\n"
        "urdfkit: warning: joint `follow` at -6 rad is outside its limits [-1, 1] rad\n"
    )


def test_joints_may_be_listed_in_several_ways(capsys: pytest.CaptureFixture[str]) -> None:
    printed = {
        ran(capsys, "simpleton", "left_wheel", "right_wheel", *words)[1]
        for words in (
            ["--joint", "left_wheel_joint=0.1", "right_wheel_joint=-0.2"],
            ["--joint", "left_wheel_joint=0.1", "--joint", "right_wheel_joint=-0.2"],
            ["--joint", "left_wheel_joint=0.1,right_wheel_joint=-0.2"],
        )
    }
    assert len(printed) == 1


@pytest.mark.parametrize(("words", "expected"), [(["base", "arm"], "base -> arm\n"), (["--tree"], "base\n`-- arm  [b")])
def test_a_terminal_without_unicode(limited: str, words: list[str], expected: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "urdfkit", "tf", limited, *words],
        env={**os.environ, "PYTHONIOENCODING": "ascii"},
        capture_output=True,
        check=True,
    )
    assert done.stdout.decode("ascii").startswith(expected)


def test_options_may_stand_anywhere(capsys: pytest.CaptureFixture[str], limited: str) -> None:
    frames, options = ["base", "arm"], ["--package-path", "."]
    expected = ran(capsys, limited, *frames, "--json", *options)
    assert expected[0] == 0
    assert ran(capsys, *options, limited, "--json", *frames) == expected
    assert ran(capsys, limited, frames[0], *options, frames[1], "--json") == expected


def test_the_tree_as_text_and_json(capsys: pytest.CaptureFixture[str], limited: str) -> None:
    code, out, err = ran(capsys, limited, "--tree")
    assert (code, err) == (0, "")
    assert out == "base\n└── arm  [bend, revolute]\n    └── finger  [follow, revolute, mimics bend]\n"
    _, out, _ = ran(capsys, limited, "--tree", "--json")
    assert json.loads(out) == {
        "repairs": [],
        "root": "base",
        "frames": ["base", "arm", "finger"],
        "edges": [
            {
                "parent": "base",
                "child": "arm",
                "joint": "bend",
                "type": "revolute",
                "is_static": False,
                "mimics": None,
            },
            {
                "parent": "arm",
                "child": "finger",
                "joint": "follow",
                "type": "revolute",
                "is_static": False,
                "mimics": "bend",
            },
        ],
    }


@pytest.mark.parametrize("suffix", ["svg", "SVG", "dot"])
def test_drawings(capsys: pytest.CaptureFixture[str], limited: str, tmp_path: Path, suffix: str) -> None:
    target = tmp_path / f"frames.{suffix}"
    code, out, err = ran(capsys, limited, "--tree", "-o", str(target))
    assert (code, out, err) == (0, "", f"wrote {target}\n")
    if suffix == "dot":
        assert target.read_text(encoding="utf-8").startswith('digraph "limited" {')
    else:
        assert ElementTree.parse(target).getroot().tag == "{http://www.w3.org/2000/svg}svg"


@pytest.mark.graphviz
def test_a_pdf_by_graphviz(capsys: pytest.CaptureFixture[str], limited: str, tmp_path: Path) -> None:
    target = tmp_path / "frames.pdf"
    assert ran(capsys, limited, "--tree", "-q", "-o", str(target)) == (0, "", "")
    assert target.read_bytes().startswith(b"%PDF")


def test_a_pdf_without_graphviz_names_what_works(
    capsys: pytest.CaptureFixture[str], limited: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    target = tmp_path / "frames.pdf"
    code, out, err = ran(capsys, limited, "--tree", "-o", str(target))
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "apt install graphviz" in err
    assert "frames.svg" in err
    assert not target.exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nothing.urdf", "a", "b"], "no such file or folder: nothing.urdf"),
        (["simpletn", "a", "b"], "did you mean `simpleton`?"),
        (
            ["simpleton", "base_footprint"],
            "a transform needs PARENT and CHILD; add the CHILD frame after `base_footprint`",
        ),
        (["simpleton", "a", "b", "c"], "expected one PARENT and one CHILD, got 3 frames: a b c"),
        (
            ["simpleton", "base_footprint", "left_whel"],
            "no frame `left_whel` in robot `simpleton`; did you mean `left_",
        ),
        (["simpleton", "--joint", "left_wheel_jont=1"], "no movable joint `left_wheel_jont` in robot `simpleton`; did"),
        (["simpleton", "--joint", "left_wheel_joint"], "--joint expects name=value, got `left_wheel_joint`"),
        (["simpleton", "--joint", "=1"], "--joint expects name=value, got `=1`"),
        (["simpleton", "--joint", "left_wheel_joint=fast"], "`fast` is not a number [rad or m]"),
        (["simpleton", "--joint", "left_wheel_joint=nan"], "nan is not a finite number"),
        (["simpleton", "--joint", "left_wheel_joint=-inf"], "-inf is not a finite number"),
        (["simpleton", "--joint", "caster_joint=1"], "joint `caster_joint` is fixed: it does not move"),
        (
            ["simpleton", "--joint", "left_wheel_joint=1", "left_wheel_joint=2"],
            "--joint left_wheel_joint occurs twice",
        ),
        (["simpleton", "-o", "x.svg"], "-o requires --tree"),
        (["simpleton", "--tree", "-o", "x.sgv"], "unsupported file type; use .svg, .dot, .pdf; did you mean `.svg`?"),
        (["simpleton", "--tree", "a", "b"], "PARENT and CHILD cannot be combined with --tree"),
        (["simpleton", "--tree", "-o", "no/such/folder/x.svg"], "cannot write no/such/folder/x.svg"),
    ],
)
def test_refusals_are_one_line(capsys: pytest.CaptureFixture[str], words: list[str], message: str) -> None:
    code, out, err = ran(capsys, *words)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert message in err
    assert not Path("x.svg").exists()


def test_a_mimic_joint_cannot_be_set(capsys: pytest.CaptureFixture[str], limited: str) -> None:
    code, out, err = ran(capsys, limited, "base", "arm", "--joint", "follow=1")
    assert (code, out) == (2, "")
    assert "joint `follow` mimics another joint (3 · bend + 0); set `bend` instead" in err


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("<robot name='r'><link name='a'/><link name='b'/></robot>", "root links"),
        ("<robot name='r'><link name='a'>", "robot.urdf:1:"),
        ("", "robot.urdf"),
        (LOOP, "loop"),
    ],
)
def test_a_file_that_is_no_robot_is_refused_with_its_position(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, text: str, message: str
) -> None:
    path = tmp_path / "robot.urdf"
    path.write_text(text, encoding="utf-8")
    code, out, err = ran(capsys, str(path), "a", "b", "--strict")
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert message in err
