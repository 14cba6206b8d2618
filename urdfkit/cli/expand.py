"""``urdfkit expand``: xacro to URDF, without ROS installed."""

import argparse
import sys
from pathlib import Path

from urdfkit.cli.parser import add_model, add_time_limit
from urdfkit.cli.robot_arguments.robot_loading import add_macro, named_robot
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xacro.declared_arguments import unused_arguments
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.errors import ModelError, UrdfkitError, UsageError, XacroError
from urdfkit.resources import ModelArgument


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of ``urdfkit expand``."""
    parser.epilog = (
        "examples:\n"
        "  urdfkit expand simpleton > simpleton.urdf\n"
        "  urdfkit expand urdf/arm.urdf.xacro -o arm.urdf prefix:=left_\n"
        "  urdfkit expand urdf/arm.urdf.xacro --compare\n\n"
        "exit status of --compare: 0 equal, 1 different, 2 not compared"
    )
    add_model(parser)
    add_macro(parser)
    add_time_limit(parser)
    output = parser.add_mutually_exclusive_group()
    output.add_argument(
        "-o",
        "--output",
        type=Path,
        metavar="FILE",
        help="write to FILE atomically, and create missing folders, as xacro does",
    )
    output.add_argument(
        "--compare", action="store_true", help="print the first difference from the output of the xacro package"
    )


def run(arguments: argparse.Namespace) -> int:
    """Expand and print, or write the file."""
    from urdfkit.description.xml.cost_limit import CostLimit

    with CostLimit(arguments.time_limit):
        return _run(arguments)


def _run(arguments: argparse.Namespace) -> int:
    from urdfkit.atomic import check_output_files
    from urdfkit.description.xacro.expand import expand

    model = named_robot(arguments.model, arguments)
    if arguments.output is not None:
        check_output_files("-o", [arguments.output])
    # A path is passed as typed, because the banner shows it, as in stock xacro.
    typed = next((word for word in arguments.model if ":=" not in word and Path(word).is_file()), str(model.path))
    packages = Packages(model.package_path, model.path)
    texts = None
    if model.macro is not None:
        from urdfkit.description.xacro.macro_call import text_with_call

        if arguments.compare:
            raise UsageError("expand: --macro cannot be combined with --compare; xacro has no such option")
        texts = text_with_call(model.path, model.macro, model.arguments, packages)
    if arguments.compare:
        return _compare(typed, model.arguments, packages)
    expanded = expand(typed, arguments=model.arguments, packages=packages, run_xacro=True, texts=texts)
    _refuse_other_formats(expanded, typed)
    if not arguments.quiet:
        _show_notes(expanded, model)
    if arguments.output is None:
        sys.stdout.write(expanded.xml)
    else:
        _write(expanded, arguments.output)
    return 0


def _refuse_other_formats(expanded: Expanded, path: str) -> None:
    """Raise if a file is of another format than URDF and without xacro, so that nothing is to be expanded.

    Raises:
        ModelError: the file is of another format, without xacro.
    """
    from urdfkit.description.document_root import OTHER_ROOTS

    root = expanded.root
    if root is not None and (kind := OTHER_ROOTS.get(root.tag)) is not None:
        if any("xmlns:xacro" in source.text for source in expanded.sources.values()):
            return
        hint = f"; simulate it with `urdfkit sim run --world {path}`" if root.tag in ("sdf", "gazebo") else ""
        raise ModelError(f"this is {kind} without xacro{hint}", position=root.origin.position)


def _compare(path: str, arguments: dict[str, str], packages: Packages) -> int:
    """Print the first difference from the output of the xacro package.

    Raises:
        UrdfkitError: neither can expand the file.
    """
    from urdfkit.description.xacro.comparison import first_difference, text_of_xacro, version
    from urdfkit.description.xacro.expand import expand

    stock = f"xacro {version()}"
    try:
        wanted = text_of_xacro(path, arguments, packages)
    except XacroError as failure:
        try:
            _ = expand(path, arguments=arguments, packages=packages, run_xacro=True).xml
        except UrdfkitError:
            print(f"{stock} fails too: {failure}", file=sys.stderr)
            raise
        print(f"{path}: {stock} fails, but urdfkit expands the file\n  xacro: {failure}")
        return 1
    try:
        text = expand(path, arguments=arguments, packages=packages, run_xacro=True).xml
    except UrdfkitError as error:
        print(f"{path}: urdfkit fails, but {stock} expands the file\n  urdfkit: {error}")
        return 1
    difference = first_difference(wanted, text)
    if difference is None:
        print(f"{path}: equal to the output of {stock} ({text.count(chr(10))} lines)")
        return 0
    print(f"{path}: differs from the output of {stock} on line {difference.line}, column {difference.column}")
    for name, line in (("xacro", difference.first), ("urdfkit", difference.second)):
        print(f"  {name + ':':8} {'(no further line)' if line is None else line}")
    return 1


def _show_notes(expanded: Expanded, model: ModelArgument) -> None:
    for note in expanded.warnings:
        print(f"{note.position}: {note.level}: {note.message}", file=sys.stderr)
    for line in expanded.packages.notes.values():
        print(f"urdfkit: warning: {line}", file=sys.stderr)
    for line in unused_arguments(model.arguments, expanded.sources.values(), model.macro):
        print(f"urdfkit: warning: {line}", file=sys.stderr)


def _write(expanded: Expanded, output: Path) -> None:
    from urdfkit.atomic import write_text

    if any(output.exists() and file.exists() and output.samefile(file) for file in expanded.files):
        raise UsageError(f"expand: -o {output} would overwrite a file that was read")
    write_text(output, expanded.xml)
