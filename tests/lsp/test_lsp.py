"""``urdfkit lsp`` with a client over pipes: what an editor asks, of files as they are typed."""

from __future__ import annotations

from typing import Any

import pytest

WHEEL = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:property name="radius" value="${0.1 * 2}"/>
  <xacro:macro name="wheel" params="side y:=0">
    <link name="${side}_wheel">
      <inertial>
        <mass value="2"/>
        <inertia ixx="0.03" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/>
      </inertial>
      <collision><geometry><sphere radius="${radius}"/></geometry></collision>
    </link>
    <joint name="${side}_joint" type="continuous">
      <parent link="base"/>
      <child link="${side}_wheel"/>
      <origin xyz="0 ${y} 0"/>
      <axis xyz="0 1 0"/>
    </joint>
  </xacro:macro>
</robot>
"""

ROBOT = """<?xml version="1.0"?>
<!-- 🤖 -->
<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="wheel.xacro"/>
  <xacro:arg name="tall" default="true"/>
  <link name="base"/>
  <xacro:wheel side="left" y="0.2"/>
  <xacro:wheel side="right" y="-0.2"/>
  <link name="mast"/>
  <joint name="mast_joint" type="fixed">
    <parent link="base"/>
    <child link="mast"/>
  </joint>
  <link name="hull">
    <inertial>
      <mass value="5"/>
      <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
    </inertial>
  </link>
  <joint name="hull_joint" type="fixed">
    <parent link="mast"/>
    <child link="hull"/>
  </joint>
  <gazebo reference="mast"/>
  <gazebo>
    <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
      <leftJoint>left_joint</leftJoint>
      <rightJoint>right_joint</rightJoint>
      <wheelSeparation>0.4</wheelSeparation>
      <wheelDiameter>${2 * radius}</wheelDiameter>
    </plugin>
  </gazebo>
</robot>
"""


@pytest.fixture
def cart(client):
    client.close_all()
    (client.folder / "package.xml").write_text("<package><name>p</name></package>")
    (client.folder / "cart.urdf.xacro").write_text(ROBOT)
    (client.folder / "wheel.xacro").write_text(WHEEL)
    client.open("cart.urdf.xacro")
    assert client.published("cart.urdf.xacro") == []
    return client


def codes(diagnostics: list[dict[str, Any]]) -> list[str]:
    return [diagnostic["code"] for diagnostic in diagnostics]


def test_what_is_typed_is_linted_before_it_is_saved(cart):
    cart.change("cart.urdf.xacro", ROBOT.replace('<child link="mast"/>', '<child link="mats"/>'))
    found = cart.published("cart.urdf.xacro")
    assert codes(found) == ["T202"]
    line = ROBOT[: ROBOT.index('<child link="mast"/>')].count("\n")
    assert found[0]["range"]["start"] == {"line": line, "character": 11}
    assert found[0]["severity"] == 1
    cart.change("cart.urdf.xacro", ROBOT[: ROBOT.index("<gazebo>")])
    assert codes(cart.published("cart.urdf.xacro")) == ["E001"]
    cart.change("cart.urdf.xacro", ROBOT)
    assert cart.published("cart.urdf.xacro") == []


def test_an_included_file_counts_as_it_is_typed(cart):
    cart.open("wheel.xacro")
    assert cart.published("wheel.xacro") == []
    cart.change("wheel.xacro", WHEEL.replace('<mass value="2"/>', '<mass value="-2"/>'))
    (found,) = cart.published("wheel.xacro")
    assert found["code"] == "I501"
    assert [place["message"] for place in found["relatedInformation"]] == ["call of macro `wheel`"] * 2
    assert found["relatedInformation"][0]["location"]["uri"] == cart.uri("cart.urdf.xacro")
    cart.tell("textDocument/didClose", {"textDocument": {"uri": cart.uri("wheel.xacro")}})
    assert cart.published("wheel.xacro") == []


def hover(cart, name: str, text: str, mark: str) -> str:
    found = cart.ask("textDocument/hover", cart.at(name, text, mark))
    return found["contents"]["value"] if found is not None else ""


def test_hover_shows_what_an_expression_comes_out_as(cart):
    text = hover(cart, "cart.urdf.xacro", ROBOT, "${2 * rad|ius}")
    assert text.startswith("`${radius}` = `0.2`\n\n---\n\n`${2 * radius}` = `0.4`\n")
    assert hover(cart, "wheel.xacro", WHEEL, 'name="rad|ius"') == "`${radius}` = `0.2`"
    assert "`${side}_wheel` = `left_wheel`, `right_wheel`" in hover(cart, "wheel.xacro", WHEEL, 'name="${si|de}_wheel"')


def test_hover_shows_masses_parameters_and_the_page_of_a_rule(cart):
    text = hover(cart, "wheel.xacro", WHEEL, '<mas|s value="2"/>')
    assert "**link `left_wheel`**" in text
    assert "mass 2 kg" in text
    assert "principal moments 0.03, 0.03, 0.04 kg·m²" in text
    assert "tensor 0.032, 0, 0, 0.032, 0, 0.032 kg·m²" in text
    text = hover(cart, "cart.urdf.xacro", ROBOT, "<wheelSep|aration>")
    assert "`<wheelSeparation>` of diff_drive (ros1): wheel separation [m], default" in text
    bad = ROBOT.replace('type="fixed"', 'type="hinge"')
    cart.change("cart.urdf.xacro", bad)
    assert "# joint-type-unknown (J402)" in hover(cart, "cart.urdf.xacro", bad, 'type="hi|nge"')
    assert hover(cart, "cart.urdf.xacro", bad, "<ro|bot name") == ""


def places(found: list[dict[str, Any]]) -> list[tuple[str, int]]:
    return sorted((place["uri"].rpartition("/")[2], place["range"]["start"]["line"] + 1) for place in found)


def line_of(text: str, part: str) -> int:
    return text[: text.index(part)].count("\n") + 1


@pytest.mark.parametrize(
    ("mark", "file", "part"),
    [
        ('<child link="ma|st"/>', "cart.urdf.xacro", '<link name="mast"/>'),
        ('reference="m|ast"', "cart.urdf.xacro", '<link name="mast"/>'),
        ("<leftJoint>left|_joint<", "wheel.xacro", "<joint name"),
        ("<xacro:wh|eel side", "wheel.xacro", "<xacro:macro"),
        ("${2 * rad|ius}", "wheel.xacro", "<xacro:property"),
        ('filename="whe|el.xacro"', "wheel.xacro", "<robot"),
    ],
)
def test_definitions(cart, mark, file, part):
    found = cart.ask("textDocument/definition", cart.at("cart.urdf.xacro", ROBOT, mark))
    assert places(found) == [(file, line_of({"wheel.xacro": WHEEL, "cart.urdf.xacro": ROBOT}[file], part))]


def test_the_parameter_of_a_macro_is_defined_in_its_head(cart):
    (found,) = cart.ask("textDocument/definition", cart.at("wheel.xacro", WHEEL, '"0 ${|y} 0"'))
    assert found["range"]["start"] == {"line": 2, "character": WHEEL.splitlines()[2].index("y:=0")}


def test_references_are_found_across_files_and_expansions(cart):
    def references(file: str, text: str, mark: str, *, own: bool = True) -> list[tuple[str, int]]:
        at = cart.at(file, text, mark)
        return places(cart.ask("textDocument/references", {**at, "context": {"includeDeclaration": own}}))

    assert references("wheel.xacro", WHEEL, '<parent link="ba|se"/>') == [
        ("cart.urdf.xacro", line_of(ROBOT, '<link name="base"/>')),
        ("cart.urdf.xacro", line_of(ROBOT, '<parent link="base"/>')),
        ("wheel.xacro", line_of(WHEEL, '<parent link="base"/>')),
    ]
    assert references("cart.urdf.xacro", ROBOT, "<xacro:whe|el side", own=False) == [
        ("cart.urdf.xacro", line_of(ROBOT, '<xacro:wheel side="left"')),
        ("cart.urdf.xacro", line_of(ROBOT, '<xacro:wheel side="right"')),
    ]
    assert ("cart.urdf.xacro", line_of(ROBOT, "<wheelDiameter>")) in references("wheel.xacro", WHEEL, "{rad|ius}")


def applied(text: str, edits: list[dict[str, Any]]) -> str:
    lines = text.splitlines(keepends=True)

    def offset(position: dict[str, int]) -> int:
        return sum(map(len, lines[: position["line"]])) + position["character"]

    for edit in sorted(edits, key=lambda e: offset(e["range"]["start"]), reverse=True):
        start, end = offset(edit["range"]["start"]), offset(edit["range"]["end"])
        text = text[:start] + edit["newText"] + text[end:]
    return text


@pytest.mark.parametrize(
    ("mark", "name", "words"),
    [
        ('<link name="ma|st"/>', "pole", ("mast", "pole")),
        ("<xacro:whe|el side", "roller", ("xacro:wheel", "xacro:roller")),
        ("${2 * rad|ius}", "half", (None, None)),
        ('<parent link="ba|se"/>', "body", ('"base"', '"body"')),
    ],
)
def test_renaming_changes_every_place_and_nothing_else(cart, mark, name, words):
    at = cart.at("cart.urdf.xacro", ROBOT, mark)
    assert cart.ask("textDocument/prepareRename", at) is not None
    changes = cart.ask("textDocument/rename", {**at, "newName": name})["changes"]
    robot = applied(ROBOT, changes.get(cart.uri("cart.urdf.xacro"), []))
    wheel = applied(WHEEL, changes.get(cart.uri("wheel.xacro"), []))
    old, new = words
    if name == "half":
        assert wheel == WHEEL.replace('name="radius"', 'name="half"').replace("${radius}", "${half}")
        assert robot == ROBOT.replace("2 * radius", "2 * half")
    elif name == "pole":
        assert robot == ROBOT.replace('"mast"', '"pole"')
        assert wheel == WHEEL
    elif name == "roller":
        assert robot == ROBOT.replace(old, new)
        assert wheel == WHEEL.replace('name="wheel"', 'name="roller"')
    else:
        assert (robot, wheel) == (ROBOT.replace(old, new), WHEEL.replace(old, new))


@pytest.mark.parametrize(
    ("file", "mark", "name", "message"),
    [
        ("cart.urdf.xacro", "<leftJoint>left|_joint<", "l", "computed by the expression `${side}_joint`"),
        ("cart.urdf.xacro", '<link name="ma|st"/>', "base", "link `base` already exists"),
        ("cart.urdf.xacro", '<link name="ma|st"/>', 'a"b', "is not a valid name for a link"),
        ("cart.urdf.xacro", "<?xml ver|sion", "x", "nothing to rename here"),
        ("wheel.xacro", '"0 ${|y} 0"', "side", "parameter `side` already exists"),
        ("cart.urdf.xacro", 'side="le|ft"', "right", "`right_joint` already exists"),
        ("cart.urdf.xacro", 'y="0|.2"', "0.3", "nothing to rename here"),
    ],
)
def test_what_cannot_be_renamed_is_refused(cart, file, mark, name, message):
    at = cart.at(file, {"wheel.xacro": WHEEL, "cart.urdf.xacro": ROBOT}[file], mark)
    with pytest.raises(AssertionError) as caught:
        cart.ask("textDocument/rename", {**at, "newName": name})
    assert message in str(caught.value)


def labels(cart, text: str, mark: str) -> list[str]:
    cart.change("cart.urdf.xacro", text)
    return [item["label"] for item in cart.ask("textDocument/completion", cart.at("cart.urdf.xacro", text, mark))]


@pytest.mark.parametrize(
    ("typed", "mark", "some", "none"),
    [
        ("<lin", "<lin|", {"link", "joint", "xacro:property", "xacro:wheel"}, {"visual"}),
        ('<link name="x"><v', "<v|", {"visual", "inertial"}, {"link"}),
        ('<joint name="x" ty', 'name="x" ty|', {"type"}, {"name"}),
        ('<joint name="x" type="', '"x" type="|', {"fixed", "continuous"}, {"base"}),
        ('<joint name="x"><child link="m', '<child link="m|', {"mast", "left_wheel"}, {"mast_joint"}),
        ('<joint name="x"><mimic joint="', '<mimic joint="|', {"left_joint", "mast_joint"}, {"mast"}),
        ('<transmission name="t"><joint name="', '<transmission name="t"><joint name="|', {"left_joint"}, {"mast"}),
        ('<ros2_control name="r"><joint name="', '<ros2_control name="r"><joint name="|', {"mast_joint"}, {"mast"}),
        ('<joint name="', '  <joint name="|\n', set(), {"left_joint", "mast_joint", "mast"}),
        ("<xacro:wheel ", "<xacro:wheel |\n", {"side", "y"}, {"name"}),
        ('<link name="${ra', '"${ra|', {"radius"}, {"link"}),
        ('<link name="$(arg ', "$(arg |", {"tall"}, set()),
        ('<xacro:include filename="', '<xacro:include filename="|\n', {"wheel.xacro"}, {"package.xml"}),
        (
            '<gazebo><plugin name="p" filename="libgazebo_ros_diff_drive.so"><wheel',
            'so"><wheel|',
            {"wheelSeparation"},
            {"link"},
        ),
        (
            '<gazebo><plugin name="p" filename="libgazebo_ros_diff_drive.so"><leftJoint></leftJoint>',
            'so"><leftJoint>|<',
            {"left_joint"},
            {"mast"},
        ),
    ],
)
def test_completion(cart, typed, mark, some, none):
    text = ROBOT.replace("  <gazebo reference", f"  {typed}\n  <gazebo reference")
    found = labels(cart, text, mark)
    assert some <= set(found)
    assert not none & set(found)


def test_what_is_completed_replaces_what_was_typed(cart):
    text = ROBOT.replace("  <gazebo reference", '  <joint name="x"><child link="ma\n  <gazebo reference')
    cart.change("cart.urdf.xacro", text)
    at = cart.at("cart.urdf.xacro", text, 'link="ma|\n')
    items = {item["label"]: item for item in cart.ask("textDocument/completion", at)}
    assert applied(text, [items["mast"]["textEdit"]]) == text.replace('link="ma\n', 'link="mast\n')


def test_fixes_are_quick(cart):
    text = ROBOT.replace('<xacro:wheel side="left"', '<wheel side="left"')
    cart.change("cart.urdf.xacro", text)
    found = cart.published("cart.urdf.xacro")[0]
    asked = {
        "textDocument": {"uri": cart.uri("cart.urdf.xacro")},
        "range": found["range"],
        "context": {"diagnostics": []},
    }
    (action,) = cart.ask("textDocument/codeAction", asked)
    title = "Replace with `xacro:wheel` [X102]"
    assert (action["title"], action["isPreferred"], action["kind"]) == (title, True, "quickfix")
    assert applied(text, action["edit"]["changes"][cart.uri("cart.urdf.xacro")]) == ROBOT


def test_a_file_that_is_no_robot_and_one_that_was_never_saved_do_no_harm(cart):
    (cart.folder / "world.xacro").write_text("<sdf/>")
    cart.open("world.xacro")
    assert cart.published("world.xacro") == []
    cart.tell(
        "textDocument/didOpen",
        {"textDocument": {"uri": "untitled:1", "languageId": "xml", "version": 1, "text": "<robot"}},
    )
    at = {"textDocument": {"uri": "untitled:1"}, "position": {"line": 0, "character": 2}}
    assert cart.ask("textDocument/hover", at) is None
    assert cart.ask("textDocument/completion", at) == []


@pytest.mark.slow
def test_a_target_that_is_none():
    from urdfkit.cli import main

    assert main(["lsp", "--target", "gazebo"]) == 2


def test_without_pygls_it_says_what_to_install(monkeypatch, capsys):
    import sys

    from urdfkit.cli import main

    monkeypatch.setitem(sys.modules, "pygls.lsp.server", None)
    assert main(["lsp"]) == 2
    assert capsys.readouterr().err == "urdfkit: lsp needs pygls: pip install 'urdfkit[lsp]'\n"


REQUESTS: dict[str, dict[str, Any]] = {
    "hover": {},
    "definition": {},
    "references": {"context": {"includeDeclaration": True}},
    "prepareRename": {},
    "completion": {},
}


@pytest.mark.parametrize(
    "uri", ["untitled:1", "http://a/b.urdf", "file:", "file:///", "file://[", "", "no", "file:///a%00b", "sub", "gone"]
)
def test_what_is_no_file_is_answered_by_nothing(cart, uri):
    (cart.folder / "sub").mkdir(exist_ok=True)
    uri = cart.uri(f"{uri}.urdf" if uri == "gone" else uri) if uri in ("sub", "gone") else uri
    at = {"textDocument": {"uri": uri}, "position": {"line": 1, "character": 1}}
    for name, more in REQUESTS.items():
        assert not cart.ask(f"textDocument/{name}", {**at, **more})
    where = {"start": at["position"], "end": at["position"]}
    within = {"textDocument": {"uri": uri}, "range": where, "context": {"diagnostics": []}}
    assert cart.ask("textDocument/codeAction", within) == []


def test_a_file_that_is_not_open_is_answered_for_as_it_is_on_disk(cart):
    at = cart.at("wheel.xacro", WHEEL, "${rad|ius}")
    assert "0.2" in cart.ask("textDocument/hover", at)["contents"]["value"]
    (cart.folder / "wheel.xacro").write_text(WHEEL.replace("0.1 * 2", "0.15 * 2"))
    cart.tell("workspace/didChangeWatchedFiles", {"changes": []})
    assert "0.3" in cart.ask("textDocument/hover", at)["contents"]["value"]


@pytest.mark.parametrize(("line", "column"), [(10**6, 0), (2, 10**6), (2**31 - 1, 2**31 - 1), (0, 0), (1, 6)])
def test_places_that_are_not_there_are_answered(cart, line, column):
    at = {"textDocument": {"uri": cart.uri("cart.urdf.xacro")}, "position": {"line": line, "character": column}}
    for name, more in REQUESTS.items():
        cart.ask(f"textDocument/{name}", {**at, **more})


def test_findings_tell_the_version_that_they_were_found_in(cart):
    cart.change("cart.urdf.xacro", ROBOT.replace('<link name="mast"/>', '<link nam="mast"/>'))
    assert cart.published("cart.urdf.xacro")
    assert cart.looked_at[cart.uri("cart.urdf.xacro")] == cart._versions["cart.urdf.xacro"] > 1


@pytest.mark.parametrize(
    ("typed", "label"),
    [
        ('<link name="x"><visual></', "visual>"),
        ('<link name="x"><visual/></', "link>"),
        ('<link name="x"><visual></visual></li', "link>"),
        ("<link name='x'/></", "robot>"),
        ("<xacro:if value='1'></", "xacro:if>"),
    ],
)
def test_end_tags_are_completed(cart, typed, label):
    text = ROBOT.replace("  <gazebo reference", f"{typed}\n  <gazebo reference", 1)
    assert labels(cart, text, f"{typed}|\n  <gazebo") == [label]
    assert labels(cart, text.replace(f"{typed}\n", f"{typed}>"), f"{typed}|>") == [label[:-1]]


def test_packages_are_completed(cart):
    for scheme, some in (("package://", "p/"), ("package://p/", "wheel.stl")):
        (cart.folder / "wheel.stl").write_bytes(b"")
        mesh = f'<link name="x"><visual><geometry><mesh filename="{scheme}"/></geometry></visual></link>'
        text = ROBOT.replace("  <gazebo reference", f"{mesh}\n  <gazebo reference", 1)
        assert some in labels(cart, text, f'"{scheme}|"')


def test_hover_shows_the_head_of_a_macro(cart):
    (shown,) = [cart.ask("textDocument/hover", cart.at("cart.urdf.xacro", ROBOT, "<xacro:whe|el side"))["contents"]]
    assert "**macro `wheel`**, wheel.xacro:3" in shown["value"]
    assert '`params="side y:=0"`' in shown["value"]
    assert "needs `side`" in shown["value"]


@pytest.mark.parametrize("mark", ['"0 ${|y} 0"', 'params="side |y:=0"'])
def test_references_of_a_parameter_are_its_declaration_its_uses_and_what_calls_give(cart, mark):
    at = cart.at("wheel.xacro", WHEEL, mark)
    for own in (True, False):
        found = places(cart.ask("textDocument/references", {**at, "context": {"includeDeclaration": own}}))
        assert found == [
            ("cart.urdf.xacro", line_of(ROBOT, '<xacro:wheel side="left"')),
            ("cart.urdf.xacro", line_of(ROBOT, '<xacro:wheel side="right"')),
            *([("wheel.xacro", line_of(WHEEL, "<xacro:macro"))] if own else []),
            ("wheel.xacro", line_of(WHEEL, '"0 ${y} 0"')),
        ]


SETTINGS = """mast_controller:
  type: effort_controllers/JointPositionController
  joint: mast_joint
  base_frame_id: base  # mast_joint
base_controller:
  type: diff_drive_controller/DiffDriveController
  left_wheel: ['left_joint']
"""


@pytest.mark.slow
def test_renaming_goes_through_the_settings_around(cart):
    (cart.folder / "control.yaml").write_text(SETTINGS)
    try:
        cart.tell("workspace/didChangeWatchedFiles", {"changes": []})
        for mark, name, words in (
            ('name="mast|_joint"', "pole", ("joint: mast_joint", "joint: pole")),
            ('<link name="ba|se"/>', "body", ("id: base", "id: body")),
        ):
            at = cart.at("cart.urdf.xacro", ROBOT, mark)
            changes = cart.ask("textDocument/rename", {**at, "newName": name})["changes"]
            assert applied(SETTINGS, changes[cart.uri("control.yaml")]) == SETTINGS.replace(*words)
            found = places(cart.ask("textDocument/references", {**at, "context": {"includeDeclaration": True}}))
            assert ("control.yaml", line_of(SETTINGS, words[0])) in found
    finally:
        (cart.folder / "control.yaml").unlink()
        cart.tell("workspace/didChangeWatchedFiles", {"changes": []})


@pytest.mark.slow
def test_a_misspelt_name_in_the_settings_around_is_replaced(cart):
    written = SETTINGS.replace("mast_joint", "mast_jont", 1)
    (cart.folder / "control.yaml").write_text(written)
    try:
        cart.tell("workspace/didChangeWatchedFiles", {"changes": []})
        uri = cart.uri("control.yaml")
        place = {"line": 2, "character": 9}
        asked = {"textDocument": {"uri": uri}, "range": {"start": place, "end": place}, "context": {"diagnostics": []}}
        (action,) = cart.ask("textDocument/codeAction", asked)
        assert action["title"] == "Replace with `mast_joint` (a guess) [K959]"
        assert applied(written, action["edit"]["changes"][uri]) == SETTINGS
    finally:
        (cart.folder / "control.yaml").unlink()
        cart.tell("workspace/didChangeWatchedFiles", {"changes": []})
