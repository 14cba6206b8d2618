# ruff: noqa: E501 - one case a line
from __future__ import annotations

import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
import xacro

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.expand import expand
from urdfkit.description.xml.start_tag import start_tag
from urdfkit.errors import ResourceError, XacroError, XmlError
from urdfkit.lint.engine.checker import model_of
from urdfkit.lint.project.options import Options

Write = Callable[[str, str], Path]

MAIN = """<?xml version="1.0"?>
HEAD
  <xacro:include filename="parts/wheel.xacro"/>
  <xacro:arg name="count" default="2"/>
  <xacro:property name="radius" value="0.1"/>
  <xacro:property name="shape"><sphere radius="${radius}"/></xacro:property>
\t<link name="base"/>
  <!-- é中😀 --><link name="näher"/>
  <xacro:if value="$(arg count)"><xacro:wheel side="left"><origin xyz="0 1 0"/></xacro:wheel></xacro:if>
  <xacro:call macro="wheel" side="right"><origin xyz="0 -1 0"/></xacro:call>
  <xacro:element xacro:name="link" name="extra"><xacro:attribute name="kind" value="k${radius*2}"/></xacro:element>
</robot>
"""
WHEEL = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="wheel" params="side *pose">
    <link name="${side}_wheel">
      <visual><xacro:insert_block name="pose"/><geometry><xacro:insert_block name="shape"/></geometry></visual>
      <xacro:ball r="${radius}"/>
    </link>
  </xacro:macro>
  <xacro:macro name="ball" params="r"><collision><geometry><sphere radius="${r}"/></geometry></collision></xacro:macro>
</robot>
"""


def stock(path: Path, **arguments: str) -> str:
    return str(xacro.process_file(str(path), mappings=dict(arguments)).toprettyxml(indent="  "))


@pytest.fixture
def model(write: Write) -> Path:
    write("parts/wheel.xacro", WHEEL)
    return write("robot.xacro", MAIN)


def test_same_bytes_as_stock_xacro(model: Path) -> None:
    assert expand(model).xml == stock(model)
    assert expand(model, arguments={"count": "0"}).xml == stock(model, count="0")


def test_places_and_chains(model: Path) -> None:
    root = expand(model).root
    assert root is not None
    found = {
        f"{element.tag}:{element.get('name') or element.get('radius') or element.get('xyz') or ''}": element.origin
        for element in root.walk()
    }
    assert str(found["link:base"].position) == "robot.xacro:7:2"
    assert str(found["link:näher"].position) == "robot.xacro:8:15"
    assert str(found["link:extra"].position) == "robot.xacro:11:3"
    left = found["link:left_wheel"]
    assert str(left.position) == "parts/wheel.xacro:3:5"
    assert [(c.macro, str(c.position)) for c in left.expansions] == [("wheel", "robot.xacro:9:34")]
    assert [(c.macro, str(c.position)) for c in found["link:right_wheel"].expansions] == [("wheel", "robot.xacro:10:3")]
    # A block is written where the call is, and a property's block where the property is.
    assert str(found["origin:0 1 0"].position) == "robot.xacro:9:59"
    assert found["origin:0 1 0"].expansions == ()
    inner = next(e for e in root.walk() if e.tag == "collision").origin
    assert [(c.macro, str(c.position)) for c in inner.expansions] == [
        ("ball", "parts/wheel.xacro:5:7"),
        ("wheel", "robot.xacro:9:34"),
    ]


@pytest.mark.parametrize("prefix", ["", "\ufeff"])
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_byte_order_mark_and_line_ends_do_not_move_anything(write: Write, prefix: str, newline: str) -> None:
    text = prefix + 'HEAD\n<!-- ü -->\t<link name="a"/>\n</robot>\n'.replace("\n", newline)
    expanded = expand(write("a.xacro", text))
    assert expanded.root is not None
    link = expanded.root.children[0]
    assert str(link.origin.position) == "a.xacro:2:12"
    tag = start_tag(expanded.sources["a.xacro"], link.origin.position)
    assert tag is not None
    assert tag.attributes["name"].raw == "a"


def test_files_sources_and_definitions(model: Path, tmp_path: Path) -> None:
    expanded = expand(model)
    assert expanded.files == (tmp_path / "robot.xacro", tmp_path / "parts/wheel.xacro")
    assert list(expanded.sources) == ["robot.xacro", "parts/wheel.xacro"]
    assert list(expanded.documents) == ["robot.xacro", "parts/wheel.xacro"]
    assert expanded.macros["wheel"].parameters == ("side", "*pose")
    assert str(expanded.macros["wheel"].position) == "parts/wheel.xacro:2:3"
    assert str(expanded.properties["radius"]) == "robot.xacro:5:3"
    assert expanded.documents["robot.xacro"].find("xacro:property") is not None


def test_yaml_files_are_files_of_the_model(write: Write, tmp_path: Path) -> None:
    write("sizes.yaml", "radius: 0.25\n")
    main = write(
        "r.xacro",
        'HEAD<xacro:property name="s" value="${xacro.load_yaml(\'sizes.yaml\')}"/><link name="r${s.radius}"/></robot>',
    )
    expanded = expand(main)
    assert expanded.root is not None
    assert expanded.root.children[0].get("name") == "r0.25"
    assert tmp_path / "sizes.yaml" in expanded.files


def test_urdf_files_are_read_as_they_are(write: Write) -> None:
    plain = write("a.urdf", '<robot name="r">\n  <link name="${x}"/>\n</robot>')
    root = expand(plain).root
    assert root is not None
    assert root.children[0].get("name") == "${x}"
    assert str(root.children[0].origin.position) == "a.urdf:2:3"
    with pytest.raises(XacroError, match="`x` is not defined"):
        expand(plain, run_xacro=True)


def test_the_xacro_package_is_not_loaded(model: Path) -> None:
    script = (
        "import sys; from urdfkit.description.xacro.expand import expand; assert expand(sys.argv[1]).xml;"
        "assert 'xacro' not in sys.modules"
    )
    done = subprocess.run([sys.executable, "-c", script, str(model)], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")


def test_arguments_do_not_leak_into_the_next_expansion(write: Write) -> None:
    path = write("a.xacro", 'HEAD<xacro:arg name="n" default="one"/><link name="$(arg n)"/></robot>')
    given = {"n": "two"}
    for arguments, name in ((given, "two"), (None, "one"), (given, "two"), ({}, "one")):
        root = expand(path, arguments=arguments).root
        assert root is not None
        assert root.children[0].get("name") == name
    assert given == {"n": "two"}


def test_threads_expand_files_at_the_same_time(write: Write) -> None:
    paths = [
        write(f"{n}.xacro", f'HEAD<xacro:property name="n" value="{n}"/><link name="l${{n}}"/></robot>')
        for n in range(4)
    ]
    names: dict[int, set[str | None]] = {n: set() for n in range(4)}

    def work(n: int) -> None:
        for _ in range(20):
            root = expand(paths[n]).root
            assert root is not None
            names[n].add(root.children[0].get("name"))

    threads = [threading.Thread(target=work, args=(n,)) for n in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert names == {n: {f"l{n}"} for n in range(4)}


@pytest.mark.parametrize(
    ("text", "place", "message"),
    [
        ('HEAD\n<link name="${radus}"/><xacro:property name="radius" value="1"/></robot>', "2:1", "property `radus` is not defined"),
        ('HEAD<xacro:property name="radius" value="1"/>\n<link><a b="${radus}"/></link></robot>', "2:7", "did you mean `radius`?"),
        ('HEAD\n<xacro:property name="a" value="${b*2}"/>\n<link name="${a}"/></robot>', "2:1", "`b` is not defined"),
        (
            'HEAD\n<xacro:property name="a" value="1"/><xacro:property name="a" remove="true"/>\n<link name="${a}"/></robot>',
            "3:1",
            "is not defined here: it is defined at m.xacro:2:1",
        ),
        ('HEAD\n<link name="${late}"/>\n<xacro:property name="late" value="1"/></robot>', "2:1", "is not defined yet: its definition follows at m.xacro:3:1"),
        ('HEAD<xacro:macro name="wheel"/>\n<xacro:whel/></robot>', "2:1", "macro `whel` is not defined; did you mean `wheel`?"),
        ('HEAD<xacro:macro name="w" params="a b:=1"/>\n<xacro:w/></robot>', "2:1", "macro `w` needs `a`"),
        ('HEAD<xacro:macro name="w" params="side"/>\n<xacro:w sid="1"/></robot>', "2:1", "no parameter `sid`; did you mean `side`?"),
        ('HEAD<xacro:macro name="w" params="*b"/>\n<xacro:w/></robot>', "2:1", "needs more blocks"),
        ('HEAD<xacro:macro name="w"/>\n<xacro:w><a/></xacro:w></robot>', "2:1", "no further block `<a>`"),
        ('HEAD\n<link name="$(arg nam)"/></robot>', "2:1", "argument `nam` has no value; pass nam:=value"),
        ('HEAD<xacro:arg name="name" default=""/>\n<link name="$(arg nam)"/></robot>', "2:1", "did you mean `name`?"),
        ('HEAD\n<xacro:include filename="othr.xacro"/></robot>', "2:1", "file othr.xacro does not exist; did you mean `other.xacro`?"),
        ('HEAD\n<xacro:include filename="$(find my_packge)/x"/></robot>', "2:1", "no package `my_packge`"),
        ('HEAD\n<xacro:if value="maybe"/></robot>', "2:1", "`maybe`, neither true nor false"),
        ('HEAD\n<link name="${1/0}"/></robot>', "2:1", "cannot evaluate `${1/0}`: division by zero"),
        ('HEAD\n<link name="${1 +}"/></robot>', "2:1", "cannot evaluate `${1 +}`: invalid syntax"),
        ('HEAD\n<link>${1/0}</link></robot>', "2:1", "division by zero"),
        ('HEAD\n<xacro:insert_block name="b"/></robot>', "2:1", "block `b` is not defined"),
        ("HEAD\n<xacro:macro><a/></xacro:macro></robot>", "2:1", "has no attribute `name`"),
        ('HEAD\n<xacro:property name="a" value="${b}"/><xacro:property name="b" value="${a}"/><a b="${a}"/></robot>', "2:1", "property `a` is defined in terms of itself: a → b → a"),
        ('HEAD<xacro:macro name="a">\n<xacro:b/></xacro:macro><xacro:macro name="b"><xacro:a/></xacro:macro><xacro:a/></robot>', "2:", "calls itself in an infinite recursion: "),
        ('HEAD\n<xacro:include filename="m.xacro"/></robot>', "2:1", "files include each other in a cycle: m.xacro → m.xacro"),
        ("HEAD\n<a b=\"${xacro.fatal('no', 'way')}\"/></robot>", "2:1", "no way"),
    ],
)  # fmt: skip
def test_errors_are_one_line_at_the_right_place(write: Write, text: str, place: str, message: str) -> None:
    write("other.xacro", "HEAD</robot>")
    with pytest.raises(XacroError) as caught:
        expand(write("m.xacro", text))
    line = str(caught.value)
    assert line.startswith(f"m.xacro:{place}")
    assert message in line
    assert "\n" not in line


def test_an_error_inside_a_macro_names_the_chain(write: Write) -> None:
    path = write(
        "m.xacro",
        'HEAD<xacro:macro name="in" params="x">\n<link name="${x + y}"/></xacro:macro>'
        '<xacro:macro name="out">\n<xacro:in x="1"/></xacro:macro>\n<xacro:out/></robot>',
    )
    with pytest.raises(XacroError) as caught:
        expand(path)
    assert str(caught.value) == (
        "m.xacro:2:1: property `y` is not defined (in `in` called at m.xacro:3:1, `out` called at m.xacro:4:1)"
    )


def test_an_error_in_an_included_file_is_placed_there(write: Write) -> None:
    write("inner.xacro", "HEAD\n\n  <link>\n</robot>")
    with pytest.raises(XmlError) as caught:
        expand(write("m.xacro", 'HEAD<xacro:include filename="inner.xacro"/></robot>'))
    assert str(caught.value).startswith(
        "inner.xacro:3:3: mismatched tag: `<link>` is not closed before `</robot>` on line 4"
    )


def test_macros_that_multiply_are_stopped(write: Write) -> None:
    levels = "".join(f'<xacro:macro name="m{i + 1}">{f"<xacro:m{i}/>" * 10}</xacro:macro>' for i in range(9))
    path = write("m.xacro", f'HEAD<xacro:macro name="m0"/>{levels}<xacro:m9/></robot>')
    with pytest.raises(XacroError, match="limit of 10,000 macro calls"):
        expand(path)


def test_an_attribute_that_xacro_leaves_a_number_is_text(write: Write) -> None:
    path = write("m.xacro", 'HEAD<a><xacro:attribute name="n" value="${1 + 1}"/></a></robot>')
    with pytest.raises(AttributeError):
        stock(path)
    expanded = expand(path)
    assert expanded.root is not None
    assert expanded.root.children[0].get("n") == "2"
    assert '<a n="2"/>' in expanded.xml


def test_a_comment_that_xml_does_not_allow_is_an_error_with_its_place(write: Write) -> None:
    text = "HEAD\n<link><!-- xacro:eval-comments --><!-- ${'-' * 2} --></link></robot>"
    with pytest.raises(XacroError, match=r"m\.xacro:2:1: a comment of this element contains `--`"):
        _ = expand(write("m.xacro", text)).xml


def test_half_a_character_is_an_error(write: Write) -> None:
    with pytest.raises(
        XacroError, match=r"m\.xacro:1:1: the expanded file contains '\\ud800', which is not a valid character"
    ):
        _ = expand(write("m.xacro", "HEAD${'\\ud800'}</robot>")).xml


def test_as_deep_a_loop_as_stock_xacro_can_do(write: Write) -> None:
    path = write(
        "m.xacro",
        'HEAD<xacro:macro name="loop" params="n"><link name="l${n}"/>'
        '<xacro:if value="${n > 0}"><xacro:loop n="${n - 1}"/></xacro:if></xacro:macro><xacro:loop n="200"/></robot>',
    )
    expanded = expand(path)
    assert expanded.root is not None
    assert len(expanded.root.children) == 201
    assert expanded.xml == stock(path)


def test_macros_may_nest_elements_deeper_than_a_file(write: Write) -> None:
    path = write(
        "m.xacro",
        'HEAD<xacro:macro name="nest" params="n"><a><b><c>'
        '<xacro:if value="${n > 0}"><xacro:nest n="${n - 1}"/></xacro:if></c></b></a></xacro:macro><xacro:nest n="100"/></robot>',
    )
    root = expand(path).root
    assert root is not None
    assert sum(1 for _ in root.walk()) == 1 + 3 * 101


def test_warnings_are_notes_with_a_place(write: Write, capsys: pytest.CaptureFixture[str]) -> None:
    expanded = expand(
        write("m.xacro", 'HEAD\n<a b="${xacro.warning(\'hot\')}"/>\n<xacro:property name="pi" value="3"/></robot>')
    )
    assert [(str(w.position), w.message) for w in expanded.warnings] == [
        ("m.xacro:2:1", "hot"),
        ("m.xacro:3:1", "redefining global symbol: pi"),
    ]
    assert capsys.readouterr() == ("", "")


def test_find_without_ros(write: Write) -> None:
    write("ws/src/one/package.xml", "<package><name>one</name></package>")
    write("ws/src/two/package.xml", "<package><name>two</name></package>")
    write("ws/src/two/urdf/part.xacro", 'HEAD<link name="part"/></robot>')
    main = write(
        "ws/src/one/urdf/m.xacro",
        'HEAD<xacro:include filename="$(find two)/urdf/part.xacro"/><link name="$(find one)"/></robot>',
    )
    root = expand(main).root
    assert root is not None
    assert [link.get("name") for link in root.children] == [
        "part",
        str(Path("ws/src/one").absolute()),
    ]
    assert str(root.children[0].origin.position).startswith("ws/src/two/urdf/part.xacro:1:")


def test_a_source_folder_stands_for_what_cmake_installs(write: Write) -> None:
    write("demo/package.xml", "<package><name>demo</name></package>")
    write(
        "demo/description/urdf/inner.xacro",
        "HEAD<link name=\"${xacro.load_yaml('$(find demo)/config/c.yaml').n}\"/></robot>",
    )
    write("demo/description/config/c.yaml", "n: seven")
    main = write(
        "demo/description/urdf/m.xacro", 'HEAD<xacro:include filename="$(find demo)/urdf/inner.xacro"/></robot>'
    )
    root = expand(main).root
    assert root is not None
    assert root.children[0].get("name") == "seven"


@pytest.mark.parametrize(
    ("name", "message"),
    [("robt.xacro", "no such file: robt.xacro; did you mean `robot.xacro`?"), ("parts", "parts is a folder")],
)
def test_what_is_no_file(model: Path, name: str, message: str) -> None:
    for suffix in ("", ".urdf") if name != "parts" else ("",):
        with pytest.raises(ResourceError, match="no such file" if suffix else None) as caught:
            expand(name + suffix)
        assert suffix or message in str(caught.value)


def test_packages_can_be_given(write: Write) -> None:
    write("elsewhere/p/package.xml", "<package><name>p</name></package>")
    main = write("m.xacro", 'HEAD<link name="$(find p)"/></robot>')
    root = expand(main, packages=Packages(["elsewhere"])).root
    assert root is not None
    assert root.children[0].get("name") == str(Path("elsewhere/p").absolute())


def test_symbolic_links_that_lead_back_are_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("self.xacro").symlink_to("self.xacro")
    Path("alias.xacro").symlink_to("r.xacro")
    for included, message in (
        ("self.xacro", "is a symbolic link to self.xacro, which does not exist or leads back to the link"),
        ("alias.xacro", "files include each other in a cycle: r.xacro → r.xacro"),
    ):
        Path("r.xacro").write_text(
            f'<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:include filename="{included}"/></robot>'
        )
        with pytest.raises(XacroError, match=message):
            expand("r.xacro", packages=Packages((), Path("r.xacro")))


@pytest.mark.parametrize(
    ("written", "text"),
    [
        ("a<![CDATA[b]]>", "ab"),
        ("a<!-- b --><![CDATA[c]]>d", "acd"),
        ("<![CDATA[ a ]]>", "a"),
        ("a<![CDATA[b]]>${name}<!-- c -->", "abone"),
        ("${name}<!-- ${unknown} --><![CDATA[${name}]]>", "one${name}"),
    ],
)
def test_the_text_of_an_element_is_its_character_data_without_comments(write: Write, written: str, text: str) -> None:
    path = write(
        "a.xacro",
        f"""<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">
        <xacro:property name="name" value="one"/>
        <xacro:macro name="noted"><link name="base"><origin>{written}</origin></link></xacro:macro>
        <link name="base"><origin>{written}</origin></link><xacro:noted/><xacro:noted/></robot>""",
    )
    links = model_of(path, Options((), (), None, {}, ())).robot.links
    assert [link.element.children[0].text for link in links] == [text] * 3
