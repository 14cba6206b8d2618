"""Find robot descriptions in packages and folders, without parsing XML.

The first tag distinguishes a robot from a file of macros.
"""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.errors import ResourceError

MODEL_SUFFIXES = (".urdf", ".xacro")
"""Suffixes of model files."""

_SKIPPED_FOLDERS = {"build", "install", "devel", "log", "node_modules", "__pycache__", "test", "tests"}
_IGNORE_MARKS = ("CATKIN_IGNORE", "COLCON_IGNORE", "AMENT_IGNORE")
_MAX_DEPTH = 6

_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_ROOT = re.compile(r"""<robot\b((?:"[^"]*"|'[^']*'|[^>"'])*)>""")
_NAME = re.compile(r"""(?<![\w:])name\s*=\s*(?:"([^"]*)"|'([^']*)')""")
# A file of colours or properties is not a robot, whatever its name: a robot has a link, or an element that may add one.
_SUBSTANCE = re.compile(r"<link\b|<xacro:(?!macro\b|property\b|arg\b)")
_INCLUDED = re.compile(r"""<xacro:include\b[^>]*?filename\s*=\s*["'][^"']*?([^/"'\\]+)["']""")


def models_in(folder: Path) -> list[Path]:
    """Return the model files of a package, of a folder of packages, or of a bare folder.

    A model is a file whose root is ``<robot name=…>``, which has links or includes, and which no other file includes.
    A ``.urdf`` generated from a ``.xacro`` in the same folder is skipped.

    Args:
        folder: the folder to search.

    Raises:
        ResourceError: a file cannot be read.
    """
    texts: dict[Path, str] = {}
    for path in _walk(folder, 0):
        if path.suffix.lower() in MODEL_SUFFIXES or path.suffix == ".gazebo":
            texts[path] = _text(path)
    included = {name for text in texts.values() for name in _INCLUDED.findall(text)}
    roots = {path: _ROOT.search(text) for path, text in texts.items() if path.suffix.lower() in MODEL_SUFFIXES}
    candidates = [
        path
        for path, root in roots.items()
        if root and path.name not in included and _SUBSTANCE.search(texts[path], root.end())
    ]
    named = [path for path in candidates if _NAME.search(roots[path][1])]  # type: ignore[index]
    chosen = named or candidates
    sources = {(path.parent, stem(path)) for path in chosen if path.suffix.lower() == ".xacro"}
    return sorted(p.resolve() for p in chosen if p.suffix.lower() == ".xacro" or (p.parent, stem(p)) not in sources)


def _walk(folder: Path, depth: int) -> Iterator[Path]:
    content = children(folder)
    if any(child.name in _IGNORE_MARKS for child in content):
        return
    for child in content:
        if child.is_file():
            yield child
        elif depth < _MAX_DEPTH and _is_worth_a_look(child):
            yield from _walk(child, depth + 1)


def _is_worth_a_look(folder: Path) -> bool:
    skipped = folder.name in _SKIPPED_FOLDERS or folder.name.startswith((".", "_"))
    return not skipped and folder.is_dir() and not folder.is_symlink()


def children(folder: Path) -> list[Path]:
    """Return the content of a folder, sorted; nothing if it cannot be read."""
    try:
        return sorted(folder.iterdir())
    except OSError:
        return []


def _text(path: Path) -> str:
    try:
        return _COMMENT.sub("", path.read_text(encoding="utf-8", errors="replace"))
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error


def robot_name(path: Path) -> str | None:
    """Return the name of the robot in a file; None if it is missing or an expression."""
    root = _ROOT.search(_text(path))
    written = _NAME.search(root[1]) if root else None
    name = (written[1] or written[2] or "") if written else ""
    return name if name and "$" not in name else None


def stem(path: Path) -> str:
    """Return the name of a file without the suffixes of robot descriptions."""
    return re.sub(r"(\.urdf)?(\.xacro)?$", "", path.name, count=1, flags=re.IGNORECASE)
