"""``urdfkit lsp``: symbols, folding, formatting, semantic tokens, inlay hints, renaming in launch files."""

from __future__ import annotations

from typing import Any

import pytest

from tests.lsp.test_lsp import ROBOT, WHEEL, applied, cart, places

__all__ = ["cart"]

LAUNCH_PY = """from launch_ros.actions import Node
model = Command(["xacro ", share / "urdf" / "cart.urdf.xacro", " tall:=", LaunchConfiguration("tall")])
doc = xacro.process_file("cart.urdf.xacro", mappings={"tall": "false"})
nodes = [
    # "base" in a comment stays
    Node(package="tf2_ros", executable="static_transform_publisher", name="mast",
         arguments=["--x", "0", "--frame-id", "base", "--child-frame-id", "mast"]),
    Node(package="nav", executable="base", parameters=[{"base_frame": "base", "joints": ["mast_joint"]}]),
]
"""
LAUNCH_XML = """<launch>
  <!-- base -->
  <param name="robot_description" command="xacro $(find p)/cart.urdf.xacro tall:=false"/>
  <node pkg="tf" type="static_transform_publisher" name="base" args="0 0 1 0 0 0 base mast 100"/>
  <node pkg="nav" type="base" name="base"><param name="base_link" value="base"/></node>
</launch>
"""


def document(cart: Any, name: str) -> dict[str, Any]:
    return {"textDocument": {"uri": cart.uri(name)}}


def test_document_symbols_are_a_tree_of_named_elements(cart):
    def names(symbols: list[dict[str, Any]]) -> list[Any]:
        return [(one["name"], names(one["children"])) if one["children"] else one["name"] for one in symbols]

    fragment = cart.ask("textDocument/documentSymbol", document(cart, "wheel.xacro"))
    assert names(fragment) == ["radius", ("wheel", ["${side}_wheel", "${side}_joint"])]
    assert fragment[1]["detail"] == "side y:=0"
    found = cart.ask("textDocument/documentSymbol", document(cart, "cart.urdf.xacro"))
    below = "wheel.xacro tall base xacro:wheel xacro:wheel mast mast_joint hull hull_joint drive"
    assert names(found) == [("cart", below.split(" "))]
    joint = found[0]["children"][6]
    assert joint["detail"] == "fixed"
    assert joint["range"]["end"]["line"] - joint["range"]["start"]["line"] == 3


def test_a_file_that_is_being_typed_has_symbols_and_folds(cart):
    cart.change("cart.urdf.xacro", ROBOT[: ROBOT.index('<child link="mast"/>')])
    (robot,) = cart.ask("textDocument/documentSymbol", document(cart, "cart.urdf.xacro"))
    assert [one["name"] for one in robot["children"]][-1] == "mast_joint"
    assert cart.ask("textDocument/foldingRange", document(cart, "cart.urdf.xacro")) == []
    cart.change("cart.urdf.xacro", ROBOT.replace("<!-- 🤖 -->", "<!-- a\n b -->"))
    folds = cart.ask("textDocument/foldingRange", document(cart, "cart.urdf.xacro"))
    assert {"startLine": 1, "endLine": 2, "kind": "comment"} in folds
    lines = ROBOT.splitlines()
    assert all(fold["endLine"] > fold["startLine"] for fold in folds)
    assert len(folds) == 1 + sum(line.strip().startswith("</") for line in lines)


def test_workspace_symbols_are_found_by_letters_in_their_order(cart):
    (cart.folder / "build").mkdir(exist_ok=True)
    (cart.folder / "build" / "copy.urdf").write_text(ROBOT)
    found = cart.ask("workspace/symbol", {"query": "msjt"})
    assert [(one["name"], one["containerName"]) for one in found] == [("mast_joint", "cart.urdf.xacro")]
    found = cart.ask("workspace/symbol", {"query": "Radius"})
    assert places([one["location"] for one in found]) == [("wheel.xacro", 2)]


def test_formatting_gives_edits_of_the_changed_lines(cart):
    ugly = ROBOT.replace('  <link name="base"/>', '\t<link  name = "base" />')
    assert cart.ask("textDocument/formatting", {**document(cart, "cart.urdf.xacro"), "options": OPTIONS}) == []
    cart.change("cart.urdf.xacro", ugly)
    edits = cart.ask("textDocument/formatting", {**document(cart, "cart.urdf.xacro"), "options": OPTIONS})
    assert len(edits) == 1
    assert edits[0]["range"]["end"]["line"] - edits[0]["range"]["start"]["line"] == 1
    assert applied(ugly, edits) == ROBOT
    cart.change("cart.urdf.xacro", ugly.replace("</robot>", ""))
    assert cart.ask("textDocument/formatting", {**document(cart, "cart.urdf.xacro"), "options": OPTIONS}) == []


OPTIONS = {"tabSize": 8, "insertSpaces": False}
"""Options of an editor; the project decides, so that `urdfkit format --check` agrees."""


def test_semantic_tokens_tell_properties_from_parameters(cart):
    legend = cart.capabilities["semanticTokensProvider"]["legend"]["tokenTypes"]
    data = cart.ask("textDocument/semanticTokens/full", document(cart, "wheel.xacro"))["data"]
    lines, line, column, found = WHEEL.splitlines(), 0, 0, []
    for moved, start, length, kind, _ in zip(*[iter(data)] * 5, strict=True):
        line, column = line + moved, start + (0 if moved else column)
        found.append((lines[line][column : column + length], legend[kind]))
    names = ["radius", "xacro:macro", "wheel", "side", "y", "side", "radius", "side", "side", "y", "xacro:macro"]
    kinds = {"xacro:property": "keyword", "xacro:macro": "keyword", "wheel": "macro", "radius": "variable"}
    assert found == [(name, kinds.get(name, "parameter")) for name in ("xacro:property", *names)]


def test_inlay_hints_show_values_and_masses(cart):
    def hints(name: str, text: str) -> dict[str, str]:
        whole = {"start": {"line": 0, "character": 0}, "end": {"line": text.count("\n"), "character": 0}}
        found = cart.ask("textDocument/inlayHint", {**document(cart, name), "range": whole})
        lines = text.splitlines()
        return {lines[h["position"]["line"]][: h["position"]["character"]].strip(): h["label"] for h in found}

    assert hints("wheel.xacro", WHEEL) == {
        '<xacro:property name="radius" value="${0.1 * 2}"': "= 0.2",
        '<link name="${side}_wheel"': "= left_wheel, right_wheel",
        '<link name="${side}_wheel">': "2 kg",
        '<collision><geometry><sphere radius="${radius}"': "= 0.2",
        '<joint name="${side}_joint"': "= left_joint, right_joint",
        '<child link="${side}_wheel"': "= left_wheel, right_wheel",
        '<origin xyz="0 ${y} 0"': "= 0 0.2 0, 0 -0.2 0",
    }
    assert hints("cart.urdf.xacro", ROBOT) == {'<link name="hull">': "5 kg"}


@pytest.mark.parametrize(
    ("mark", "name", "renamed"),
    [
        ('<link name="ba|se"/>', "body", ['id", "base"', '"base_frame": "base"', "0 0 0 base mast", 'value="base"']),
        ('<joint name="mast|_joint"', "pole_joint", ['"mast_joint"']),
        ('<xacro:arg name="ta|ll"', "high", [" tall:=", '"tall": "false"']),
    ],
)
def test_renaming_reaches_launch_files(cart, mark, name, renamed):
    files = {"cart.launch.py": LAUNCH_PY, "cart.launch": LAUNCH_XML}
    for file, text in files.items():
        (cart.folder / "launch").mkdir(exist_ok=True)
        (cart.folder / "launch" / file).write_text(text)
    cart.tell("workspace/didChangeWatchedFiles", {"changes": []})
    changes = cart.ask("textDocument/rename", {**cart.at("cart.urdf.xacro", ROBOT, mark), "newName": name})["changes"]
    old = {"body": "base", "pole_joint": "mast_joint", "high": "tall"}[name]
    for file, text in files.items():
        wanted = text
        for part in renamed:
            head, _, tail = part.rpartition(old) if part.count(old) == 1 or "base_" in part else part.partition(old)
            wanted = wanted.replace(part, f"{head}{name}{tail}")
        assert applied(text, changes.get(cart.uri(f"launch/{file}"), [])) == wanted
        (cart.folder / "launch" / file).unlink()
