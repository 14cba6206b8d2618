"""Notes on required xacro arguments without a value: their descriptions, and the values that launch files pass."""

import re
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from urdfkit.errors import UrdfkitError, XacroError
from urdfkit.resources import ModelArgument


@contextmanager
def listing_required_arguments(model: ModelArgument, *, quiet: bool = False) -> Iterator[None]:
    """Print one line per required argument without a value if the robot cannot be expanded inside the context.

    Args:
        model: the robot and its arguments.
        quiet: print nothing.
    """
    try:
        yield
    except XacroError:
        if not quiet:
            for line in required_arguments(model):
                print(f"urdfkit: {line}", file=sys.stderr)
        raise


def required_arguments(model: ModelArgument) -> list[str]:
    """Return one line per argument of a robot that has neither a value nor a default.

    Args:
        model: the robot and its arguments.
    """
    from urdfkit.description.launch.launch_arguments import description_of, passed_to, values_of
    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.expand import expand_leniently
    from urdfkit.description.xml.reader import shown_path

    packages = Packages(model.package_path, model.path)
    try:
        expanded = expand_leniently(model.path, arguments=model.arguments, packages=packages)
    except UrdfkitError:
        return []
    names = dict.fromkeys(fault.name for fault in expanded.faults if fault.kind == "undefined-arg" and fault.name)
    passed = passed_to(model.path, packages) if names else []
    lines = []
    for name in names:
        text = comment_above(name, (source.text for source in expanded.sources.values())) or description_of(
            name, passed
        )
        values = ", ".join(f"{name}:={value} ({shown_path(path)})" for value, path in values_of(name, passed))
        lines.append(
            f"required argument `{name}`{f': {text}' if text else ''}"
            f"; {f'launch files pass {values}' if values else 'no launch file passes a constant value'}"
        )
    return lines


def comment_above(name: str, texts: Iterable[str]) -> str:
    """Return the comment right above the declaration or a use of an argument; empty without one.

    Args:
        name: name of the argument.
        texts: texts of the files to search.
    """
    own = re.escape(name)
    commented = re.compile(rf"-->\s*<(?:xacro:arg\b[^<>]*?\bname\s*=\s*[\"']{own}[\"']|[^<>]*?\$\(arg\s+{own}\s*\))")
    for text in texts:
        if (found := commented.search(text)) is not None:
            return " ".join(text[: found.start()].rpartition("<!--")[2].split())
    return ""
