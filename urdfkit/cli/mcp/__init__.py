"""``urdfkit mcp``: the Model Context Protocol on standard input and output, for assistants.

Each call of a tool runs in a process of its own, which is limited in time and memory and reads only one folder.
"""

import argparse

from urdfkit.cli.parser import seconds
from urdfkit.errors import MissingDependencyError, ResourceError
from urdfkit.missing_files import expanded_path, missing_path

TIME_LIMIT = 60.0
"""Default limit of the wall time of one call [s]."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.epilog = "examples:\n  urdfkit mcp --root ~/my_ws/src\n  urdfkit mcp --root . --allow-fixes"
    parser.add_argument(
        "--root", default=".", metavar="DIR", help="read only files in this folder (default: the working directory)"
    )
    parser.add_argument("--allow-fixes", action="store_true", help="let the tool `fix` write files in the folder")
    parser.add_argument(
        "--time-limit",
        type=seconds(1.0, 3600.0, "number of seconds from 1 to 3600"),
        default=TIME_LIMIT,
        metavar="S",
        help=f"stop a call after S seconds (default: {TIME_LIMIT:g})",
    )


def run(arguments: argparse.Namespace) -> int:
    """Serve until the client closes the connection.

    Raises:
        ResourceError: the folder does not exist.
        MissingDependencyError: the package mcp is not installed.
    """
    root = expanded_path(arguments.root)
    if not root.is_dir():
        raise ResourceError(f"--root: {missing_path(arguments.root, 'folder')}")
    try:
        import mcp.server.mcpserver  # noqa: F401
    except ImportError as error:
        raise MissingDependencyError("mcp needs mcp: pip install 'urdfkit[mcp]'") from error
    from urdfkit.cli.mcp.calls import ToolCalls
    from urdfkit.cli.mcp.tools import server_for

    server_for(ToolCalls(root.resolve(), arguments.time_limit), allow_fixes=arguments.allow_fixes).run("stdio")
    return 0
