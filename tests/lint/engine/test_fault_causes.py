"""Findings on names and values that xacro lacks: where the definition is missing."""

import pytest

from urdfkit.lint import lint

MANIFEST = "<package format='3'><name>arm</name><version>1.0.0</version></package>"
HEAD = 'xmlns:xacro="http://www.ros.org/wiki/xacro">'
ROBOT = f"""<robot name="small" {HEAD}
  <xacro:property name="size" value="0.1"/>
  <xacro:include filename="parts/solids.xacro" ns="solids"/>
  <xacro:include filename="parts/base.xacro"/>
  <xacro:include filename="parts/arm.xacro"/>
  <xacro:base/>
  <xacro:arm list="${{dims['list']}}"/>
</robot>
"""
PARTS = {
    "solids": """  <xacro:macro name="cube" params="edge">
    <collision><geometry><box size="${edge} ${edge} ${edge}"/></geometry></collision>
  </xacro:macro>""",
    "base": """  <xacro:property name="dims" value="${xacro.load_yaml('dims.yaml')}"/>
  <xacro:macro name="base" params="">
    <xacro:property name="top" value="0.2" scope="parent"/>
    <link name="base"><xacro:solids.cube edge="${size}"/></link>
  </xacro:macro>""",
    "arm": """  <xacro:macro name="arm" params="list">
    <link name="arm"><collision><geometry><box size="${list[0]} ${list[1]} ${list[2]}"/></geometry></collision></link>
    <joint name="shoulder" type="fixed">
      <parent link="base"/><child link="arm"/><origin xyz="0 ${size} ${top + dims['gap']}"/>
    </joint>
  </xacro:macro>""",
}
DIMS = "list: [0.1, 0.1, 0.1]\ngap: 0.01\n"


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        (None, set()),
        ((' scope="parent"', ""), {("X104", "urdf/parts/base.xacro", 4)}),
        ((' ns="solids"', ""), {("X103", "urdf/small.urdf.xacro", 3)}),
        (('  <xacro:include filename="parts/arm.xacro"/>\n', ""), {("X103", "urdf/small.urdf.xacro", 4)}),
        ((", 0.1, 0.1]", ", 0.1]"), {("X124", "urdf/dims.yaml", 1)}),
        (("gap: 0.01", "gpa: 0.01"), {("X124", "urdf/dims.yaml", 2)}),
        (("dims['gap']", "dims['space']"), {("X124", "urdf/parts/arm.xacro", 5)}),
        (("${dims['list']}", "${sizes}"), {("X104", "urdf/small.urdf.xacro", 7)}),
        (('  <xacro:property name="size" value="0.1"/>\n', ""), {("X104", "urdf/small.urdf.xacro", 3)}),
    ],
    ids=["correct", "scope", "namespace", "include", "item", "misspelt key", "other key", "argument", "property"],
)
def test_a_missing_definition_is_one_finding_where_it_is_missing(change, expected, tmp_path, monkeypatch):
    assert found_after(change, tmp_path, monkeypatch) == expected


@pytest.mark.parametrize(
    ("files", "includes", "line"),
    [
        (("solids", "base"), ("solids", "base"), 7),
        (("parts/solids", "parts/base"), ("parts/solids", "parts/base"), 7),
        (("old/parts/solids", "old/parts/base"), ("$(find arm)/urdf/old/parts/solids", "old/./parts/base"), 5),
    ],
    ids=["no folder", "folder with the same name", "same folder"],
)
def test_an_include_is_missing_next_to_those_of_the_same_folder(files, includes, line, tmp_path, monkeypatch):
    robot = ROBOT.replace('  <xacro:include filename="parts/arm.xacro"/>\n', "")
    for name, path in zip(("solids", "base"), includes, strict=True):
        robot = robot.replace(f"parts/{name}.xacro", f"{path}.xacro")
    parts = dict(zip(("solids", "base", "arm"), (*files, "old/parts/arm"), strict=True))
    texts = {f"urdf/{path}.xacro": f"<robot {HEAD}\n{PARTS[name]}\n</robot>\n" for name, path in parts.items()}
    texts |= {"package.xml": MANIFEST, "urdf/small.urdf.xacro": f"\n{robot}", "urdf/dims.yaml": DIMS}
    assert found_in(texts, tmp_path, monkeypatch) == [("X103", "urdf/small.urdf.xacro", line)]


def found_after(change, tmp_path, monkeypatch):
    texts = {f"urdf/parts/{name}.xacro": f"<robot {HEAD}\n{text}\n</robot>\n" for name, text in PARTS.items()}
    texts |= {"package.xml": MANIFEST, "urdf/small.urdf.xacro": ROBOT, "urdf/dims.yaml": DIMS}
    if change is not None:
        texts = {name: text.replace(*change) for name, text in texts.items()}
    texts["urdf/large.urdf.xacro"] = ROBOT.replace("small", "large")
    found = found_in(texts, tmp_path, monkeypatch)
    assert len(found) == len(set(found))
    return set(found)


def found_in(texts, tmp_path, monkeypatch):
    for name, text in texts.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text.replace("'dims.yaml'", f"'{tmp_path}/urdf/dims.yaml'"))
    monkeypatch.chdir(tmp_path)
    return [
        (each.code, each.file, each.line) for each in lint("urdf/small.urdf.xacro", select=("X103", "X104", "X124"))
    ]


def test_other_robots_and_includes_are_read_once(tmp_path, monkeypatch):
    from urdfkit.lint.model.tags import Document
    from urdfkit.lint.project import description_files

    read, walked = [], []
    text_of, walk = description_files.text_of, Document.walk
    monkeypatch.setattr(description_files, "text_of", lambda path: read.append(path) or text_of(path))
    monkeypatch.setattr(Document, "walk", lambda document: walked.append(document.source.file) or walk(document))
    texts = {f"urdf/parts/{name}.xacro": f"<robot {HEAD}\n{text}\n</robot>\n" for name, text in PARTS.items()}
    texts |= {"package.xml": MANIFEST, "urdf/dims.yaml": DIMS, "urdf/large.urdf.xacro": ROBOT}

    def counts(number):
        links = "".join(f'<link name="{at}"><xacro:solids.cube edge="${{u{at}}}"/></link>' for at in range(number))
        texts["urdf/small.urdf.xacro"] = ROBOT.replace("  <xacro:base/>", f"  <xacro:base/>{links}")
        read.clear()
        walked.clear()
        assert len(found_in(texts, tmp_path, monkeypatch)) == number
        return len(read), len(walked)

    assert counts(20) == counts(2)
