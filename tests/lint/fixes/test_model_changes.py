"""After a fix, the expanded robot has changed only where the findings name it."""

from __future__ import annotations

from urdfkit import expand
from urdfkit.description.xacro.expand import expand_leniently
from urdfkit.description.xml.source import Expansion, Position, Span
from urdfkit.lint import lint
from urdfkit.lint.finding import Edit, Finding, Fix
from urdfkit.lint.fixes import apply
from urdfkit.lint.fixes.apply import fix
from urdfkit.lint.fixes.model_changes import unnamed_changes
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options

HEAD = '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
MACRO = (
    HEAD
    + """  <xacro:property name="width" value="0.2"/>
  <xacro:macro name="part" params="name">
    <link name="${name}">
      <visual><geometry><box size="0.1 ${width} 0.3"/></geometry></visual>
    </link>
  </xacro:macro>
  <xacro:part name="a"/>
  <xacro:part name="b"/>
</robot>
"""
)


def finding(path, old: str, new: str, calls: tuple[int, ...] = ()) -> Finding:
    """A finding at the first place of a text, in the macro calls in these lines, with a fix that replaces it."""
    text = path.read_text()
    start = text.index(old)
    line, column = text.count("\n", 0, start) + 1, start - text.rfind("\n", 0, start)
    span = Span(str(path), line, column, line, column + len(old))
    chains = tuple((Expansion("part", Position(str(path), call, 3)),) for call in calls)
    return Finding("Z999", "test", "warning", "a test", span, chains=chains, fix=Fix("safe", "Fix", (Edit(span, new),)))


def changes(path, one: Finding) -> list[tuple[str, int]]:
    before = expand_leniently(path)
    (edit,) = one.fix.edits
    old = path.read_text().splitlines()[edit.span.line - 1][edit.span.column - 1 : edit.span.end_column - 1]
    after = expand_leniently(path, texts={str(path.absolute()): path.read_text().replace(old, edit.text, 1)})
    return [(element.tag, element.origin.position.line) for element in unnamed_changes(before, after, [one])]


def test_a_fix_in_a_macro_changes_every_call_and_has_to_name_each(write):
    path = write("r.xacro", MACRO.encode())
    named = [
        tuple(call.position for call in e.origin.expansions)
        for e in expand_leniently(path).root.walk()
        if e.tag == "box"
    ]
    assert [[(call.file, call.line, call.column) for call in calls] for calls in named] == [
        [(str(path), 8, 3)],
        [(str(path), 9, 3)],
    ]
    assert changes(path, finding(path, "0.1 ", "0.5 ", (8, 9))) == []
    assert changes(path, finding(path, "0.1 ", "0.5 ", (8,))) == [("box", 5)]
    assert changes(path, finding(path, "0.1 ", "0.5 ")) == []  # about the source, not about a call


def test_a_fix_of_a_property_names_the_elements_with_expressions(write):
    path = write("r.xacro", MACRO.encode())
    assert changes(path, finding(path, 'value="0.2"', 'value="0.4"')) == []


def test_a_fix_of_a_call_names_what_the_call_creates(write):
    path = write("r.xacro", MACRO.encode())
    assert changes(path, finding(path, 'name="a"', 'name="c"')) == []


def test_a_change_elsewhere_is_not_named(write):
    path = write("r.xacro", MACRO.encode())
    one = finding(path, 'name="a"', 'name="c"')
    before = expand_leniently(path)
    after = expand_leniently(path, texts={str(path.absolute()): MACRO.replace('name="b"', 'name="d"')})
    assert [element.get("name") for element in unnamed_changes(before, after, [one])] == ["b"]
    removed = expand_leniently(path, texts={str(path.absolute()): MACRO.replace('  <xacro:part name="b"/>\n', "")})
    assert [element.get("name") for element in unnamed_changes(before, removed, [one])] == ["b"]


def test_nothing_is_compared_after_errors_of_the_expansion(write):
    path = write("r.xacro", MACRO.replace("${width}", "${height}").encode())
    assert expand_leniently(path).faults
    assert changes(path, finding(path, "0.1 ", "0.5 ", (8,))) == []


def test_a_fix_that_changes_more_than_its_finding_names_is_refused(write, monkeypatch):
    text = (
        '<robot name="r">\n  <link name="base"/>\n  <material name="red"><color rgba="1,0,0,1"/></material>\n</robot>\n'
    )
    path = write("r.urdf", text.encode())
    assert len(fix([Entry(path)], Options(), within=[path.parent]).changes) == 1
    base = next(element for element in expand_leniently(path).root.walk() if element.tag == "link")
    monkeypatch.setattr(apply, "unnamed_changes", lambda *_: [base])
    fixed = fix([Entry(path)], Options(), within=[path.parent])
    assert fixed.changes == ()
    assert "was not fixed: the fix would also have changed <link> at" in fixed.notes[0]
    assert fixed.notes[0].endswith("r.urdf:2")


def test_safe_fixes_keep_the_rest_of_the_model(write):
    text = MACRO.replace("</robot>", '  <material name="red"><color rgba="1,0,0,1"/></material>\n</robot>')
    path = write("r.xacro", text.encode())
    before = expand(path)
    fixed = fix([Entry(path)], Options(), within=[path.parent])
    assert [one.code for one in lint(path) if one.fix is not None] != []
    for change in fixed.changes:
        change.write()
    assert expand(path).splitlines() == before.replace("1,0,0,1", "1 0 0 1").splitlines()
