"""A run on nodes of our own comes to what a run on minidom's comes to."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from urdfkit.description.expand import expand_leniently, recovered
from urdfkit.description.packages import Packages
from urdfkit.description.recovery import RecoveringRun
from urdfkit.resources import robots_dir

SHARED = Path(__file__).parents[3] / "shared"

ODD = {
    "blocks": """<xacro:macro name="m" params="n *one **two"><link name="${n}">
        <visual><xacro:insert_block name="one"/><geometry><box size="1 1 1"/></geometry></visual></link>
        <xacro:insert_block name="two"/></xacro:macro>
        <xacro:m n="a"><origin xyz="0 0 1"/><link><link name="b"/><link name="${n}"/></link></xacro:m>
        <xacro:m n="c"><xacro:if value="1"><origin xyz="0 0 2"/></xacro:if><gazebo><link name="d"/></gazebo>
        </xacro:m>""",
    "property blocks": """<xacro:property name="p"><origin xyz="1 2 3"/><mass value="1"/></xacro:property>
        <link name="a"><inertial><xacro:insert_block name="p"/></inertial></link>
        <link name="b"><inertial><xacro:insert_block name="p"/><xacro:insert_block name="q"/></inertial></link>""",
    "attributes": """<link name="a"><xacro:attribute name="k" value="${1 + 1}"/><visual xacro:x="1"/></link>
        <xacro:element xacro:name="${'joint'}" name="j"/><link name="é${'ü'}"/>""",
    "text": """<gazebo><plugin name="p">a<b>one &amp; two</b>$(arg none) ${k} c <!-- ${x} --> d ${e} f</plugin></gazebo>
        <link name="a">one<!-- c -->two<origin/> three <?pi x?> four</link>""",
    "unprefixed": """<macro name="m" params="n"><link name="${n}"/></macro><m n="a"/><xacro:m n="b"/><m n="c" z="1"/>
        <property name="k" value="2"/><link name="l${k}"/><if value="${k}"><link name="yes"/></if>""",
    "too late": """<link name="${k}"/><xacro:m/><xacro:property name="k" value="z"/>
        <xacro:macro name="m" params=""><link name="m"/></xacro:macro>""",
    "namespaces": """<gz:link xmlns:gz="urn:x" gz:name="a"><gz:b/></gz:link><sensor xmlns="urn:y"><a/></sensor>
        <xacro:macro name="m" params="" xmlns:k="urn:k"><link name="a" k:a="1"/></xacro:macro><xacro:m/>""",
    "unbound": """<gz:link name="a"/><xacro:macro name="m" params=""><link name="b"/></xacro:macro><xacro:m/>""",
    "read by minidom": """<link name="a"><![CDATA[${x}]]></link><xacro:macro name="m" params="*b"><xacro:insert_block
        name="b"/></xacro:macro><xacro:m><link name="b"/></xacro:m><!-- xacro:eval-comments --><!-- ${undefined} -->""",
    "values": """<xacro:property name="a" value="${b * 2}"/><xacro:property name="b" value="3"/><link name="${a}${b}"/>
        <xacro:property name="t" value="tt"/><link name="${t}-${a / b}-${a - 7}-${pi}-${True}-${t == 'tt'}"/>
        <link name="${c}"/><xacro:property name="c" value="${c}"/><link name="${1/0} ${b/0} $${b} ${'}'}"/>
        <xacro:macro name="m" params="b c:=${b} d:=^|9"><link name="${b} ${c} ${d}"/></xacro:macro>
        <xacro:m b="x"/><xacro:m b="${b}" c="" d="4"/><xacro:m/><link name="${list([1])} ${_} ${__x} ${a.b}"/>""",
    "recursion": """<xacro:macro name="m" params="n"><link name="${n}"/>
        <xacro:if value="${n > 0}"><xacro:m n="${n - 1}"/>
        </xacro:if></xacro:macro><xacro:m n="3"/><xacro:macro name="w" params=""><xacro:w/></xacro:macro><xacro:w/>""",
}


def compared(path: Path) -> tuple[Any, Any]:
    plain = recovered(RecoveringRun(str(path), {}, Packages(near=path), mend_prefixes=True)).outcome()
    return looked_at(expand_leniently(path)), looked_at(plain)


def looked_at(expanded: Any) -> Any:
    """Return what rules see of it."""
    root = expanded.root
    elements = [(repr(one), one.origin) for one in root.walk()] if root is not None else []
    names = list(expanded.macros.values()), dict(expanded.properties), expanded.files, list(expanded.sources)
    return elements, expanded.faults, expanded.unprefixed, expanded.unresolved, expanded.warnings, *names


@pytest.mark.parametrize("name", ODD)
def test_odd_files_come_out_alike(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "m.xacro"
    path.write_text(f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{ODD[name]}\n</robot>', "utf-8")
    ours, theirs = compared(path)
    assert ours == theirs
    assert ours[0]


def test_shipped_robots_come_out_alike() -> None:
    paths = sorted(robots_dir().rglob("*.xacro"))
    assert len(paths) > 20
    assert [str(path) for path in paths if not _is_alike(path)] == []


@pytest.mark.skipif(not SHARED.is_dir(), reason="the corpus is not here")
def test_the_corpus_comes_out_alike() -> None:
    paths = [path for folder in ("seed_cases", "corpus") for path in sorted((SHARED / folder).rglob("*.xacro"))]
    assert [str(path) for path in paths[::10] if not _is_alike(path)] == []


def _is_alike(path: Path) -> bool:
    ours, theirs = compared(path)
    return bool(ours == theirs)
