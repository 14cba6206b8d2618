"""Messages, services, actions and modules of packages of the workspace that the code of nodes imports.

Sources: genpy and genmsg (names in ROS 1), rosidl_cmake (string_camel_case_to_lower_case_underscore, names of headers
in ROS 2), and setuptools (entry points import the module of a package, not the file in its folder).
"""

from __future__ import annotations

import re
import sys
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_file
from urdfkit.description.packages.kept_files import kept
from urdfkit.description.packages.related_files import neighbours
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.packaging.build_files import BuildFiles
from urdfkit.lint.facts.packaging.code_packages import lines_of_imports
from urdfkit.lint.facts.packaging.targets import included
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.project.code_files import node_texts

_KINDS = {"msg": "message", "srv": "service", "action": "action"}
_OF_ACTIONS = ("Action", "Goal", "Result", "Feedback", "ActionGoal", "ActionResult", "ActionFeedback")
"""Ends of the names of the messages that ROS 1 generates for an action."""

_RELEASED = {"std_srvs": "srv", "std_msgs": "msg", "geometry_msgs": "msg", "trajectory_msgs": "msg"}
"""Package of ROS → the only kind of its interfaces."""

_PYTHON = r"(?m)^[ \t]*from[ \t]+(\w+)\.(msg|srv|action)[ \t]+import[ \t]+(\([^()]*\)|[^\n#;(]+)"
_CPP = r"(?m)^[ \t]*#[ \t]*include[ \t]*[<\"]((\w+)/(?:(msg|srv|action)/)?(\w+)\.(?:h|hpp))[>\"]"
_MODULE = r"(?m)^(?:from[ \t]+(\w+)[ \t]+import\b|import[ \t]+(\w+)[ \t]*(?=$|as\b|#))"

Defects = Iterator[tuple[Source, int, str, str]]


def wrong_imports(files: BuildFiles) -> Defects:
    """Yield file, offset, name and message of each import in the code of a package that fails."""
    near = neighbours(files.folder)
    for path, text in node_texts(files.folder):
        if path.suffix == ".py":
            yield from _in_python(path, text, near)
            yield from _siblings(path, text, files, near)
        elif "#" in text:
            yield from _in_cpp(path, text, near)


def _in_python(path: Path, text: str, near: Mapping[str, Path]) -> Defects:
    lines: set[int] | None = None
    for at in re.finditer(_PYTHON, text):
        package, kind = at[1], at[2]
        interfaces = _interfaces(near[package]) if package in near else {}
        only = _RELEASED.get(package) if package not in near else None
        if not interfaces and only in (None, kind):
            continue
        source = Source(shown_path(path), text)
        lines = lines_of_imports(text) if lines is None else lines
        if source.position(at.start()).line not in lines:
            continue
        if only is not None:
            yield source, at.start(2), kind, f"`{package}` has no {_KINDS[kind]}s" + Suggestion(f"{package}.{only}")
            continue
        for name in re.finditer(r"(\w+)(?:[ \t]+as[ \t]+\w+)?", re.sub(r"#[^\n]*", _blank, at[3])):
            other = next((each for each in interfaces if name[1] in interfaces[each]), None)
            if name[1] in interfaces[kind] or name[1].partition("_")[0] in interfaces[kind]:
                continue
            if other is not None:
                message = f"`{name[1]}` is {_a(other)}" + Suggestion(f"{package}.{other}", f"{package}.{kind}")
                yield source, at.start(1), f"{package}.{kind}", message
                break
            if interfaces[kind]:  # else they may be in another folder
                slip = next((each for each in sorted(interfaces[kind]) if _is_near(name[1], each)), None)
                message = f"`{package}` has no {_KINDS[kind]} `{name[1]}`" + Suggestion(slip, name[1])
                yield source, at.start(3) + name.start(1), name[1], message


def _in_cpp(path: Path, text: str, near: Mapping[str, Path]) -> Defects:
    headers: list[str] | None = None
    for at in re.finditer(_CPP, text):
        header, package, kind, stem = at.groups()
        folder = near.get(package)
        interfaces = _interfaces(folder) if folder is not None else {}
        if folder is None or not interfaces or is_file(folder / "include" / header) or is_file(folder / header):
            continue
        if kind is None and header.endswith(".hpp"):
            continue
        headers = included(path) if headers is None else headers
        if header not in headers:
            continue
        if kind is None:
            every = {name for each in interfaces.values() for name in each}
            slip = next((name for name in sorted(every) if _is_near(stem, name)), None)
            if stem not in every and slip is not None:
                message = f"`{package}` has no message, service or action `{stem}`" + Suggestion(slip, stem)
                yield Source(shown_path(path), text), at.start(4), stem, message
            continue
        names = {each: {_snake(name): name for name in interfaces[each]} for each in interfaces}
        others = [each for each in names if stem in names[each]]
        slip = next((name for name in sorted(names.get(kind, ())) if _is_near(stem, name)), None)
        if others and kind not in others:
            message = f"`{names[others[0]][stem]}` is {_a(others[0])} of `{package}`" + Suggestion(others[0], kind)
            yield Source(shown_path(path), text), at.start(3), kind, message
        elif not others and slip is not None:
            message = f"`{package}` has no {_KINDS[kind]} with the header `{stem}.hpp`" + Suggestion(slip, stem)
            yield Source(shown_path(path), text), at.start(4), stem, message


def _siblings(path: Path, text: str, files: BuildFiles, near: Collection[str]) -> Defects:
    """Yield the imports in a module of a package that only find a file in its folder if it is started there."""
    package = path.parent.name
    is_module = path.parent == files.folder / package and is_file(path.parent / "__init__.py")
    if files.setup is None or files.cmake is not None or not is_module or "sys.path" in text:
        return
    lines: set[int] | None = None
    for at in re.finditer(_MODULE, text):
        name = at[1] or at[2]
        if name in near or name in sys.stdlib_module_names or not is_file(path.parent / f"{name}.py"):
            continue
        if is_file(files.folder / f"{name}.py") or f"{name}/" in files.setup.text:
            continue
        source = Source(shown_path(path), text)
        lines = lines_of_imports(text) if lines is None else lines
        if source.position(at.start()).line in lines:
            message = f"after installation, `{name}` is found only as a module of `{package}`"
            right = f"from {package} import {name}" if at[2] else f"{package}.{name}"
            yield source, at.start(1 if at[1] else 2), name, message + Suggestion(right, name)


@kept
def _interfaces(folder: Path) -> dict[str, set[str]]:
    """Return kind → the names of the messages, services and actions of a package that Python can import."""
    files = {kind: {path.stem for end in (kind, "idl") for path in (folder / kind).glob(f"*.{end}")} for kind in _KINDS}
    if not any(files.values()):
        return {}
    if re.search(r"<buildtool_depend>\s*catkin\s*<", _text(folder / "package.xml")):
        files["msg"] |= {name + end for name in files["action"] for end in _OF_ACTIONS}
        files["srv"] |= {name + end for name in files["srv"] for end in ("Request", "Response")}
        files["action"] = set()
    return files


def _text(path: Path) -> str:
    try:
        return path.read_text("utf-8", "replace")
    except OSError:
        return ""


def _a(kind: str) -> str:
    return f"an {_KINDS[kind]}" if kind == "action" else f"a {_KINDS[kind]}"


def _is_near(name: str, other: str) -> bool:
    return name != other and (is_slip(name, other) or name.lower() == other.lower())


def _snake(name: str) -> str:
    """Return the name of a header in ROS 2."""
    name = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).lower()


def _blank(comment: re.Match[str]) -> str:
    return " " * len(comment[0])
