"""An expansion with a memory is equal to a fresh one after every edit."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import pytest

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xacro.memory import Memory
from urdfkit.errors import UrdfkitError

ENTRY = """<?xml version="1.0"?>
<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:arg name="side" default="left"/>
  <xacro:property name="size" value="0.1"/>
  <xacro:property name="double" value="${size * 2}"/>
  <xacro:property name="values" value="${dict(a=1, b=[1, 2])}"/>
  <xacro:property name="block"><origin xyz="${size} 0 0"/></xacro:property>
  <xacro:include filename="parts.xacro"/>
  <!-- links -->
  <link name="base"><visual><geometry><box size="${size} ${double} 1"/></geometry></visual></link>
  <link name="plain"><inertial><mass value="1"/></inertial></link>
  <xacro:segment i="1" parent="base"/>
  <xacro:segment i="2" parent="segment_1" length="${double}"/>
  <xacro:if value="${size > 0.05}"><link name="large_${size}"/></xacro:if>
  <xacro:unless value="$(arg side)"><link name="never"/></xacro:unless>
  <xacro:if value="${values['a'] == 1}">
    <xacro:property name="late_${1}" value="3"/><xacro:property name="size" value="0.3" scope="parent"/>
  </xacro:if>
  <xacro:wheel name="$(arg side)_wheel"><xacro:insert_block name="block"/></xacro:wheel>
  <xacro:wheel name="other_wheel"><origin xyz="0 ${reach} 0"/></xacro:wheel>
  <joint name="j" type="fixed"><parent link="base"/><child link="plain"/><xacro:insert_block name="block"/></joint>
  <link name="last"><visual><geometry><box size="${double} ${reach} ${later}"/></geometry></visual></link>
  <xacro:property name="later" value="5"/>
  <gazebo reference="base"><plugin name="p" filename="f"><side>$(arg side)</side><wheel>a</wheel></plugin></gazebo>
</robot>
"""
PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="reach" value="${size + 1}"/>
  <xacro:macro name="segment" params="i parent length:=1 name:=^|none">
    <xacro:property name="local" value="${length * 2}"/>
    <link name="segment_${i}">
      <visual><geometry><box size="${size} ${local} ${reach}"/></geometry></visual>
      <collision><geometry><box size="1 1 1"/></geometry></collision>
    </link>
    <joint name="joint_${i}" type="fixed"><parent link="${parent}"/><child link="segment_${i}"/></joint>
  </xacro:macro>
  <xacro:macro name="wheel" params="name *origin">
    <link name="${name}"><visual><xacro:insert_block name="origin"/></visual></link>
    <xacro:rim name="${name}" size="${size}"/>
  </xacro:macro>
  <xacro:macro name="rim" params="name size"><link name="${name}_rim"><mass value="${size}"/></link></xacro:macro>
  <link name="from_parts"><mass value="${reach}"/></link>
</robot>
"""
WORDS = (
    *("size", "double", "reach", "segment", "wheel", "rim", "side", "block", "values", "later", "local", "name", "i"),
    *(
        "parent",
        "length",
        "xacro:",
        "macro",
        "property",
        "value",
        "link",
        "params",
        "origin",
        "0.1",
        "1",
        "2",
        "include",
    ),
)
PIECES = (
    *(
        "x",
        "1",
        "0.5",
        "-",
        '"',
        "<",
        ">",
        "<!--",
        "-->",
        "${",
        "}",
        "\n",
        "é",
        " ",
        "/",
        "xacro:",
        "&amp;",
        "\r\n",
        "text",
    ),
    *(
        '<link name="q"/>',
        ' name="b"',
        "<![CDATA[x]]>",
        "${reach}",
        "$(arg side)",
        "${undefined}",
        "<wheel/>",
        "^",
        ":=",
    ),
    *(
        '<xacro:property name="size" value="7"/>',
        '<xacro:property name="wheel" value="3"/>',
        '<xacro:rim name="r" size="1"/>',
    ),
    *('<xacro:arg name="side" default="1"/>', '<xacro:macro name="rim" params="name size"/>', '<xacro:if value="1">'),
    *('<xacro:property name="size" value="8" scope="global"/>', '<xacro:attribute name="a" value="1"/>', "</xacro:if>"),
    *(
        "${xacro.warning('w')}",
        "${xacro.arg('side')}",
        "$(eval 1 + 1)",
        "$(find nowhere)",
        '<xacro:include filename="parts.xacro"/>',
    ),
    *(
        '<xacro:include filename="parts.xacro" ns="p"/>',
        "<xacro:p.rim name='n' size='2'/>",
        '<property name="size" value="2"/>',
    ),
)


def edited(text: str, dice: random.Random) -> str:
    """Return a text with one change: typed, deleted, replaced, pasted or renamed."""
    at, kind = dice.randrange(len(text) + 1), dice.random()
    if kind < 0.3:
        word = dice.choice(WORDS)
        places = [found.start() for found in re.finditer(re.escape(word), text)]
        if places:
            at = dice.choice(places)
            return text[:at] + dice.choice((*WORDS, word + "x")) + text[at + len(word) :]
    if kind < 0.5:
        ends = [found.end() for found in re.finditer(">", text)]
        at = dice.choice(ends) if ends else at
        return text[:at] + dice.choice(PIECES) + text[at:]
    if kind < 0.7:
        return text[:at] + dice.choice(PIECES) + text[at:]
    if kind < 0.85:
        return text[:at] + text[at + dice.randrange(1, 6) :]
    lines = text.splitlines(keepends=True)
    index = dice.randrange(len(lines))
    lines[index:index] = [lines.pop(dice.randrange(len(lines)))] if dice.random() < 0.5 else [dice.choice(lines)]
    return "".join(lines)


def facts(expanded: Any) -> Any:
    root = expanded.root
    elements = [f"{element!r} {element.origin}" for element in root.walk()] if root is not None else None
    return (
        elements,
        expanded.faults,
        expanded.warnings,
        expanded.unresolved,
        set(expanded.unprefixed),
        dict(expanded.macros),
        dict(expanded.properties),
        expanded.files,
        list(expanded.sources),
    )


def outcome(entry: str, packages: Packages, texts: dict[str, str], memory: Memory | None) -> Any:
    try:
        expanded = expand_leniently(entry, packages=packages, texts=texts, memory=memory)
    except UrdfkitError as error:
        return type(error), str(error)
    return facts(expanded)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_a_remembered_expansion_is_equal_to_a_fresh_one(seed: int, tmp_path: Path) -> None:
    dice = random.Random(seed)
    originals = {str(tmp_path / "arm.xacro"): ENTRY, str(tmp_path / "parts.xacro"): PARTS}
    for path, text in originals.items():
        Path(path).write_text(text, "utf-8")
    entry, texts = str(tmp_path / "arm.xacro"), dict(originals)
    packages = Packages(near=Path(entry))
    memory = Memory()
    for _ in range(60):
        path = dice.choice(list(texts))
        broken = texts
        texts = {**texts, path: edited(originals[path] if dice.random() < 0.3 else texts[path], dice)}
        assert outcome(entry, packages, texts, memory) == outcome(entry, packages, texts, None)
        if dice.random() < 0.3:
            texts = broken


def test_calls_that_include_one_file_have_elements_of_their_own(tmp_path: Path) -> None:
    prefix = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    include = (
        f'{prefix}<xacro:macro name="part" params="name"><g name="${{name}}"><xacro:include filename="part.xacro"/>'
    )
    (tmp_path / "part.xacro").write_text(f'{prefix}<link name="a"><visual/></link></robot>')
    entry = str(tmp_path / "arm.xacro")
    Path(entry).write_text(text := f'{include}</g></xacro:macro><xacro:part name="x"/><xacro:part name="y"/></robot>')
    packages, memory = Packages(near=Path(entry)), Memory()
    for name in ("z", "w"):
        texts = {entry: text.replace('name="y"', f'name="{name}"')}
        root: Any = expand_leniently(entry, packages=packages, texts=texts, memory=memory).root
        elements = list(root.walk())
        assert [element.tag for element in elements] == ["robot", *(2 * ["g", "link", "visual"])]
        assert len({id(element) for element in elements}) == len(elements)
