"""Edits that fixes have in common: the bytes of their span and nothing else; nothing where a value is computed."""

from __future__ import annotations

import pytest

from urdfkit.description.xml.element import Element
from urdfkit.lint import fix_builders
from urdfkit.lint.engine.checker import model_of
from urdfkit.lint.finding import Fix
from urdfkit.lint.project.options import Options

TEXT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="w" value="2"/>
  <link name="a">
    <visual><!-- é -->
      <origin xyz='1 2 3'
              rpy="0 0 ${w}" />
      <geometry><box size="1 1 1"></box></geometry>
    </visual>
  </link>
  <gazebo><plugin name="p" filename="libx.so"><rate> 5 </rate><out>a&amp;b</out></plugin></gazebo>
</robot>
"""


def applied(fix: Fix | None) -> str:
    assert fix is not None
    lines = TEXT.splitlines(keepends=True)
    starts = [sum(map(len, lines[:number])) for number in range(len(lines) + 1)]
    text = TEXT
    for edit in sorted(fix.edits, key=lambda edit: edit.span, reverse=True):
        span = edit.span
        first, last = starts[span.line - 1] + span.column - 1, starts[span.end_line - 1] + span.end_column - 1
        text = text[:first] + edit.text + text[last:]
    return text


@pytest.fixture
def found(write):
    model = model_of(write("r.xacro", TEXT), Options())
    elements = {element.tag: element for element in model.robot.element.walk()}

    def element(tag: str) -> Element:
        return elements[tag]

    return model, element


@pytest.mark.parametrize(
    ("edit", "before", "after"),
    [
        (lambda m, e: fix_builders.new_value(m, e("origin"), "xyz", "4", "safe"), "'1 2 3'", "'4'"),
        (
            lambda m, e: fix_builders.new_name(m, e("origin"), "rpy", "rot", "safe"),
            'rpy="0 0 ${w}"',
            'rot="0 0 ${w}"',
        ),
        (lambda m, e: fix_builders.new_tag(m, e("box"), "ball", "safe"), "<box size", "<ball size"),
        (lambda m, e: fix_builders.new_text(m, e("rate"), "7", "safe"), "<rate> 5 <", "<rate>7<"),
        (
            lambda m, e: fix_builders.without_attribute(m, e("origin"), "rpy", "safe", ""),
            "'1 2 3'\n              rpy=\"0 0 ${w}\" />",
            "'1 2 3' />",
        ),
        (
            lambda m, e: fix_builders.without_element(m, e("origin"), "safe", ""),
            "      <origin xyz='1 2 3'\n              rpy=\"0 0 ${w}\" />\n",
            "",
        ),
        (lambda m, e: fix_builders.without_element(m, e("rate"), "safe", ""), "<rate> 5 </rate>", ""),
        (
            lambda m, e: fix_builders.more_attributes(m, e("link"), 'x="1"', "safe", ""),
            '<link name="a">',
            '<link name="a" x="1">',
        ),
        (
            lambda m, e: fix_builders.more_children(m, e("visual"), "<b/>", "safe", ""),
            "</geometry>\n",
            "</geometry>\n      <b/>\n",
        ),
    ],
)
def test_an_edit_changes_its_span_and_nothing_else(found, edit, before, after):
    assert TEXT.count(before) == 1
    expected = TEXT.replace(before, after)
    if "<ball" in after:
        expected = expected.replace("</box>", "</ball>")
    assert applied(edit(*found)) == expected


def test_what_is_computed_or_escaped_is_left_alone(found):
    model, element = found
    assert fix_builders.new_value(model, element("origin"), "rpy", "0 0 0", "safe") is None
    assert fix_builders.new_values(model, element("origin"), {"xyz": "1 1 1", "rpy": "0 0 0"}, "safe", "") is None
    assert fix_builders.new_text(model, element("out"), "c", "safe") is None
    assert fix_builders.new_value(model, element("origin"), "xyz", "1 2 3", "safe") is None
    assert fix_builders.more_children(model, element("box"), "<b/>", "safe", "") is None


def test_the_nearest_name():
    assert fix_builders.nearest("Left_Wheel", ["left_wheel", "right_wheel"]) == "left_wheel"
    assert fix_builders.nearest("gripper", ["left_wheel", "right_wheel"]) is None
    assert fix_builders.meant("lef_wheel", ["left_wheel"]) == ("left_wheel", "; did you mean `left_wheel`?")
    assert fix_builders.meant("stick_link", ["imu_link"]) == (None, "")
