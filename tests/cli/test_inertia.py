"""``urdfkit inertia`` as a command."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.description import load

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
SHAPE = '<collision><origin xyz="0 0 0.05"/><geometry><box size="0.1 0.2 0.1"/></geometry></collision>'
INERTIA = '<inertia ixx="{0}" ixy="0" ixz="0" iyy="{0}" iyz="0" izz="{0}"/>'


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.chdir(tmp_path)

    def write(body: str, name: str = "r.urdf.xacro") -> Path:
        Path(name).write_text(f"{HEAD}\n{body}\n</robot>\n")
        return Path(name)

    return write


def link(inertial: str, name: str = "a") -> str:
    return f'<link name="{name}">\n  {inertial}\n  {SHAPE}\n</link>'


BAD = link(f'<inertial><!-- kept --><mass value="3"/>{INERTIA.format(4)}</inertial>')


def test_both_inertias_and_the_defect_are_shown(write, capsys):
    assert main(["inertia", str(write(BAD)), "a"]) == 1
    out = capsys.readouterr().out
    assert out.startswith("a  r.urdf.xacro:3\n  1 collision shape, 0.002 m³ in total\n")
    assert "present        computed" in out
    assert "320 times" in out  # 4 kg·m² next to 3 · (0.2² + 0.1²)/12
    assert "  warning: iyy is 800 times that of the shapes\n" in out


def test_findings_of_the_linter_are_shown(write, capsys):
    path = write(link(f'<inertial><mass value="3"/>{INERTIA.format(-1)}</inertial>'))
    assert main(["inertia", str(path), "a"]) == 1
    assert "  error: I502 inertia of link `a` is impossible" in capsys.readouterr().out


def test_json_has_both_tensors(write, capsys):
    assert main(["inertia", str(write(BAD)), "a", "--json", "--mass", "12"]) == 1
    row = json.loads(capsys.readouterr().out)
    assert row["present"]["inertia"]["ixx"] == 4.0
    assert row["computed"]["mass"] == 12.0
    assert row["computed"]["xyz"] == pytest.approx([0.0, 0.0, 0.05])
    assert row["computed"]["inertia"]["ixx"] == pytest.approx(0.05)
    assert row["shapes"] == {"kind": "collision", "count": 1, "volume": pytest.approx(0.002), "shared": 0.0}
    assert main(["inertia", "r.urdf.xacro", "--json"]) == 1
    assert [row["link"] for row in json.loads(capsys.readouterr().out)] == ["a"]


def test_write_changes_the_values_only_and_then_nothing_is_left(write, capsys):
    path = write(BAD)
    assert main(["inertia", str(path), "a", "--write"]) == 0
    assert "wrote the inertia of `a` into r.urdf.xacro:3" in capsys.readouterr().err
    expected = link(
        '<inertial><!-- kept --><mass value="3"/>'
        '<inertia ixx="0.0125" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.0125"/>'
        '\n  <origin xyz="0 0 0.05"/></inertial>'
    )
    text = path.read_text()
    assert text.count("<!-- kept -->") == 1
    inertial = load(path).links[0].inertial
    assert inertial is not None
    assert inertial.origin.xyz == (0.0, 0.0, 0.05)
    assert inertial.inertia is not None
    assert (inertial.inertia.ixx, inertial.inertia.iyy) == (0.0125, 0.005)
    assert text.replace(" ", "").replace("\n", "") == f"{HEAD}\n{expected}\n</robot>".replace(" ", "").replace("\n", "")
    assert main(["inertia", str(path), "a", "--write"]) == 0
    assert path.read_text() == text


@pytest.mark.parametrize("body", [link(""), '<link name="a">' + SHAPE + "</link>"])
def test_a_link_without_inertial_gets_one(write, body, capsys):
    path = write(body)
    assert main(["inertia", str(path), "a"]) == 2
    assert "no mass to compute with: pass --mass or --density" in capsys.readouterr().err
    assert main(["inertia", str(path), "a", "--density", "1000", "--write"]) == 0
    inertial = load(path).links[0].inertial
    assert inertial is not None
    assert inertial.mass == pytest.approx(2.0)


def test_what_is_right_already_is_not_written(write, capsys):
    path = write(BAD)
    assert main(["inertia", str(path), "a", "--write"]) == 0
    mended = path.read_bytes()
    capsys.readouterr()
    main(["inertia", str(path), "a", "--write"])
    reported = capsys.readouterr()
    assert "wrote" not in reported.err
    assert "note: not written: the file has these values already" in reported.out
    assert path.read_bytes() == mended


def test_without_a_link_what_is_wrong_is_written_and_the_rest_let_be(write):
    right = link(
        '<inertial><origin xyz="0 0 0.05"/><mass value="3"/>'
        '<inertia ixx="0.0126" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.0125"/></inertial>',
        "b",
    )
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    path = write(f"{BAD}\n{right}\n{joint}")
    assert main(["inertia", str(path), "--write"]) == 0
    text = path.read_text()
    assert 'ixx="0.0126"' in text
    assert 'ixx="0.0125"' in text


MACRO = f"""<xacro:macro name="part" params="n">
{link('<inertial><mass value="3"/>' + INERTIA.format(4) + "</inertial>", "${n}")}
</xacro:macro>
"""


def test_a_macro_with_several_expansions_is_refused_and_with_one_written(write, capsys):
    joint = '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>'
    path = write(f'{MACRO}<xacro:part n="a"/><xacro:part n="b"/>{joint}')
    before = path.read_text()
    assert main(["inertia", str(path), "a", "--write"]) == 2
    assert "macro `part` that has 2 expansions" in capsys.readouterr().err
    assert path.read_text() == before
    path = write(f'{MACRO}<xacro:part n="a"/>')
    assert main(["inertia", str(path), "a", "--write"]) == 0
    assert 'iyy="0.005"' in path.read_text()


def test_bytes_that_are_not_touched_stay(write):
    path = write(BAD)
    content = b"\xef\xbb\xbf" + path.read_bytes().replace(b"\n", b"\r\n")
    path.write_bytes(content)
    assert main(["inertia", str(path), "a", "--write"]) == 0
    after = path.read_bytes()
    assert after.startswith(b"\xef\xbb\xbf")
    assert after.count(b"\r\n") >= content.count(b"\r\n")


@pytest.mark.parametrize("end", [b"\r\n", b"\r"])
@pytest.mark.parametrize(
    "link",
    [
        '<link name="a">\n  {}\n</link>',
        '<link name="a">\n  <inertial>\n    <mass value="1"/>\n  </inertial>\n  {}\n</link>',
    ],
)
def test_lines_that_are_put_in_end_as_the_others(write, link, end):
    shape = '<collision><geometry><box size="1 1 1"/></geometry></collision>'
    path = write(link.format(shape))
    assert main(["inertia", str(path), "a", "--mass", "1", "--write"]) == 0
    mended = path.read_bytes()
    path = write(link.format(shape))
    path.write_bytes(path.read_bytes().replace(b"\n", end))
    assert main(["inertia", str(path), "a", "--mass", "1", "--write"]) == 0
    assert b"<inertia " in mended
    assert path.read_bytes() == mended.replace(b"\n", end)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["b"], "no link `b` in robot `r`"),
        (["a", "c"], "expected one ROBOT and one LINK"),
        (["a", "--mass", "-1"], "`-1` is not a positive number"),
        (["a", "--mass", "1", "--density", "2"], "not allowed with"),
        (["a", "--from", "visual"], "no visual shapes to compute from; it has collision shapes"),
    ],
)
def test_errors_are_one_line(write, capsys, words, message):
    assert main(["inertia", str(write(BAD)), *words]) == 2
    err = capsys.readouterr().err
    assert message in err
    assert err.count("\n") == 1
    assert main(["inertia", "r.urdf.xacro", "--mass", "1"]) == 2


def test_links_without_shapes_say_what_to_do(write, capsys):
    path = write('<link name="empty"/>')
    assert main(["inertia", str(path), "empty"]) == 2
    err = capsys.readouterr().err
    assert "link `empty` has no shapes to compute an inertia from: add a <collision> or <visual> first" in err
