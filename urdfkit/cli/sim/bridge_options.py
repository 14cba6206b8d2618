"""``--rosbridge``, ``--foxglove`` and ``--allow-origin``: let other programs subscribe, publish and call services."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from urdfkit.cli.sim.ros_options import add_ros, ros_options
from urdfkit.errors import UsageError

if TYPE_CHECKING:
    from urdfkit.app.simulation.bridging.bridges import BridgeOptions
    from urdfkit.bridges.websocket.address import Address

ROSBRIDGE_PORT, FOXGLOVE_PORT = 9090, 8765


def add_bridges(parser: argparse.ArgumentParser, *, note: str = "") -> None:
    """Add the options; `note` follows the titles of their groups."""
    group = parser.add_argument_group(f"bridges to other programs{note}")
    group.add_argument(
        "--rosbridge",
        nargs="?",
        type=_address,
        const=str(ROSBRIDGE_PORT),
        metavar="PORT",
        help=f"serve roslibjs, roslibpy and other clients of rosbridge (default: {ROSBRIDGE_PORT} on this machine; "
        "HOST:PORT accepts connections from other machines, which need the token in the address)",
    )
    group.add_argument(
        "--foxglove",
        nargs="?",
        type=_address,
        const=str(FOXGLOVE_PORT),
        metavar="PORT",
        help=f"serve Foxglove and other clients of its WebSocket protocol (default: {FOXGLOVE_PORT} on this machine; "
        "HOST:PORT as above)",
    )
    group.add_argument(
        "--allow-origin",
        action="append",
        type=_origin,
        default=[],
        metavar="ORIGIN",
        help="accept web pages from this origin, e.g. https://example.org (repeatable; default: pages of this machine)",
    )
    add_ros(parser, note=note)


def bridge_options(arguments: argparse.Namespace) -> BridgeOptions:
    """Return the options.

    Raises:
        UsageError: ``--allow-origin`` without a bridge, or invalid options of ``--ros2``.
        MissingDependencyError: no library for ``--ros2`` is installed.
    """
    from urdfkit.app.simulation.bridging.bridges import BridgeOptions

    options = BridgeOptions(
        rosbridge=arguments.rosbridge,
        foxglove=arguments.foxglove,
        origins=arguments.allow_origin,
        ros=ros_options(arguments),
    )
    if arguments.allow_origin and options.rosbridge is None and options.foxglove is None:
        raise UsageError("--allow-origin requires --rosbridge or --foxglove")
    return options


def _address(text: str) -> Address:
    from urdfkit.bridges.websocket.address import parse_address

    try:
        return parse_address(text)
    except UsageError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def _origin(text: str) -> str:
    """An origin as browsers send it: in lower case, without a slash at the end."""
    from urllib.parse import urlsplit

    origin = text.rstrip("/").lower()
    parts = urlsplit(origin)
    if origin != "null" and (not parts.scheme or not parts.netloc or origin != f"{parts.scheme}://{parts.netloc}"):
        raise argparse.ArgumentTypeError(f"`{text}` is not an origin; use https://HOST or http://HOST:PORT")
    return origin
