"""``urdfkit mcp`` with the client of the package mcp, which the specification's authors maintain."""

from __future__ import annotations

import base64
import io
import os
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import anyio
import numpy as np
import pytest
from PIL import Image

from urdfkit.cli import main

if TYPE_CHECKING:
    from mcp import Client

BAD = """<robot name="r">
  <link name="a"/>
  <joint name="j" type="revolut"><parent link="a"/><child link="b"/></joint>
</robot>
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    root = tmp_path / "ws"
    root.mkdir()
    (root / "bad.urdf").write_text(BAD)
    (tmp_path / "secret.xacro").write_text('<robot><link name="secret"/></robot>')
    (tmp_path / "secret.yaml").write_text("word: hidden")
    head = '<robot name="r" xmlns:xacro="http://ros.org/xacro">'
    read = f"xacro.load_yaml('{tmp_path}/secret.yaml')['word']"
    (root / "reads.xacro").write_text(f'{head}<link name="${{{read}}}"/></robot>')
    (root / "includes.xacro").write_text(f'{head}<xacro:include filename="../secret.xacro"/></robot>')
    (root / "variable.xacro").write_text(f'{head}<link name="$(optenv SECRET unknown)"/></robot>')
    (root / "link.urdf").symlink_to(tmp_path / "secret.xacro")
    (root / "endless.xacro").write_text(f'{head}<link name="${{sum([i for i in range(10**9)])}}"/></robot>')
    return root


def session(folder: Path, work: Callable[[Client], Awaitable[Any]], *options: str) -> Any:
    """Start the server, run `work` with a client, and return its result."""
    from mcp import Client, StdioServerParameters  # takes seconds, and only slow tests use it

    command = ["-m", "urdfkit", "mcp", "--root", str(folder), *options]
    server = StdioServerParameters(command=sys.executable, args=command, env={**os.environ, "SECRET": "hidden"})

    async def talk() -> Any:
        async with Client(server) as client:
            return await work(client)

    return anyio.run(talk)


@pytest.mark.slow
def test_an_assistant_lints_fixes_and_measures(folder: Path) -> None:
    async def work(client: Client) -> None:
        tools = {tool.name: tool for tool in (await client.list_tools()).tools}
        assert sorted(tools) == ["fix", "ik", "info", "lint", "picture", "rule", "sim_run"]
        assert all(tool.description for tool in tools.values())
        found = (await client.call_tool("lint", {"path": "bad.urdf"})).structured_content
        assert {"J402", "T202"} <= {finding["code"] for finding in found["findings"]}
        fixed = (await client.call_tool("fix", {"path": "bad.urdf", "unsafe": True})).structured_content
        assert '+  <joint name="j" type="revolute">' in fixed["patch"]
        assert fixed["written"] is False
        refused = await client.call_tool("fix", {"path": "bad.urdf", "write": True})
        assert refused.is_error
        assert "--allow-fixes" in refused.content[0].text
        page = await client.call_tool("rule", {"code": "J402"})
        assert page.content[0].text.startswith("# joint-type-unknown (J402)")
        robot = (await client.call_tool("info", {"robot": "simpleton"})).structured_content
        assert robot["links"]

    session(folder, work)


@pytest.mark.slow
def test_an_unknown_argument_is_refused_with_the_nearest(folder: Path) -> None:
    async def work(client: Client) -> None:
        for tool, arguments, message in (
            ("lint", {"robot": "bad.urdf"}, "`lint` has no argument `robot`; arguments: path, target, arguments"),
            ("lint", {"path": "bad.urdf", "targt": "ros2"}, "`lint` has no argument `targt`; did you mean `target`?"),
            ("rule", {"code": "J402", "name": "x"}, "`rule` has no argument `name`"),
        ):
            refused = await client.call_tool(tool, arguments)
            assert refused.is_error
            assert message in refused.content[0].text
        schemas = [tool.input_schema for tool in (await client.list_tools()).tools]
        assert [schema["additionalProperties"] for schema in schemas] == [False] * len(schemas)

    session(folder, work)


@pytest.mark.slow
def test_a_wrong_call_is_refused_in_one_line_that_names_the_argument(folder: Path) -> None:
    tip = {"robot": "seven_dof_arm", "tip": "grasping_frame"}

    async def work(client: Client) -> None:
        for tool, arguments, message in (
            ("sim_run", {"robot": "simpleton"}, "sim_run: missing argument `seconds`, a number"),
            ("sim_run", {"robot": "simpleton", "seconds": "ten"}, 'sim_run: `seconds` is "ten", not a number'),
            ("sim_run", {"robot": "simpleton", "seconds": 1e9}, "seconds is 1e+09; use more than 0 and at most 600"),
            ("ik", {**tip, "xyz": [1, 2]}, "ik: `xyz` is [1, 2], not 3 numbers"),
            ("ik", {"tip": "a", "xyz": "q"}, 'ik: missing argument `robot`, a string; `xyz` is "q", not 3 numbers'),
            ("ik", {**tip, "xyz": [1, 2, 3], "rpy": 1}, "ik: `rpy` is 1, not 3 numbers"),
            ("fix", {"path": "bad.urdf", "write": "perhaps"}, 'fix: `write` is "perhaps", not true or false'),
            ("picture", {"robot": "r", "width": "1.5"}, 'picture: `width` is "1.5", not an integer'),
            (
                "picture",
                {"robot": "r", "joints": {"a": "b"}},
                'picture: `joints` is {"a": "b"}, not an object of numbers',
            ),
            ("lint", {"arguments": [1]}, "lint: `arguments` is [1], not an object of strings"),
            ("lint", {"path": "../x"}, f"`../x` is outside the folder {folder}; the server reads no other folder"),
            ("lnit", {}, "unknown tool `lnit`; did you mean `lint`?"),
        ):
            refused = await client.call_tool(tool, arguments)
            assert refused.is_error
            assert refused.content[0].text == message

    session(folder, work)


@pytest.mark.slow
def test_an_assistant_writes_fixes_where_the_server_permits_it(folder: Path) -> None:
    async def work(client: Client) -> None:
        arguments = {"path": "bad.urdf", "unsafe": True, "write": True}
        assert (await client.call_tool("fix", arguments)).structured_content["written"] is True

    session(folder, work, "--allow-fixes")
    assert 'type="revolute"' in (folder / "bad.urdf").read_text()


@pytest.mark.slow
def test_an_assistant_moves_simulates_and_sees_a_robot(folder: Path) -> None:
    async def work(client: Client) -> None:
        pose = {"robot": "seven_dof_arm", "tip": "grasping_frame", "xyz": [0.4, 0.2, 0.4]}
        assert (await client.call_tool("ik", pose)).structured_content["reached"] == 1
        run = {"robot": "simpleton", "seconds": 2.0, "cmd_vel": [0.5, 0, 0]}
        state = (await client.call_tool("sim_run", run)).structured_content
        assert 0.5 < state["base"]["position"][0] < 1.0
        shown = await client.call_tool("picture", {"robot": "simpleton", "width": 200, "height": 150})
        picture = np.asarray(Image.open(io.BytesIO(base64.b64decode(shown.content[0].data))))
        assert picture.shape == (150, 200, 3)
        orange = (picture[..., 0] > 150) & (picture[..., 2] < 60)
        assert 0.02 < orange.mean() < 0.5
        assert (await client.call_tool("sim_run", {"robot": "simpleton", "seconds": 1e9})).is_error

    session(folder, work)


@pytest.mark.slow
def test_a_call_reads_nothing_outside_of_its_folder_and_ends(folder: Path) -> None:
    async def work(client: Client) -> None:
        async def text(tool: str, **arguments: Any) -> str:
            result = await client.call_tool(tool, arguments)
            return " ".join(part.text for part in result.content)

        for path in ("../secret.xacro", "/etc/passwd", "link.urdf", "--help", "a\0b"):
            for tool in ("lint", "fix"):
                assert "hidden" not in await text(tool, path=path)
                assert "is outside the folder" in (said := await text(tool, path=path)) or "is not a path" in said
        for robot in ("reads.xacro", "includes.xacro", "variable.xacro"):
            said = await text("info", robot=robot)
            assert "hidden" not in said
            assert "secret" not in said.replace("secret.yaml", "").replace("secret.xacro", "")
        assert "unknown" in await text("info", robot="variable.xacro")
        assert "outside" in await text("sim_run", robot="simpleton", seconds=1.0, world="../secret.sdf")
        endless = await text("info", robot="endless.xacro")
        assert "endless" in endless or "took longer" in endless

    session(folder, work, "--time-limit", "20")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--root", "missing"], "--root: no such folder: missing"),
        (["--time-limit", "0"], "`0` is not a number of seconds"),
    ],
)
def test_wrong_arguments(words: list[str], message: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["mcp", *words]) == 2
    assert message in capsys.readouterr().err
