"""Checking one of the elements that calls of a macro make alike finds what checking all finds."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from urdfkit.lint.engine.checker import Checker, model_of
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.repeated_elements import content_key
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.rules import RULES

MACRO = """<robot name="chain" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="segment" params="i before mass:=1.0 length:=0.2 bare:=false">
    <link name="link_{i}">
      <inertial><origin xyz="0 0 0.1"/><mass value="${mass}"/>
        <inertia ixx="0.0035" ixy="0" ixz="0" iyy="0.0035" iyz="0" izz="0.0005"/></inertial>
      <visual><origin xyz="0 0 0.1"/><geometry><box size="0.05 0.05 ${length}"/></geometry></visual>
      <xacro:unless value="${bare}">
        <collision><origin xyz="0 0 0.1"/><geometry><box size="0.05 0.05 0.2"/></geometry></collision>
      </xacro:unless>
    </link>
    <joint name="joint_{i}" type="revolute"><parent link="link_{before}"/><child link="link_{i}"/>
      <origin xyz="0 0 0.2"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
  </xacro:macro>
""".replace("_{", "_${")
BODY_DEFECTS = (
    *(("0.0005", "0.05"), ("0.0035", "3.5e-9"), ("0 0 0.1", "0 0 5"), ("<axis", "<axsi"), ("ixy", "ixi")),
    *(("<collision>", "<collision><geometry/>"), ("mass value", "mass vlue"), ("0.05 0.05 0.2", "9 9 2e12")),
)
CALL_DEFECTS = ('mass="1000"', 'mass="-1"', 'length="9"', 'length="-0.2"', 'bare="true"', 'mass="1e-5"', 'mass="x"')


@pytest.mark.parametrize("seed", range(5))
def test_findings_are_those_of_a_check_of_every_element(
    seed: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    dice = random.Random(seed)
    path = tmp_path / "chain.urdf.xacro"
    seen: set[str] = set()
    for _ in range(8):
        calls = [
            f'  <xacro:segment i="{i if dice.random() < 0.99 else 1}" before="{i - 1}" '
            f"{dice.choice(CALL_DEFECTS) if dice.random() < 0.1 else ''}/>\n"
            for i in range(1, 16)
        ]
        macro = MACRO.replace(*dice.choice(BODY_DEFECTS), 1) if dice.random() < 0.5 else MACRO
        path.write_text(macro + "".join(calls) + '  <link name="link_0"/>\n</robot>')
        found, model = Checker(Options()).examine(Entry(path))
        assert model.distinct is model or len(model.distinct.parts) < len(model.parts)
        with monkeypatch.context() as patch:
            patch.setattr(Model, "distinct", property(lambda self: self))
            all_found, _ = Checker(Options()).examine(Entry(path))
        assert [one.to_json() for one in found.findings] == [one.to_json() for one in all_found.findings]
        seen.update(one.code for one in found.findings)
    assert seen & {rule.code for rule in RULES if rule.checks_each_alone}


def test_elements_that_differ_in_names_only_have_the_same_key(tmp_path: Path) -> None:
    path = tmp_path / "chain.urdf.xacro"
    calls = [f'<xacro:segment i="{i}" before="{i - 1}"/>' for i in (1, 2)]
    other = ['<xacro:segment i="3" before="2" mass="2"/>', '<xacro:segment i="4" before="3" bare="true"/>']
    path.write_text("\n".join([MACRO, *calls, *other, '<link name="link_0"/></robot>']))
    model = model_of(path, Options())
    first, second, heavy, bare, base = [content_key(link.element) for link in model.robot.links]
    assert first == second
    assert len({first, heavy, bare, base}) == 4
    joints = {content_key(joint.element) for joint in model.robot.joints}
    assert len(joints) == 1
    assert len(model.distinct.parts) == 5
