"""``urdfkit srdf``: what it writes, and what it keeps of an old file."""

import json
from xml.etree import ElementTree

import pytest

from urdfkit.cli import main

QUICK = ["--samples", "300"]


def written(capsys, *words):
    assert main(["srdf", "seven_dof_arm", *QUICK, *words]) == 0
    return capsys.readouterr()


@pytest.mark.slow
def test_the_text_is_an_srdf_of_the_robot(capsys):
    root = ElementTree.fromstring(written(capsys).out)
    assert root.attrib == {"name": "seven_dof_arm"}
    assert [(e.tag, e.get("base_link"), e.get("tip_link")) for e in root.find("group")] == [
        ("chain", "base_link", "gripper_roll_link")
    ]
    pairs = {(e.get("link1"), e.get("link2")): e.get("reason") for e in root.iter("disable_collisions")}
    assert pairs["shoulder_pan_link", "shoulder_pitch_link"] == "Adjacent"
    assert set(pairs.values()) <= {"Adjacent", "Default", "Always", "Never"}


@pytest.mark.slow
def test_json_has_every_pair_with_its_samples(capsys):
    values = json.loads(written(capsys, "--json", "--group", "wrist=elbow_pitch_link:gripper_roll_link").out)
    count = len(values["links"])
    assert len(values["pairs"]) == count * (count - 1) // 2
    assert [group["joints"] for group in values["groups"]] == [
        ["wrist_roll_joint", "wrist_pitch_joint", "gripper_roll_joint"]
    ]
    for pair in values["pairs"]:
        assert pair["hits"] <= pair["samples"] <= 300
        assert pair["rate_bound"] > pair["hits"] / pair["samples"] or pair["hits"] == pair["samples"]
        assert (pair["distance"] is not None) == (pair["hits"] == 0 and pair["reason"] in ("Never", None))


@pytest.mark.slow
def test_an_update_replaces_only_lines_of_ours(tmp_path, capsys):
    old = tmp_path / "old.srdf"
    old.write_text(
        '<robot name="seven_dof_arm">\n  <!-- <disable_collisions link1="a" link2="b" reason="Never"/> -->\n'
        '  <group name="mine"><joint name="elbow_pitch_joint"/></group>\n'
        '  <disable_collisions link1="gone" link2="base_link" reason="Never"/>\n'
        '  <disable_collisions link1="base_link" link2="shoulder_pan_link" reason="User"/>\n'
        '  <group_state name="home" group="mine"/>\n</robot>\n'
    )
    assert main(["srdf", "seven_dof_arm", *QUICK, "--update", str(old)]) == 0
    assert f"{old}: robot `seven_dof_arm` has no link `gone`; pairs" in capsys.readouterr().err
    new = old.read_text()
    for kept in ("<!-- <disable_collisions", '<group name="mine">', 'reason="User"', "<group_state"):
        assert new.count(kept) == 1
    assert '"gone"' not in new
    pairs = [
        frozenset((e.get("link1"), e.get("link2"))) for e in ElementTree.fromstring(new).iter("disable_collisions")
    ]
    assert len(pairs) == len(set(pairs)) > 10
    written(capsys, "--update", str(old))
    assert old.read_text() == new


def test_an_update_refuses_a_urdf_and_leaves_it_as_it_is(tmp_path, capsys):
    urdf = tmp_path / "arm.urdf"
    text = '<robot name="arm">\n  <link name="a"><collision></collision></link>\n</robot>\n'
    urdf.write_text(text)
    assert main(["srdf", "seven_dof_arm", *QUICK, "--update", str(urdf)]) == 2
    assert "is a URDF, not an SRDF" in capsys.readouterr().err
    assert urdf.read_text() == text


@pytest.mark.parametrize(
    ("name", "link", "message"),
    [
        ("six_dof_arm", "base_link", "old.srdf is the SRDF of robot `six_dof_arm`, not of `seven_dof_arm`; it was not"),
        ("seven_dof_arm", "arm_base", "links, such as `arm_base`, do not exist in robot `seven_dof_arm`; it was not"),
    ],
)
def test_an_update_refuses_the_srdf_of_another_robot(tmp_path, capsys, name, link, message):
    old = tmp_path / "old.srdf"
    text = f'<robot name="{name}">\n  <group name="g"><chain base_link="{link}" tip_link="hand"/></group>\n</robot>\n'
    old.write_text(text)
    assert main(["srdf", "seven_dof_arm", *QUICK, "--update", str(old)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert message in line
    assert old.read_text() == text


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--group", "arm=base_link"], "must be NAME=BASE:TIP"),
        (["--group", "arm=base_lnk:gripper_roll_link"], "no link `base_lnk`; did you mean `base_link`?"),
        (["--group", "arm=gripper_roll_link:base_link"], "`base_link` is not below `gripper_roll_link`"),
        (["--update", "absent.srdf"], "--update: no such file: absent.srdf"),
        (["--samples", "0"], "`0` is not a number of configurations"),
    ],
)
def test_mistakes_are_reported_in_a_line(capsys, words, message):
    assert main(["srdf", "seven_dof_arm", *words]) == 2
    assert message in capsys.readouterr().err


CHAIN = """<robot name="chain">
  <link name="base">{box}</link>
  <link name="upper">{mesh}</link>
  <link name="fore">{box}</link>
  <joint name="a" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
  <joint name="b" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
"""
BOX = '<collision><geometry><box size="0.05 0.05 0.1"/></geometry></collision>'
GONE = '<collision><geometry><mesh filename="gone.stl"/></geometry></collision>'


def test_links_whose_meshes_are_missing_disable_nothing(tmp_path, capsys):
    """A missing shape makes no link a neighbour of another, and no pair of its link safe."""
    path = tmp_path / "chain.urdf"
    path.write_text(CHAIN.format(box=BOX, mesh=GONE))
    assert main(["srdf", str(path), "--samples", "200", "--json"]) == 0
    out, err = capsys.readouterr()
    (pair,) = json.loads(out)["pairs"]
    assert (pair["links"], pair["reason"]) == (["base", "fore"], "Never")
    assert f"{path}:3:43: link `upper`: a collision shape is ignored: no file " in err
    path.write_text(CHAIN.format(box=BOX, mesh=BOX + GONE))
    assert main(["srdf", str(path), "--samples", "200", "--json"]) == 0
    reasons = {tuple(each["links"]): each["reason"] for each in json.loads(capsys.readouterr().out)["pairs"]}
    assert reasons == {("base", "upper"): "Adjacent", ("base", "fore"): "Never", ("upper", "fore"): "Adjacent"}
    path.write_text(CHAIN.format(box=BOX, mesh=BOX).replace(BOX, BOX + GONE, 1))
    assert main(["srdf", str(path), "--samples", "200", "--json"]) == 0
    reasons = {tuple(each["links"]): each["reason"] for each in json.loads(capsys.readouterr().out)["pairs"]}
    assert reasons == {("base", "upper"): "Adjacent", ("base", "fore"): None, ("upper", "fore"): "Adjacent"}
    path.write_text(CHAIN.format(box=BOX, mesh="").replace(BOX, BOX + GONE, 1))
    assert main(["srdf", str(path), "--samples", "200", "--json"]) == 0
    (pair,) = json.loads(capsys.readouterr().out)["pairs"]
    assert (pair["links"], pair["reason"]) == (["base", "fore"], "Adjacent")  # through a link that has no shapes


def test_an_update_keeps_the_pairs_of_links_whose_meshes_are_missing(tmp_path, capsys):
    path, old = tmp_path / "chain.urdf", tmp_path / "old.srdf"
    path.write_text(CHAIN.format(box=BOX, mesh=GONE))
    kept = '  <disable_collisions link1="base" link2="upper" reason="Adjacent"/>\n'
    gone = '  <disable_collisions link1="base" link2="fore" reason="Always"/>\n'
    old.write_text(f'<robot name="chain">\n{kept}{gone}</robot>\n')
    assert main(["srdf", str(path), "--samples", "200", "--update", str(old)]) == 0
    text = old.read_text()
    assert kept in text
    assert 'link2="fore" reason="Never"' in text
    assert "1 pair of links: 1 Never" in capsys.readouterr().err
