"""Read a launch file of any format with the files it includes; no launch file is executed."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path

from urdfkit.description.launch.launch_scope import LaunchContents, LaunchScope
from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xml.reader import document_of, read_source, shown_path
from urdfkit.errors import UrdfkitError

_MAX_BYTES = 100_000


def read_launch_file(path: Path, packages: Packages, texts: Mapping[str, str] | None = None) -> LaunchContents:
    """Return the xacro commands and nodes of a launch file; files that cannot be read count as empty.

    Args:
        path: a file with a suffix of `related_files.LAUNCH`.
        packages: finds packages.
        texts: absolute path → content to use instead of the file on disk.
    """
    found = LaunchContents(path)
    read = partial(_read, texts or {})
    read(LaunchScope(path, packages, found, read))
    return found


def _read(texts: Mapping[str, str], scope: LaunchScope) -> None:
    from urdfkit.description.launch.xml_launch import elements_of, read_elements

    path = scope.path
    try:
        if path.stat().st_size > _MAX_BYTES:
            return
        source = read_source(path, shown_as=shown_path(path), texts=texts)
        if path.suffix == ".py":
            from urdfkit.description.launch.python_constants import parsed
            from urdfkit.description.launch.python_launch import read_tree

            if (tree := parsed(source)) is not None:
                read_tree(tree, scope)
        elif path.suffix in (".yaml", ".yml"):
            from urdfkit.description.control.parameter_yaml import parse_settings

            # The separator splits names of parameters; names of actions have no parts.
            root = parse_settings(source, separator="\0").children.get("launch")
            if root is not None:
                read_elements(list(elements_of(root)), scope)
        else:
            read_elements([document_of(source)], scope)
    except (UrdfkitError, OSError, RecursionError):
        return
