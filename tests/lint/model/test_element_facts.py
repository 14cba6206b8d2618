"""Facts of elements are computed once for each element, also over several checks."""

from pathlib import Path

import pytest

from tests.lint.engine.test_clean_elements import HEAD, LINK
from urdfkit.description.urdf.robot import Joint
from urdfkit.lint.editor.open_files import Project
from urdfkit.lint.engine.checker import Checker
from urdfkit.lint.engine.run import merged
from urdfkit.lint.facts.placement import joint_axes
from urdfkit.lint.model.element_facts import ElementFacts
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

TEXT = HEAD + "".join(LINK.format(i=i, before=i - 1) for i in range(1, 12)) + '<link name="link_0"/></robot>'


def test_a_fact_is_computed_again_for_new_subjects_only() -> None:
    computed: list[str] = []

    def length(word: str) -> int | None:
        computed.append(word)
        return len(word) or None

    facts = ElementFacts()
    assert facts.of(length, ["a", "", "abc"]) == [1, None, 3]
    assert facts.of(length, ["abc", "ab", ""]) == [3, 2, None]
    assert computed == ["a", "", "abc", "ab"]
    assert facts.of(length, ["a"]) == [1]  # only the subjects of the last call are kept
    assert computed == ["a", "", "abc", "ab", "a"]


def test_subjects_with_the_same_key_have_the_fact_in_common() -> None:
    computed: list[str] = []

    def first(word: str) -> str:
        computed.append(word)
        return word[0]

    assert ElementFacts().of(first, ["ab", "b", "ac"], key=lambda word: word[0]) == ["a", "b", "a"]
    assert computed == ["ab", "b"]


def test_two_facts_of_the_same_subjects_are_kept_apart() -> None:
    facts = ElementFacts()
    assert facts.of(len, ["ab"]) == [2]
    assert facts.of(str.upper, ["ab"]) == ["AB"]
    assert facts.of(len, ["ab"]) == [2]


def test_after_a_change_of_one_joint_the_axes_of_two_pairs_are_compared(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compared: list[str] = []
    compare = joint_axes.turn_about_one_line

    def recorded(chain: tuple[Joint, ...]) -> bool:
        compared.append(chain[0].name)
        return compare(chain)

    monkeypatch.setattr(joint_axes, "turn_about_one_line", recorded)
    path = tmp_path / "chain.urdf.xacro"
    path.write_text(TEXT)
    project = Project(Options())
    project.analyses(path)
    assert len(compared) == 10
    compared.clear()
    axis = TEXT.index("<axis", TEXT.index('name="joint_5"'))
    project.set_text(path, TEXT[:axis] + TEXT[axis:].replace("0 1 0", "1 0 0", 1))
    project.analyses(path)
    assert compared == ["joint_5", "joint_6"]


def test_findings_on_places_of_joints_after_edits_are_those_of_a_fresh_check(tmp_path: Path) -> None:
    path = tmp_path / "chain.urdf.xacro"
    path.write_text(TEXT)
    project = Project(Options())
    joint = TEXT.index('name="joint_5"')
    edits = (
        ("0 0 0.2", "0 0 0.25", 1),
        ("0 0 0.2", "0 0 20", 2),
        ("0 1 0", "0 0 1", 2),
        ("revolute", "fixed", 1),
        ("", "", 1),
    )
    seen: list[set[str]] = []
    for old, new, count in edits:
        text = TEXT[:joint] + TEXT[joint:].replace(old, new, count)
        project.set_text(path, text)
        fresh, _ = Checker(Options(texts={str(path): text})).examine(Entry(path))
        (analysis,) = project.analyses(path)
        assert [one.to_json() for one in analysis.findings] == [one.to_json() for one in merged(fresh.findings)]
        seen.append({one.code for one in analysis.findings} & {"J421", "J427", "J428"})
    assert seen == [{"J427"}, {"J421"}, {"J428"}, set(), set()]
