"""After an edit, the rules that check only new elements find what a fresh check finds."""

from __future__ import annotations

import random
from collections.abc import Callable
from pathlib import Path

import pytest

from urdfkit.lint.editor.open_files import Project
from urdfkit.lint.engine.checker import Checker
from urdfkit.lint.engine.clean_elements import CleanElements
from urdfkit.lint.engine.run import merged
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.rule import Rule
from urdfkit.lint.rules import RULES

HEAD = """<robot name="chain" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="m" value="1.0"/>
  <material name="glass"><color rgba="1 1 1 1"/></material>
"""
LINK = """  <link name="link_{i}">
    <inertial><origin xyz="0 0 0.1"/><mass value="1.0"/>
      <inertia ixx="${{m * 0.0035}}" ixy="0" ixz="0" iyy="0.0035" iyz="0" izz="0.0005"/></inertial>
    <visual><origin xyz="0 0 0.1"/><geometry><box size="0.05 0.05 0.2"/></geometry><material name="glass"/></visual>
    <collision><origin xyz="0 0 0.1"/><geometry><box size="0.05 0.05 0.2"/></geometry></collision>
  </link>
  <joint name="joint_{i}" type="revolute"><parent link="link_{before}"/><child link="link_{i}"/>
    <origin xyz="0 0 0.2"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="10" velocity="1"/></joint>
"""
CHANGES = (
    *(("1.0", "-1.0"), ("1.0", "1000"), ("1.0", "0"), ("0.0035", "0.035"), ("0.0035", "35"), ("0.0035", "3.5e-9")),
    *(("0.0005", "nan"), ("0.0005", "2e12"), ("0 0 0.1", "0 0 5"), ("0 0 0.1", "0 0 x"), ("0.05 0.05 0.2", "5 5 2")),
    *(("mass value", "mass vlue"), ("<mass ", "<mas "), ("<axis", "<axsi"), ("<collision>", "<colision>")),
    *(('<mass value="1.0"/>', '<mass value="1.0"/><mass value="2"/>'), ("link_3", "link_4"), ("link_4", "link_3")),
    *(("rgba", "rgba="), ("1 1 1 1", "1 1 1 0.1"), ("<box size", "<box sise"), ('"link_5"', '"\'link_5"')),
    *(("0 0 0.2", "0 0 0.25"), ("0 0 0.2", "0 0 20"), ("0 1 0", "0 0 1"), ("revolute", "fixed"), ("revolute", "x")),
    *(("${m * 0.0035}", "0.0035"), ("0.0035", "${m * 0.0035}"), ("m * ", "2 * "), ("<visual>", '<visual foo="1">')),
)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_findings_after_edits_are_those_of_a_fresh_check(seed: int, tmp_path: Path) -> None:
    dice = random.Random(seed)
    original = text = (
        HEAD + "".join(LINK.format(i=i, before=i - 1) for i in range(1, 12)) + '<link name="link_0"/></robot>'
    )
    path = tmp_path / "chain.urdf.xacro"
    path.write_text(text)
    project = Project(Options())
    seen: set[str] = set()
    for _ in range(40):
        old, new = dice.choice(CHANGES)
        places = [at for at in range(len(text)) if text.startswith(old, at)]
        if places and dice.random() < 0.8:
            at = dice.choice(places)
            text = text[:at] + new + text[at + len(old) :]
        elif dice.random() < 0.5:
            text = original
        project.set_text(path, text)
        fresh, _ = Checker(Options(texts={str(path): text})).examine(Entry(path))
        (analysis,) = project.analyses(path)
        assert [one.to_json() for one in analysis.findings] == [one.to_json() for one in merged(fresh.findings)]
        seen.update(one.code for one in analysis.findings)
    assert seen & {rule.code for rule in RULES if rule.checks_each_alone}


def test_a_rule_is_run_only_on_new_elements(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "chain.urdf.xacro"
    text = HEAD + "".join(LINK.format(i=i, before=i - 1) for i in range(1, 12)) + '<link name="link_0"/></robot>'
    path.write_text(text)
    project = Project(Options())
    sizes: list[int] = []
    check = CleanElements.check

    def recorded(self: CleanElements, rule: type[Rule], run: Callable[[Model], list[Finding]]) -> list[Finding]:
        def counted(model: Model) -> list[Finding]:
            sizes.append(len(model.robot.links))
            return run(model)

        return check(self, rule, counted)

    monkeypatch.setattr(CleanElements, "check", recorded)
    for mass in ("1.0", "1.1"):
        sizes.clear()
        project.set_text(path, text.replace('mass value="1.0"', f'mass value="{mass}"', 1))
        project.analyses(path)
    assert set(sizes) == {1}


def test_a_change_of_a_material_checks_links_again_that_did_not_change(tmp_path: Path) -> None:
    box = '<geometry><box size="0.1 0.1 0.1"/></geometry>'
    lamp = (
        '<link name="link_0"><inertial><mass value="1"/><inertia ixx="0.00167" ixy="0" ixz="0" iyy="0.00167" iyz="0" '
        f'izz="0.00167"/></inertial><visual>{box}</visual>'
        f'<visual><origin xyz="15 0 0"/>{box}<material name="glass"/></visual></link></robot>'
    )
    text = HEAD + "".join(LINK.format(i=i, before=i - 1) for i in range(1, 12)) + lamp
    path = tmp_path / "chain.urdf.xacro"
    path.write_text(text)
    project = Project(Options(select=("G617",)))
    found = []
    for alpha in ("0.1", "1", "0.1"):
        project.set_text(path, text.replace("1 1 1 1", f"1 1 1 {alpha}"))
        (analysis,) = project.analyses(path)
        found.append([finding.code for finding in analysis.findings])
    assert found == [[], ["G617"], []]
