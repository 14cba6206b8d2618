"""``urdfkit expand``: xacro to URDF, without ROS installed."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from urdfkit.cli.parser import add_model
from urdfkit.cli.unused_arguments import unused
from urdfkit.errors import ResourceError, UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.xacro.expanded import Expanded


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit expand``."""
    parser.epilog = (
        "examples:\n"
        "  urdfkit expand simpleton > simpleton.urdf\n"
        "  urdfkit expand urdf/arm.urdf.xacro -o arm.urdf prefix:=left_"
    )
    add_model(parser)
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="write to FILE, all or nothing")


def run(arguments: argparse.Namespace) -> int:
    """Expand and print, or write the file."""
    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.expand import expand
    from urdfkit.resources import find_model

    model = find_model(arguments.model, package_path=arguments.package_path)
    # A path is passed as typed, because the banner shows it, as in stock xacro.
    typed = next((word for word in arguments.model if ":=" not in word and Path(word).is_file()), str(model.path))
    expanded = expand(
        typed, arguments=model.arguments, packages=Packages(model.package_path, model.path), run_xacro=True
    )
    if not arguments.quiet:
        _show_notes(expanded, model.arguments)
    if arguments.output is None:
        sys.stdout.write(expanded.xml)
    else:
        _write(expanded, arguments.output)
    return 0


def _show_notes(expanded: Expanded, arguments: dict[str, str]) -> None:
    for note in expanded.warnings:
        print(f"{note.position}: {note.level}: {note.message}", file=sys.stderr)
    for line in unused(arguments, [source.text for source in expanded.sources.values()]):
        print(f"urdfkit: warning: {line}", file=sys.stderr)


def _write(expanded: Expanded, output: Path) -> None:
    from urdfkit.atomic import write_text

    if any(output.exists() and file.exists() and output.samefile(file) for file in expanded.files):
        raise UsageError(f"expand: -o {output} would overwrite a file that was read")
    if output.is_dir():
        raise ResourceError(f"cannot write {output}: it is a folder")
    try:
        output.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise ResourceError(f"cannot write {output}: {error.strerror or error}") from error
    write_text(output, expanded.xml)
