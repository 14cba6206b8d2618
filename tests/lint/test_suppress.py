"""Comments that suppress findings."""

from __future__ import annotations

import pytest

from urdfkit.lint import lint

TENSOR = '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="3"/>'
LINK = f'<link name="a">\n  <inertial><mass value="1"/>\n    {TENSOR}TRAIL\n  </inertial>\n</link>'


def codes(path) -> list[str]:
    return [finding.code for finding in lint(path)]


@pytest.mark.parametrize(
    ("text", "left"),
    [
        (LINK, ["I503"]),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore I503 -->"), []),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore -->"), []),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore J403, I503 measured so -->"), []),
        (LINK.replace("TRAIL", "<!-- urdfkit: ignore I502 -->"), ["I503"]),
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
