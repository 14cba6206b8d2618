# ruff: noqa: E501 - one case a line
from __future__ import annotations

import re
import time
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.description.xacro.evaluation.test_limits import FINITE, HOSTILE, hostile_file
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.errors import ResourceError

Write = Callable[[str, str], Path]


def faults(expanded: Expanded) -> list[tuple[str, str, str | None]]:
    return [(fault.kind, str(fault.position), fault.name) for fault in expanded.faults]


def tags(expanded: Expanded) -> list[str]:
    assert expanded.root is not None
    return [child.tag for child in expanded.root.children]


WHEELS = """<robot>
  <macro name="wheel" params="side y">
    <link name="${side}_wheel">
      <inertial>
        <ball_inertia m="2" r="${radius}"/>
      </inertial>
    </link>
    <joint name="${side}_joint" type="continuous">
      <origin xyz="0 ${y*width/2} 0"/>
    </joint>
  </macro>
  <macro name="ball_inertia" params="m r">
    <inertia ixx="${2*m*r*r/5}"/>
  </macro>
</robot>
"""


def test_unprefixed_macros_and_calls_and_late_properties(write: Write) -> None:
    """What the first tutorial's robot suffers from, all at once."""
    write("wheels.xacro", WHEELS)
    write("drive.gazebo", "HEAD\n<gazebo>\n<separation>${width + 0.1}</separation>\n</gazebo></robot>")
    main = write(
        "m.xacro",
        'HEAD\n<xacro:include filename="drive.gazebo"/>\n<xacro:include filename="wheels.xacro"/>\n'
        '<xacro:property name="width" value="0.4"/>\n<xacro:property name="radius" value="0.5"/>\n'
        '<wheel side="left" y="1"/>\n<wheel side="right" y="-1"/>\n</robot>',
    )
    expanded = expand_leniently(main)
    assert expanded.root is not None
    assert faults(expanded) == [("undefined-property", "drive.gazebo:3:1", "width")]
    assert str(expanded.faults[0].defined_at) == "m.xacro:4:1"
    assert expanded.root.find_all("gazebo")[0].children[0].text == "0.5"
    links = expanded.root.find_all("link")
    assert [link.get("name") for link in links] == ["left_wheel", "right_wheel"]
    assert [(c.macro, str(c.position)) for c in links[1].origin.expansions] == [("wheel", "m.xacro:7:1")]
    inertia = next(e for e in links[0].walk() if e.tag == "inertia")
    assert inertia.get("ixx") == "0.2"
    assert str(inertia.origin.position) == "wheels.xacro:13:5"
    assert [c.macro for c in inertia.origin.expansions] == ["ball_inertia", "wheel"]
    assert [(u.kind, u.name, str(u.position), [c.macro for c in u.expansions]) for u in expanded.unprefixed] == [
        ("directive", "macro", "wheels.xacro:2:3", []),
        ("directive", "macro", "wheels.xacro:12:3", []),
        ("call", "wheel", "m.xacro:6:1", []),
        ("call", "ball_inertia", "wheels.xacro:5:9", ["wheel"]),
        ("call", "wheel", "m.xacro:7:1", []),
        ("call", "ball_inertia", "wheels.xacro:5:9", ["wheel"]),
    ]
    assert expanded.unresolved == frozenset()


def test_prefixes_are_left_alone_on_request(write: Write) -> None:
    write("wheels.xacro", WHEELS)
    main = write("m.xacro", 'HEAD<xacro:include filename="wheels.xacro"/>\n<wheel side="left"/></robot>')
    expanded = expand_leniently(main, add_prefixes=False)
    assert expanded.unprefixed == ()
    assert tags(expanded) == ["macro", "macro", "wheel"]
    assert {fault.name for fault in expanded.faults} == {"side", "radius", "y", "width", "m", "r"}


def test_elements_of_urdf_and_sdf_are_no_calls(write: Write) -> None:
    expanded = expand_leniently(
        write(
            "m.xacro",
            'HEAD<xacro:macro name="link" params="name"><a/></xacro:macro><xacro:macro name="camera" params="name"><b/></xacro:macro>'
            '<xacro:macro name="topic_name"><c/></xacro:macro>'
            '<link name="l"/><gazebo><sensor><camera name="c"/></sensor><plugin><topic_name>/t</topic_name></plugin></gazebo></robot>',
        )
    )
    assert expanded.unprefixed == ()
    assert tags(expanded) == ["link", "gazebo"]


def test_directives_of_other_formats_are_left_alone(write: Write) -> None:
    expanded = expand_leniently(
        write("m.xacro", 'HEAD<gazebo><include><uri>model://a</uri></include><property name="p"/></gazebo></robot>')
    )
    assert expanded.unprefixed == ()
    assert expanded.faults == ()


def test_one_cause_makes_one_fault(write: Write) -> None:
    expanded = expand_leniently(
        write(
            "m.xacro",
            'HEAD\n<xacro:property name="a" value="${nowhere*2}"/>\n<xacro:property name="b" value="${a + 1}"/>\n'
            '<link name="${b}"/>\n<joint name="j${a}" x="${sin(b)}" y="1"/>\n</robot>',
        )
    )
    assert faults(expanded) == [("undefined-property", "m.xacro:2:1", "nowhere")]
    assert expanded.faults[0].attribute == "value"
    assert expanded.faults[0].candidates == ("a", "b")
    assert {(p.line, attribute) for p, attribute in expanded.unresolved} == {(4, "name"), (5, "name"), (5, "x")}
    assert expanded.root is not None
    assert "${" in (expanded.root.children[0].get("name") or "")
    assert expanded.root.children[1].get("y") == "1"


def test_names_stay_consistent_under_an_unknown_prefix(write: Write) -> None:
    expanded = expand_leniently(
        write("m.xacro", 'HEAD<link name="${p}base"/><joint name="j"><child link="${p}base"/></joint></robot>')
    )
    assert expanded.root is not None
    assert expanded.root.children[0].get("name") == expanded.root.children[1].children[0].get("link")


@pytest.mark.parametrize(
    ("text", "kind", "name", "remaining"),
    [
        ("<xacro:nothing/>", "undefined-macro", "nothing", []),
        ('<xacro:include filename="none.xacro"/>', "include-not-found", "none.xacro", []),
        ('<xacro:include filename="$(find no_such_pkg)/a"/>', "package-not-found", "no_such_pkg", []),
        ('<link name="$(arg n)"/>', "undefined-arg", "n", ["link"]),
        ('<link name="${1/0}"/>', "bad-expression", None, ["link"]),
        ('<link name="${a b}"/>', "bad-expression", None, ["link"]),
        ('<xacro:insert_block name="b"/>', "undefined-block", "b", []),
        ('<xacro:if value="maybe"><link/></xacro:if>', "conditional", None, []),
        ('<xacro:macro name="w" params="a b:=2"><x a="${a}" b="${b}"/></xacro:macro><xacro:w/>', "macro-arguments", "w", ["x"]),
        ('<xacro:macro name="w" params="a"><x a="${a}"/></xacro:macro><xacro:w a="1" c="2"/>', "macro-arguments", "w", ["x"]),
        ('<xacro:macro name="w" params="*b"><x/></xacro:macro><xacro:w/>', "macro-arguments", "w", []),
        ('<xacro:property name="a" value="${a}"/><link name="${a}"/>', "recursion", "a", ["link"]),
        ('<xacro:macro name="w"><xacro:w/><xacro:w/></xacro:macro><xacro:w/>', "recursion", None, []),
        ('<xacro:include filename="m.xacro"/><xacro:include filename="m.xacro"/>', "recursion", None, None),
        ("<xacro:property/>", "other", "name", []),
    ],
)  # fmt: skip
def test_each_kind_of_fault_and_what_is_left(
    write: Write, text: str, kind: str, name: str | None, remaining: list[str] | None
) -> None:
    expanded = expand_leniently(write("m.xacro", f"HEAD\n{text}\n<end/>\n</robot>"))
    assert [(fault.kind, fault.name) for fault in expanded.faults] == [(kind, name)]
    assert expanded.faults[0].position.line == 2
    assert "\n" not in expanded.faults[0].message
    if remaining is not None:
        assert tags(expanded) == [*remaining, "end"]


def test_faults_in_a_macro_come_once_per_chain(write: Write) -> None:
    expanded = expand_leniently(
        write(
            "m.xacro", 'HEAD<xacro:macro name="w">\n<link name="${x}"/></xacro:macro>\n<xacro:w/>\n<xacro:w/></robot>'
        )
    )
    assert [(str(f.position), [str(c.position) for c in f.expansions]) for f in expanded.faults] == [
        ("m.xacro:2:1", ["m.xacro:3:1"]),
        ("m.xacro:2:1", ["m.xacro:4:1"]),
    ]


def test_macros_defined_too_late_are_expanded(write: Write) -> None:
    expanded = expand_leniently(
        write(
            "m.xacro",
            'HEAD\n<xacro:w n="1"/>\n<w n="2"/>\n<xacro:macro name="w" params="n"><link name="${n}"/></xacro:macro></robot>',
        )
    )
    assert [(f.kind, f.position.line, str(f.defined_at)) for f in expanded.faults] == [
        ("undefined-macro", 2, "m.xacro:4:1"),
        ("undefined-macro", 3, "m.xacro:4:1"),
    ]
    assert tags(expanded) == ["link", "link"]


def test_an_undeclared_prefix_does_not_hide_the_rest(write: Write) -> None:
    expanded = expand_leniently(
        write("m.xacro", '<robot name="r">\n<xacro:property name="a" value="1"/><link name="l${a}"/></robot>')
    )
    assert [(f.kind, str(f.position)) for f in expanded.faults] == [("xml", "m.xacro:2:1")]
    assert expanded.root is not None
    assert expanded.root.children[0].get("name") == "l1"


@pytest.mark.parametrize("name", ["m.xacro", "m.urdf"])
def test_a_broken_entry_file_is_one_fault(write: Write, name: str) -> None:
    expanded = expand_leniently(write(name, "<robot>\n<link></robot>"))
    assert expanded.root is None
    assert [(f.kind, str(f.position)) for f in expanded.faults] == [("xml", f"{name}:2:1")]
    assert list(expanded.sources) == [name]


def test_a_missing_entry_file_is_an_error(write: Write) -> None:
    with pytest.raises(ResourceError, match="no such file"):
        expand_leniently("none.xacro")


def test_texts_replace_files(write: Write) -> None:
    path = write("m.xacro", "HEAD<a/></robot>")
    expanded = expand_leniently(path, texts={str(path.absolute()): '<robot name="r"><b/></robot>'})
    assert tags(expanded) == ["b"]


def test_the_first_tutorials_robot() -> None:
    path = (
        Path(__file__).parents[3].parent
        / "shared/seed_cases/simpleton_xacro/simpleton_description/urdf/simpleton.xacro"
    )
    if not path.is_file():
        pytest.skip("no seed cases next to the checkout")
    expanded = expand_leniently(path)
    assert expanded.root is not None
    chains = {
        link.get("name"): [(c.macro, Path(c.position.file).name, c.position.line) for c in link.origin.expansions]
        for link in expanded.root.find_all("link")
    }
    assert chains["left_wheel"] == [("wheel", "simpleton.xacro", 41)]
    assert chains["right_wheel"] == [("wheel", "simpleton.xacro", 42)]
    assert {(f.kind, f.name, f.position.line) for f in expanded.faults} == {
        ("undefined-property", "chassisWidth", 23),
        ("undefined-property", "wheelRadius", 24),
    }


CALLS = """HEAD
<xacro:macro name="wheel" params="name radius:=0.1 *origin"><link name="${name}"><xacro:insert_block name="origin"/></link></xacro:macro>
<xacro:macro name="castor" params="name"><link name="${name}"/></xacro:macro>
%s
<end/></robot>"""


@pytest.mark.parametrize(
    ("call", "links"),
    [
        ('<xacro:weel name="a"><origin/></xacro:weel>', ["a"]),
        ('<xacro:Wheel name="a" radius="0.2"><origin/></xacro:Wheel>', ["a"]),
        ('<xacro:caster name="a"/>', ["a"]),
        ('<xacro:weel name="a"/>', []),  # lacks its block
        ('<xacro:weel nam="a"><origin/></xacro:weel>', []),
        ('<xacro:caster/>', []),
        ('<xacro:chassis name="a"/>', []),
    ],
)  # fmt: skip
def test_calls_that_fit_a_macro_of_nearly_the_name_are_read_as_its(write: Write, call: str, links: list[str]) -> None:
    expanded = expand_leniently(write("m.xacro", CALLS % call))
    assert expanded.root is not None
    assert [(fault.kind, fault.position.line) for fault in expanded.faults] == [("undefined-macro", 4)]
    assert [link.get("name") for link in expanded.root.find_all("link")] == links
    assert ("meant" in expanded.faults[0].details) is bool(links)
    if links:
        assert [str(call.position) for call in expanded.root.find_all("link")[0].origin.expansions] == ["m.xacro:4:1"]


def test_files_that_include_each_other_are_read_once(write: Write) -> None:
    write("arm.xacro", 'HEAD<link name="arm"/>\n<xacro:include filename="m.xacro"/></robot>')
    expanded = expand_leniently(
        write("m.xacro", 'HEAD<xacro:include filename="arm.xacro"/><link name="base"/></robot>')
    )
    assert expanded.root is not None
    assert [(fault.kind, str(fault.position)) for fault in expanded.faults] == [("recursion", "arm.xacro:2:1")]
    assert [link.get("name") for link in expanded.root.find_all("link")] == ["arm", "base"]


def test_blocks_that_hold_each_other_many_times_are_one_fault(write: Write) -> None:
    # Each level that went on by itself would begin anew seven times.
    def held(name: str, times: int) -> str:
        return f'<xacro:insert_block name="{name}"/>' * times

    path = write(
        "robot.xacro",
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'<xacro:property name="a">{held("b", 7)}</xacro:property>\n'
        f'<xacro:property name="b">{held("a", 7)}<link name="x"/></xacro:property>\n'
        '<xacro:insert_block name="a"/>\n<link name="base"/>\n</robot>\n',
    )
    expanded = expand_leniently(path)
    assert [fault.kind for fault in expanded.faults] == ["recursion"]
    assert tags(expanded) == ["link"]


def test_names_of_files_that_are_too_long_are_reported(write: Write) -> None:
    main = write("m.xacro", f'HEAD\n<xacro:include filename="{"x" * 5000}.xacro"/>\n<link name="a"/></robot>')
    expanded = expand_leniently(main)
    (fault,) = expanded.faults
    assert (fault.kind, fault.position.line) == ("include-not-found", 2)
    assert fault.message.endswith("xxx.xacro has a name that is too long")
    assert tags(expanded) == ["link"]
    with pytest.raises(ResourceError, match="file name too long"):
        expanded.packages.resolve(f"{'x' * 5000}.stl", main)


def test_faults_in_an_infinite_recursion_are_reported_for_its_first_round(write: Write) -> None:
    macro = '<xacro:macro name="m" params=""><link name="${x}"/>\n<xacro:m y="1"/>\n<xacro:m/></xacro:macro>'
    expanded = expand_leniently(write("m.xacro", f'HEAD{macro}<xacro:m/><link name="left"/></robot>'))
    assert Counter(fault.kind for fault in expanded.faults) == {
        "undefined-property": 2,
        "macro-arguments": 2,
        "recursion": 1,
    }
    assert expanded.root is not None
    assert expanded.root.children[-1].get("name") == "left"


@pytest.mark.slow
@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_file_has_few_faults(write: Write, name: str) -> None:
    text, cause = HOSTILE[name]
    path = hostile_file(write, f'{text}\n<link name="left"/>')
    start = time.process_time()
    expanded = expand_leniently(path)
    assert time.process_time() - start < FINITE
    assert any(re.search(cause, fault.message) for fault in expanded.faults)
    assert len(expanded.faults) <= 3
    if expanded.root is not None:
        assert expanded.root.children[-1].get("name") == "left"
