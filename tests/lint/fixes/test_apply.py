"""Fixes: exact bytes, nothing worse, nothing outside, nothing half-written."""

from __future__ import annotations

import re
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.errors import ResourceError
from urdfkit.lint import lint
from urdfkit.lint.fixes.apply import fix
from urdfkit.lint.fixes.file_changes import FileChange, editable_folders
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

BAD = """<robot name="r">
  <!-- <macro name="commented"/> -->
  <macro name="part" params="name">
    <link name="${name}"/>
  </macro>
  <!-- é: ün -->
  <part name="base" ></part >
</robot>
"""
GOOD = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <!-- <macro name="commented"/> -->
  <xacro:macro name="part" params="name">
    <link name="${name}"/>
  </xacro:macro>
  <!-- é: ün -->
  <xacro:part name="base" ></xacro:part >
</robot>
"""


def mend(path: Path, *, within: Path | None = None, unsafe: bool = False, **options):
    return fix([Entry(path)], Options(**options), within=[within or path.parent], unsafe=unsafe)


@pytest.mark.parametrize(
    ("encode", "note"),
    [
        (lambda text: text.encode(), "plain"),
        (lambda text: text.replace("\n", "\r\n").encode(), "CRLF"),
        (lambda text: b"\xef\xbb\xbf" + text.encode(), "byte order mark"),
        (lambda text: text.replace("  ", "\t").encode(), "tabs"),
        (lambda text: b"\xff\xfe" + text.encode("utf-16-le"), "UTF-16 LE"),
        (lambda text: b"\xfe\xff" + text.encode("utf-16-be"), "UTF-16 BE"),
        (lambda text: text.encode("latin-1"), "Latin-1 in a comment"),
        (lambda text: text.rstrip("\n").encode(), "no final line end"),
        (lambda text: text.replace("é", "<![CDATA[").encode(), "markup in comments"),
    ],
)
def test_bytes_outside_the_edits_stay(write, encode, note):
    path = write("r.xacro", encode(BAD))
    fixed = mend(path)
    assert [change.after for change in fixed.changes] == [encode(GOOD)], note
    assert path.read_bytes() == encode(BAD), "nothing is written before write()"
    fixed.changes[0].write()
    assert path.read_bytes() == encode(GOOD)
    in_utf8 = "UTF-16" not in note and "Latin-1" not in note
    assert [finding.code for finding in lint(path)] == ([] if in_utf8 else ["E001"])
    assert fixed.outcome.findings == tuple(lint(path))
    assert mend(path).changes == ()


pieces = st.sampled_from(
    [
        '<part name="a{n}"/>',
        "<part name='a{n}'></part>",
        '<link name="b{n}"/>',
        "<!-- <part/> -->",
        "\n",
        "\t<!-- ü -->",
    ]
)


@pytest.mark.slow
@given(st.lists(pieces, max_size=8), st.booleans())
def test_fixing_is_idempotent_and_changes_prefixes_only(tmp_path_factory, parts, bound):
    path = tmp_path_factory.mktemp("fix") / "r.xacro"
    namespace = ' xmlns:xacro="http://www.ros.org/wiki/xacro"' if bound else ""
    body = "".join(part.format(n=number) for number, part in enumerate(parts))
    macro = '<macro name="part" params="name"><material name="${name}"/></macro>'
    before = f'<robot name="r"{namespace}>{macro}{body}</robot>'
    path.write_text(before)
    fixed = mend(path)
    after = fixed.changes[0].after.decode()
    stripped = after.replace("xacro:part", "part").replace("xacro:macro", "macro")
    assert stripped.replace(' xmlns:xacro="http://www.ros.org/wiki/xacro"', "") == before.replace(namespace, "")
    assert not {"X101", "X102"} & {finding.code for finding in fixed.outcome.findings}
    fixed.changes[0].write()
    assert mend(path).changes == ()


def test_several_files_and_the_namespace_of_each(write):
    write("macros.xacro", '<robot><macro name="part" params="n"><link name="${n}"/></macro></robot>')
    path = write("r.xacro", '<xacro:include filename="macros.xacro"/>\n<part n="base"/>')
    fixed = mend(path)
    assert {change.shown: change.after.decode() for change in fixed.changes} == {
        "macros.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">'
        '<xacro:macro name="part" params="n"><link name="${n}"/></xacro:macro></robot>',
        "r.xacro": path.read_text().replace("<part", "<xacro:part"),
    }
    assert fixed.fixed == {"X101": 1, "X102": 1}
    assert fixed.outcome.findings == ()


def test_only_what_is_selected_is_fixed_and_never_for_the_worse(write):
    path = write("r.xacro", BAD)
    # To prefix the call alone would call a macro that is not defined... but the linter reads it with its prefix.
    fixed = mend(path, select=("X102",))
    assert all(b'<macro name="part"' in change.after for change in fixed.changes)


def test_files_outside_are_not_touched(write):
    write("other/macros.xacro", '<robot><macro name="part" params="n"><link name="${n}"/></macro></robot>')
    path = write("mine/r.xacro", '<xacro:include filename="../other/macros.xacro"/>\n<part n="base"/>')
    fixed = mend(path)
    assert [change.shown for change in fixed.changes] in ([], ["mine/r.xacro"])
    assert fixed.notes == ("other/macros.xacro was not fixed: the file is outside the linted folders",)
    link = Path("mine/linked.xacro")
    link.symlink_to("../other/macros.xacro")
    assert mend(link, within=Path("mine")).changes == ()


def test_links_stay_links_and_are_fixed_once(write):
    real = write("real/r.xacro", BAD)
    link = Path("link.xacro")
    link.symlink_to(real)
    Path("linked").symlink_to("real")
    both = fix([Entry(link), Entry(real), Entry(Path("linked/r.xacro"))], Options(), within=[Path()])
    assert [change.after.decode() for change in both.changes] == [GOOD]
    both.changes[0].write()
    assert link.is_symlink()
    assert real.read_text() == GOOD


def test_what_may_be_changed(write):
    write("ws/p/package.xml", "<package/>")
    inside = write("ws/p/urdf/r.urdf", '<link name="a"/>')
    alone = write("alone/r.urdf", '<link name="a"/>')
    assert editable_folders([inside]) == [Path("ws/p").resolve()]
    assert editable_folders([alone, Path("ws")]) == [Path("alone").resolve(), Path("ws").resolve()]
    assert editable_folders([Path("simpleton")]) == []


def test_unsafe_fixes_are_applied_on_request_only(write):
    joint = '<joint name="j" type="revolute"><parent link="a"/><child link="b"/>{}</joint>'
    links = '<link name="a"/>\n<link name="b"/>\n'
    path = write("r.xacro", links + joint.format('<limit lower="1.5" upper="-1" effort="1" velocity="1"/>'))
    assert mend(path).changes == ()
    (change,) = mend(path, unsafe=True).changes
    assert b'lower="-1" upper="1.5"' in change.after
    assert change.diff().splitlines()[:2] == ["--- a/r.xacro", "+++ b/r.xacro"]
    assert sum(line.startswith("+") for line in change.diff().splitlines()) == 2


def test_a_file_changed_meanwhile_is_left_alone(write):
    path = write("r.xacro", BAD)
    (change,) = mend(path).changes
    path.write_text("somebody else was here")
    with pytest.raises(ResourceError, match=r"r\.xacro was changed while"):
        change.write()
    assert path.read_text() == "somebody else was here"


def test_a_change_for_the_worse_is_rolled_back(write, monkeypatch):
    from urdfkit.lint.finding import Edit, Fix
    from urdfkit.lint.rules.tree.multiple_roots import MultipleRoots

    original = MultipleRoots.at

    def destructive(self, model, where, message, **options):
        span = model.span(where.origin.position, "name")
        return original(self, model, where, message, **{**options, "fix": Fix("safe", "Break it", (Edit(span, "<"),))})

    monkeypatch.setattr(MultipleRoots, "at", destructive)
    path = write("r.xacro", BAD.replace("</robot>", '<link name="a"/><link name="b"/></robot>'))
    fixed = mend(path)
    (note,) = fixed.notes
    assert note.startswith(
        "T203 at r.xacro:8 was not fixed: the fix would have caused E001 at r.xacro:8, unexpected `<`: "
    )
    assert [change.after.decode() for change in fixed.changes] == [
        GOOD.replace("</robot>", '<link name="a"/><link name="b"/></robot>')
    ]
    assert isinstance(fixed.changes[0], FileChange)


WHEEL = """<robot name="cart">
  <link name="base"/>
  <link name="wheel">
    <inertial>
      <mass value="{mass}"/>
      <inertia ixx="0.4" ixy="0" ixz="0" iyy="0.4" iyz="0" izz="0.5"/>
    </inertial>
    <visual><geometry><cylinder radius="0.3" length="0.1"/></geometry></visual>
    <collision><geometry><cylinder radius="0.3" length="0.1"/></geometry></collision>
  </link>
  <joint name="spin" type="{type}">
    <parent link="base"/>
    <child link="wheel"/>
    <axis xyz="0 0 1"/>
  </joint>
</robot>
"""


@pytest.mark.parametrize(
    ("wrong", "right", "code", "uncovered"),
    [
        ("<inertail>", "<inertial>", "E008", "I507"),  # the inertia in it was hidden
        (
            '<mass value="-0.2\'"/>',
            '<mass value="-0.2"/>',
            "E016",
            "I501",
        ),  # on the very value: somebody wrote the minus
    ],
)
def test_what_a_fix_uncovers_does_not_withhold_it(write, wrong, right, code, uncovered):
    tag = wrong.partition(" ")[0].strip("<>")
    good = WHEEL.format(mass="0.2", type="continuous")
    meant = re.sub(rf"<{right[1:5]}\w*( [^>]*)?>", lambda _: wrong, good, count=1)
    path = write("r.urdf", meant.replace("</inertial>", f"</{tag}>") if tag == "inertail" else meant)
    assert uncovered not in {finding.code for finding in lint(path)}
    fixed = fix([Entry(path)], Options(), within=[path.parent], unsafe=True, only=lambda finding: finding.code == code)
    left = {finding.code for finding in fixed.outcome.findings}
    assert fixed.notes == ()
    assert code not in left
    assert uncovered in left
    assert right in fixed.changes[0].text


def test_what_is_for_the_worse_leaves_other_findings_of_its_rule_their_fixes(write):
    path = write(
        "r.urdf",
        """<robot name="r">
  <link name="a"/><link name="b"/><link name="c"/><link name="d"/>
  <joint name="ab" type="Fixed"><parent link="a"/><child link="b"/></joint>
  <joint name="bc" type="hinge"><parent link="b"/><child link="c"/></joint>
  <joint name="cd" type="rigid"><parent link="c"/><child link="d"/></joint>
</robot>
""",
    )
    fixed = mend(path, unsafe=True)
    (note,) = fixed.notes
    assert note.startswith("J402 at r.urdf:4 was not fixed: the fix would have caused J403 at r.urdf:4, ")
    (change,) = fixed.changes
    assert change.after.decode() == path.read_text().replace('"Fixed"', '"fixed"').replace('"rigid"', '"fixed"')
    assert fixed.fixed == {"J402": 2}


def test_what_names_the_names_that_a_fix_took_away_is_caused_by_it(write, monkeypatch):
    from urdfkit.lint.fix_builders import new_value
    from urdfkit.lint.rules.names.link_joint_same_name import LinkJointSameName

    original = LinkJointSameName.at

    def destructive(self, model, where, message, **options):
        link = next(link for link in model.robot.links if link.name == "wheel")
        fix = new_value(model, link.element, "name", "whel", "safe", "Break it")
        return original(self, model, where, message, **{**options, "fix": fix})

    monkeypatch.setattr(LinkJointSameName, "at", destructive)
    path = write("r.urdf", WHEEL.format(mass="200", type="continuous").replace('"spin"', '"wheel"'))
    fixed = mend(path)
    assert fixed.changes == ()
    (note,) = fixed.notes
    assert "was not fixed: the fix would have caused T202 at r.urdf:3, " in note


@pytest.mark.git
@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_git_applies_what_is_shown(write, end):
    path = write("urdf/r.xacro", BAD.replace("\n", end).encode())
    (change,) = mend(path).changes
    Path("mend.diff").write_bytes(change.diff().encode())
    subprocess.run(["git", "apply", "mend.diff"], check=True)
    assert path.read_bytes() == GOOD.replace("\n", end).encode()


def test_a_file_whose_lines_end_by_carriage_returns_is_one_line_of_a_diff(write):
    (change,) = mend(write("r.xacro", BAD.replace("\n", "\r").encode())).changes
    assert [line[:1] for line in change.diff().split("\n")] == ["-", "+", "@", "-", "\\", "+", "\\", ""]


def test_the_fix_of_a_defect_that_another_fix_uncovers_is_counted(write):
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    joint = f'<parent link="a"/><child link="b"/><axis xyz="0 0 2"/>{limit}'
    text = f'<robot name="r"><link name="a"/><link name="b"/><joint name="j" type="Revolute">{joint}</joint></robot>'
    path = write("r.urdf", text.encode())
    fixed = fix([Entry(path)], Options(), within=[path.parent])
    assert fixed.fixed == {"J402": 1, "J412": 1}
    assert b'<axis xyz="0 0 1"/>' in fixed.changes[0].after
