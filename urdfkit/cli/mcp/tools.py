"""Tools of the MCP server; a docstring is the description that the assistant reads."""

from __future__ import annotations

import json
from base64 import b64decode
from collections.abc import Callable
from functools import partial, wraps
from math import radians
from typing import TYPE_CHECKING, Any

import anyio.to_thread
from mcp.server.mcpserver import Image, MCPServer
from mcp.server.mcpserver.exceptions import ToolError
from mcp.types import Tool, ToolAnnotations
from pydantic import ValidationError

from urdfkit import __version__
from urdfkit.cli.mcp.argument_errors import unknown_argument, wrong_arguments
from urdfkit.errors import UrdfkitError, did_you_mean

if TYPE_CHECKING:
    from urdfkit.cli.mcp.calls import ToolCalls

MAX_SECONDS = 600.0
"""Maximum simulated time of one call [s]."""

MAX_FINDINGS = 200
"""Maximum number of findings in the result of one call."""

_INSTRUCTIONS = """Tools for robot descriptions (URDF and xacro). Paths are relative to the folder of the server. A
robot is a .urdf or .xacro file, a package folder, or a bundled name such as `simpleton` or `seven_dof_arm`. `arguments`
are xacro arguments. Units are SI, angles in radians, quaternions x y z w."""


def _in_thread(tool: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(tool)
    async def called(**values: Any) -> Any:
        try:
            return await anyio.to_thread.run_sync(partial(tool, **values))
        except UrdfkitError as error:
            raise ToolError(str(error)) from None

    return called


class _StrictServer(MCPServer):
    """Server whose tools refuse unknown arguments, which the package mcp ignores, with messages of one line."""

    async def list_tools(self) -> list[Tool]:
        """Return the tools; their schemas allow no other arguments."""
        tools = await super().list_tools()
        for tool in tools:
            tool.input_schema = {**tool.input_schema, "additionalProperties": False}
        return tools

    async def call_tool(self, name: str, arguments: dict[str, Any], context: Any = None) -> Any:
        """Call a tool.

        Raises:
            ToolError: the tool lacks an argument, or fails.
        """
        tools = {tool.name: tool for tool in await self.list_tools()}
        if name not in tools:
            raise ToolError(f"unknown tool `{name}`{did_you_mean(name, tools)}")
        if (message := unknown_argument(tools[name], arguments)) is not None:
            raise ToolError(message)
        try:
            return await super().call_tool(name, arguments, context)
        except ToolError as error:  # its text has the prefix `Error executing tool`, and its cause has not
            if isinstance(error.__cause__, ValidationError):
                names = [str(each["loc"][0]) for each in error.__cause__.errors()]
                raise ToolError(wrong_arguments(tools[name], arguments, names)) from None
            if isinstance(error.__cause__, ToolError):
                raise error.__cause__ from None
            raise


def server_for(calls: ToolCalls, *, allow_fixes: bool) -> MCPServer:
    """Return the server.

    Args:
        calls: runs the commands.
        allow_fixes: whether the tool `fix` may write files.
    """
    server = _StrictServer("urdfkit", instructions=_INSTRUCTIONS, version=__version__, log_level="WARNING")
    reads = ToolAnnotations(read_only_hint=True, open_world_hint=False)

    @server.tool(annotations=reads)
    @_in_thread
    def lint(path: str = ".", target: str | None = None, arguments: dict[str, str] | None = None) -> dict[str, Any]:
        """Report the defects of a URDF or xacro file, a package or a workspace, each with its line and its fix.

        `target` is the consumer: ros1, ros2, gz, classic, mujoco, isaac, drake, moveit or any.
        """
        words = [*calls.robot(path, arguments), *([f"--target={target}"] if target else [])]
        found = calls.value("lint", *words, "--confined", "--format=json")
        return {"count": len(found), "findings": found[:MAX_FINDINGS]}

    @server.tool(annotations=reads)
    @_in_thread
    def rule(code: str) -> str:
        """Return the page of a lint rule, such as I503: the defect, the reason, and an example."""
        return calls.run("rule", calls.path(code))

    @server.tool(annotations=ToolAnnotations(read_only_hint=not allow_fixes, open_world_hint=False))
    @_in_thread
    def fix(path: str, unsafe: bool = False, write: bool = False) -> dict[str, Any]:
        """Return the fixes of the findings as a patch; with `write`, apply them if the server permits it.

        `unsafe` includes fixes that may change the robot.
        """
        if write and not allow_fixes:
            raise ToolError("this server writes no files; start it with --allow-fixes, or apply the patch yourself")

        words = [calls.path(path), "--confined", *(["--unsafe-fixes"] if unsafe else [])]
        patch = calls.run("lint", *words, "--diff")
        if write:
            calls.run("lint", *words, "--fix", "--quiet")
        return {"patch": patch, "written": write and bool(patch)}

    @server.tool(annotations=reads)
    @_in_thread
    def info(robot: str, arguments: dict[str, str] | None = None) -> dict[str, Any]:
        """Return links, joints, degrees of freedom, mass, bounding box, sensors and drives of a robot."""
        found: dict[str, Any] = calls.value("info", *calls.robot(robot, arguments), "--json")
        return found

    @server.tool(annotations=reads)
    @_in_thread
    def ik(
        robot: str,
        tip: str,
        xyz: tuple[float, float, float],
        rpy: tuple[float, float, float] | None = None,
        arguments: dict[str, str] | None = None,
    ) -> dict[str, Any]:
        """Compute joint positions that place the link `tip` at a pose in the root link, or why it cannot be reached.

        `xyz` is the position [m] and `rpy` the orientation [rad]; without `rpy` any orientation is accepted.
        """
        pose = [f"--xyz={_numbers(xyz)}", f"--rpy={_numbers(rpy)}" if rpy is not None else "--position-only"]
        found: dict[str, Any] = calls.value("ik", *calls.robot(robot, arguments), calls.path(tip), *pose, "--json")
        return found

    @server.tool(annotations=reads)
    @_in_thread
    def sim_run(
        robot: str,
        seconds: float,
        cmd_vel: tuple[float, float, float] | None = None,
        world: str = "empty",
        arguments: dict[str, str] | None = None,
    ) -> dict[str, Any]:
        """Simulate a robot headless and return the final state: base, joints, odometry, contacts, topics.

        `cmd_vel` is a constant command: x and y [m/s], yaw rate [rad/s]. `world` is a bundled world or an SDF file.
        """
        if not 0.0 < seconds <= MAX_SECONDS:
            raise ToolError(f"seconds is {seconds:g}; use more than 0 and at most {MAX_SECONDS:g}")

        words = [*calls.robot(robot, arguments), f"--for={seconds!r}", f"--world={calls.path(world)}"]
        words += [f"--cmd-vel={_numbers(cmd_vel)}"] if cmd_vel is not None else []
        calls.warm_up()
        found: dict[str, Any] = calls.value("sim", "run", *words, "--json")
        return found

    @server.tool(annotations=reads)
    @_in_thread
    def picture(
        robot: str,
        joints: dict[str, float] | None = None,
        azimuth_degrees: float = 35.0,
        elevation_degrees: float = 25.0,
        width: int = 800,
        height: int = 600,
        arguments: dict[str, str] | None = None,
    ) -> Image:
        """Return a picture of a robot as PNG, seen from a direction, with joints at given positions [rad or m]."""
        calls.robot(robot, arguments)  # checks the names
        options = {
            "robot": calls.path(robot),
            "arguments": arguments or {},
            "joints": joints or {},
            "azimuth": radians(azimuth_degrees),
            "elevation": radians(elevation_degrees),
            "width": width,
            "height": height,
        }
        calls.warm_up()
        return Image(data=b64decode(calls.run("picture", json.dumps(options))), format="png")

    return server


def _numbers(values: tuple[float, float, float]) -> str:
    return ",".join(repr(float(value)) for value in values)
