"""``--controllers`` and ``--ros-distro``: how the plugins of the robot are configured and behave."""

import argparse
from pathlib import Path


def add_controllers(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--controllers",
        action="append",
        type=parameter_file,
        default=[],
        metavar="FILE.yaml",
        help="controller parameters to use instead of those of the robot's packages (repeatable)",
    )


def parameter_file(text: str) -> str:
    """Return the path of an existing file.

    Raises:
        argparse.ArgumentTypeError: the file does not exist.
    """
    from urdfkit.description.packages.similar_names import near_path

    path = Path(text)
    if not path.is_file():
        wrong = "it is a folder" if path.is_dir() else f"no such file{near_path(path)}"
        raise argparse.ArgumentTypeError(f"cannot read {text}: {wrong}")
    return text


def add_distro(parser: argparse.ArgumentParser) -> None:
    """Add the option; the simulator checks its value."""
    parser.add_argument(
        "--ros-distro",
        metavar="NAME",
        help="reproduce the behaviour of this ROS distribution, e.g. kinetic (default: the newest)",
    )
