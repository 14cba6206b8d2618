"""Options of every command that simulates: robot, world, controllers, renderer, repairs; and its warnings."""

import argparse
import sys
from pathlib import Path

from urdfkit.cli.parser import add_model
from urdfkit.cli.robot_arguments.launch_arguments_option import add_launch_arguments
from urdfkit.cli.robot_arguments.robot_loading import add_macro, add_strict
from urdfkit.cli.sim import option_values
from urdfkit.notice import Notice

SYNONYMS = {"gl": ("opengl", "egl", "gpu", "moderngl"), "ray": ("rays", "raycast", "raycaster", "raytracer", "cpu")}
"""Other names of the renderers."""


def add_simulation_options(parser: argparse.ArgumentParser) -> None:
    """Add the robot, the world, the ROS distribution, the controllers, the renderer and the repairs."""
    add_model(parser)
    add_macro(parser)
    add_launch_arguments(parser, "simulation")
    parser.add_argument(
        "--world",
        default="empty",
        metavar="WORLD",
        help="bundled world (empty, void, house, …) or an SDF file (default: empty)",
    )
    parser.add_argument(
        "--ros-distro",
        metavar="NAME",
        help="reproduce the behaviour of this ROS distribution, e.g. kinetic (default: the newest)",
    )
    parser.add_argument(
        "--controllers",
        action="append",
        type=parameter_file,
        default=[],
        metavar="FILE.yaml",
        help="controller parameters to use instead of those of the robot's packages (repeatable)",
    )
    parser.add_argument(
        "--renderer",
        type=_renderer,
        choices=("auto", "ray", "gl"),
        default="auto",
        help="renderer of camera images: ray casts rays (also rays, cpu), gl uses OpenGL (also opengl, egl, "
        "gpu), auto selects the faster one (default: auto)",
    )
    add_strict(parser, "an estimated mass")
    parser.add_argument(
        "--density",
        type=option_values.positive,
        default=1000.0,
        metavar="KG/M3",
        help="density for the estimated mass of moving links without a mass [kg/m³] (default: 1000)",
    )


def print_warning(text: str) -> None:
    """Print a warning of a simulation, a note (`Repairs.add`) or the line before a compilation on standard error."""
    before = {"warning": "urdfkit: warning: ", "note": "urdfkit: ", "progress": ""}[Notice.of(text).severity]
    print(f"{before}{text}", file=sys.stderr, flush=True)


def _renderer(word: str) -> str:
    """Return the renderer with a name or synonym."""
    plain = word.lower()
    return next((name for name, others in SYNONYMS.items() if plain in others), plain)


def parameter_file(text: str) -> str:
    """Return the path of an existing file.

    Raises:
        argparse.ArgumentTypeError: the file does not exist.
    """
    from urdfkit.missing_files import missing_path

    path = Path(text)
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{text} is a folder" if path.is_dir() else missing_path(text))
    return text
