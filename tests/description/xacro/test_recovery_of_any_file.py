"""Any file is expanded with recovery; what has no fault is expanded as without recovery."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from urdfkit.description.xacro.expand import expand, expand_leniently
from urdfkit.description.xml.reader import MAX_MADE_DEPTH
from urdfkit.errors import UrdfkitError, XmlError
from urdfkit.resources import robots_dir

SHARED = Path(__file__).parents[4] / "shared"

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
    "no namespace": """<gz:a xmlns:gz="urn:x"><sensor xmlns="" a="${1}" xacro:y="1"><b/></sensor></gz:a>
        <link name="a"/>""",
    "a number for a name": """<link name="a"><xacro:attribute name="${1}" value=""/><xacro:attribute name="${True}"
        value="1"/></link>""",
    "escapes": """<xacro:property name="k" value="2"/><link name="$${k}$$${k} ${{'a': k}['a']} ${{}} $(eval k) ${k"/>
        <link name="&#36;{k}">${'}'} $$(arg k) $ $(</link>""",
    "scopes": """<xacro:macro name="m" params=""><xacro:property name="p" value="1" scope="parent"/>
        <xacro:property name="g" value="${late}" scope="global"/><xacro:property name="l" value="3"/></xacro:macro>
        <xacro:m/><link name="${p}${g}${l}"/><xacro:property name="late" value="4"/><link name="${p}${g}"/>""",
    "recursion": """<xacro:macro name="m" params="n"><link name="${n}"/>
        <xacro:if value="${n > 0}"><xacro:m n="${n - 1}"/>
        </xacro:if></xacro:macro><xacro:m n="3"/><xacro:macro name="w" params=""><xacro:w/></xacro:macro><xacro:w/>""",
}


def expanded_both_ways(path: Path) -> tuple[Any, Any]:
    """Return what recovery and strict expansion make of a file; None for what strict expansion refuses."""
    recovered = expand_leniently(path, add_prefixes=False)
    try:
        return recovered, expand(path, run_xacro=True)
    except UrdfkitError:
        return recovered, None


def shown(expanded: Any) -> Any:
    """Return what rules see."""
    elements = [(repr(one), one.origin) for one in expanded.root.walk()]
    names = list(expanded.macros.values()), dict(expanded.properties), expanded.files, list(expanded.sources)
    return elements, expanded.warnings, expanded.xml, *names


def is_consistent(path: Path) -> bool:
    """Whether there are faults exactly if strict expansion fails, and else the same result."""
    recovered, strict = expanded_both_ways(path)
    if strict is None:
        return bool(recovered.faults)
    return not recovered.faults and not recovered.unresolved and shown(recovered) == shown(strict)


@pytest.mark.parametrize("name", ODD)
def test_odd_files_have_a_fault_exactly_if_they_are_refused(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "m.xacro"
    path.write_text(f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n{ODD[name]}\n</robot>', "utf-8")
    assert is_consistent(path)
    assert expand_leniently(path).root is not None


@pytest.mark.slow
def test_bundled_robots_are_expanded_as_without_recovery() -> None:
    paths = sorted(robots_dir().rglob("*.xacro"))
    assert len(paths) > 20
    assert [str(path) for path in paths if not is_consistent(path)] == []


@pytest.mark.slow
@pytest.mark.skipif(not SHARED.is_dir(), reason="no corpus next to the checkout")
def test_the_corpus_is_expanded_as_without_recovery() -> None:
    paths = [path for folder in ("seed_cases", "corpus") for path in sorted((SHARED / folder).rglob("*.xacro"))]
    assert [str(path) for path in paths[::10] if not is_consistent(path)] == []


_VALUES = st.lists(
    st.sampled_from(
        [
            "1",
            "0",
            "x",
            "${k}",
            "${late}",
            "${k+1}",
            "${undefined}",
            "$(arg&#32;a)",
            "$(eval&#32;1+k)",
            "$(find&#32;no)",
            "${{}}",
            "${{'a':k}['a']}",
            "$${k}",
            "$$${k}",
            "${'}'}",
            "${",
            "$(",
            "}",
            "${p}",
            "${1/0}",
            "$(eval&#32;arg('a'))",
            "é",
            "&amp;",
            "&lt;",
            "&#36;{k}",
            "&#10;",
            "$",
            "${n}",
            "${'%s'%k}",
            "${''}",
            "${None}",
            "${1==1}",
            "${xacro.warning('w')}",
        ]
    ),
    min_size=1,
    max_size=3,
).map("".join)
_TAGS = [
    "link",
    "link",
    "joint",
    "origin",
    "gazebo",
    "plugin",
    "m",
    "if",
    "macro",
    "property",
    "xacro:if",
    "xacro:unless",
    "xacro:macro",
    "xacro:property",
    "xacro:m",
    "xacro:n",
    "xacro:call",
    "xacro:insert_block",
    "xacro:arg",
    "xacro:attribute",
    "xacro:element",
    "foo",
]
_ATTRIBUTES = st.dictionaries(
    st.sampled_from(
        [
            "name",
            "value",
            "params",
            "default",
            "scope",
            "macro",
            "k",
            "n",
            "xacro:name",
            "xacro:y",
            "xmlns",
            "xmlns:gz",
            "xml:space",
        ]
    ),
    _VALUES | st.sampled_from(["m", "n", "k", "p", "b", "late", "n *b", "**b", "n:=^|2", "parent", "global", "urn:x"]),
    max_size=3,
)
_TEXTS = _VALUES | st.sampled_from(
    [" ", "\n", "\r", "\u00a0", "<!-- ${x} -->", "<?pi ${x}?>", "<![CDATA[${k}]]>", "<!-- xacro:eval-comments -->"]
)


@st.composite
def _elements(draw: st.DrawFn, inside: st.SearchStrategy[str]) -> str:
    tag, below = draw(st.sampled_from(_TAGS)), draw(st.lists(inside, max_size=3))
    attributes = {"name": "m", "value": "1"} if "call" not in tag and tag not in ("xacro:m", "xacro:n") else {}
    written = "".join(f' {name}="{value}"' for name, value in {**attributes, **draw(_ATTRIBUTES)}.items())
    return f"<{tag}{written}>{''.join(below)}</{tag}>"


_BODIES = st.lists(st.recursive(_TEXTS, _elements, max_leaves=8), min_size=1, max_size=5).map("\n".join)
_HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:property name="k" value="2"/>'


@pytest.mark.slow
@settings(max_examples=80, suppress_health_check=[HealthCheck.too_slow, HealthCheck.function_scoped_fixture])
@given(_BODIES, st.sampled_from(["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"]), st.sampled_from("\n\r"))
@example('<xacro:attribute name="${1}" value=""/>', "utf-8", "\n")
@example("<link name='a'><![CDATA[${k}]]></link>", "utf-16-le", "\n")
@example("<sensor xmlns=''/>", "utf-8-sig", "\r")
@example("<link name='\0'/>", "utf-8", "\n")
def test_any_text_has_a_fault_exactly_if_it_is_refused(tmp_path: Path, body: str, encoding: str, end: str) -> None:
    path = tmp_path / "m.xacro"
    path.write_bytes(f"{_HEAD}\n{body}\n</robot>".replace("\n", end).encode(encoding, "replace"))
    assert is_consistent(path)
    expand_leniently(path)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("inside", "calls"), [("<a><b><c>{}</c></b></a>", 200), ("<a>{}" + "<b>" * 150 + "</b>" * 150 + "</a>", 300)]
)
def test_what_macros_nest_too_deep_is_refused(inside: str, calls: int, tmp_path: Path) -> None:
    again = '<xacro:if value="${n > 0}"><xacro:m n="${n - 1}"/></xacro:if>'
    macro = f'<xacro:macro name="m" params="n">{inside.format(again)}</xacro:macro><xacro:m n="{calls}"/>'
    path = tmp_path / "m.xacro"
    path.write_text(f"{_HEAD}{macro}</robot>")
    (fault,) = expand_leniently(path).faults
    assert fault.message == f"here, macros and blocks nest elements deeper than {MAX_MADE_DEPTH}"
    with pytest.raises(XmlError, match="nest elements deeper"):
        expand(path)
