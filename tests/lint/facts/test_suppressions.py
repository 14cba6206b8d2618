"""Comments that suppress findings."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

TENSOR = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/>'
LINK = f'<link name="a">\n  <inertial><mass value="1"/>\n    {TENSOR}TRAIL\n  </inertial>\n</link>'


def codes(path, **options) -> list[str]:
    """What is found, comments without use left out."""
    return [finding.code for finding in lint(path, **options) if finding.code != "E019"]


@pytest.mark.parametrize(
    ("text", "left"),
    [
        (LINK, ["I503"]),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore I503 -->"), []),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore -->"), []),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore J403, I503 measured so -->"), []),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore I502 -->"), ["I503"]),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore ZZZ -->"), ["I503", "E018"]),
        (LINK.replace(TENSOR, f"<!-- urdfkit: ignore I503 -->\n    {TENSOR}"), []),
        ("<!-- urdfkit: ignore I503 -->\n" + LINK, []),
        ("<!--urdfkit:ignore\n I503-->\n\n" + LINK, []),
        ("<!-- urdfkit: ignore I503 --><material name='m'/>\n" + LINK, ["I503"]),
        (LINK + "\n<!-- urdfkit: ignore I503 -->", ["I503"]),
        (LINK + "\n<!-- urdfkit: ignore-file I503 -->", []),
        (LINK + "\n<!-- urdfkit: ignore-file -->", []),
        (LINK + "\n<!-- urdfkit: ignore-file J401 -->", ["I503"]),
        (LINK + "\n<![CDATA[ <!-- urdfkit: ignore-file I503 --> ]]>", ["I503"]),
        ("<!-- about urdfkit: ignore nothing -->\n" + LINK, ["I503"]),
    ],
)
def test_what_a_comment_covers(write, text, left):
    assert codes(write("r.xacro", text.replace("TRAIL", ""))) == left


def test_comments_hold_where_the_finding_is_not_where_the_macro_is_called(write):
    text = f"""<xacro:macro name="m"><link name="a"><inertial><mass value="1"/>
{TENSOR}</inertial></link></xacro:macro>
<!-- urdfkit: ignore I503 -->
<xacro:m/>"""
    assert codes(write("r.xacro", text)) == ["I503"]
    assert codes(write("s.xacro", text.replace("</inertial>", "<!-- urdfkit: ignore I503 --></inertial>"))) == []


def test_comments_hold_in_their_own_file(write):
    write("arm.xacro", f"<robot>{LINK}</robot>".replace("TRAIL", ""))
    path = write("r.xacro", '<!-- urdfkit: ignore-file I503 -->\n<xacro:include filename="arm.xacro"/>')
    assert codes(path) == ["I503"]


def test_unknown_codes_are_reported_and_can_be_suppressed(write):
    assert codes(write("r.xacro", '<link name="a"/><!-- urdfkit: ignore I999 -->')) == ["E018"]
    assert codes(write("s.xacro", '<link name="a"/><!-- urdfkit: ignore I999 --><!-- urdfkit: ignore E018 -->')) == []
    assert lint("r.xacro", select=["I"]) == []


def unused(path, **options) -> list[tuple[int, str]]:
    found = lint(path, **options)
    return [(finding.line, finding.message) for finding in found if finding.code == "E019"]


def test_what_is_not_asked_for_is_not_called_unused(write):
    path = write("r.xacro", "<!-- urdfkit: ignore-file J403, T210, C705 -->\n" + LINK.replace("TRAIL", ""))
    assert unused(path) == [(2, "unused suppression of `J403`")]
    assert unused(path, target="mujoco") == []
    assert unused(path, ignore=["J4"]) == []
    assert unused(path, select=["E019", "J403"]) == [(2, "unused suppression of `J403`")]
    write("lost.xacro", '<!-- urdfkit: ignore-file J403 --><link name="a"/><xacro:include filename="gone.xacro"/>')
    assert unused("lost.xacro") == []


def test_one_robot_of_several_is_use_enough(write):
    write("p/package.xml", "<package><name>p</name></package>")
    write(
        "p/part.xacro",
        '<!-- urdfkit: ignore-file I503, J403 -->\n<xacro:if value="$(arg full)">' + LINK + "</xacro:if>",
    )
    head = '<xacro:arg name="full" default="{}"/><xacro:include filename="part.xacro"/><link name="{}"/>'
    full, bare = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">' + head, head
    write(
        "p/full.urdf.xacro",
        full.format("true", "b") + "<joint name='j' type='fixed'><parent link='b'/><child link='a'/></joint></robot>",
    )
    write(
        "p/bare.urdf.xacro",
        bare.format("false", "b").join(('<robot name="q" xmlns:xacro="http://www.ros.org/wiki/xacro">', "</robot>")),
    )
    assert [message for _, message in unused("p/bare.urdf.xacro")] == ["unused suppression of `I503`, `J403`"]
    assert [message for _, message in unused("p")] == ["unused suppression of `J403`"]
