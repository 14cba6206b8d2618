"""Package paths in launch files, read without executing the files; computed paths are ignored."""

import ast
import re
from collections.abc import Collection, Iterator

from urdfkit.description.launch.python_constants import JOINS, SHARE, LaunchReader, launch_reader, name_of, parsed
from urdfkit.description.xml.source import Source
from urdfkit.record import record

_FIND = r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)/([^\s\"'<>$(){}:;,|&*]+)(?=[\s\"'<:;])"
_LET = r"<let\s+name=[\"']([\w.-]+)[\"']\s+value=[\"']\$\(find-pkg-share\s+([\w-]+)\)(/[\w./-]*)?[\"']"
_LET_USE = r"\$\(var\s+([\w.-]+)\)/([^\s\"'<>$(){}:;,|&*]+)(?=[\s\"'<:;])"
"""Matches a folder of a package in a ``<let>``, and a path in such a folder."""

_USES = (
    r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)"
    r"|<(?:node|composable_node|node_container)\b[^<>]*?\bpkg\s*=\s*[\"']([\w-]+)[\"']"
)
_YAML_NODE = r"^[ \t]*(?:-[ \t]+)?pkg:[ \t]*[\"']?([\w-]+)[\"']?[ \t]*(?:#.*)?$"
_XACRO = r"\bcommand\s*=\s*[\"'](xacro)\s|\$\(command\s+[\"'](xacro)\s"
_XACRO_WORD = r"[\"']xacro(?:\.py)?[\"'\s]"
"""Calls of xacro by its name alone."""

_STARTS = frozenset(("Node", "LifecycleNode", "ComposableNode", "ComposableNodeContainer"))
_OF_ROS2LAUNCH = frozenset(
    (
        *(
            "ament_index_python",
            "launch",
            "launch_ros",
            "launch_xml",
            "launch_yaml",
            "lifecycle_msgs",
            "rcl_interfaces",
        ),
        *("launch_testing", "launch_testing_ros"),
    )
)
"""Packages that the command ``ros2 launch`` needs (package.xml of ros2launch and launch_ros), and those of tests."""

_EXISTENCE_TESTS = frozenset(("exists", "isfile", "isdir", "is_file", "is_dir"))


@record
class PackagePath:
    """A path in a package, as named in a launch file.

    Attributes:
        package: name of the package.
        path: path relative to the share folder of the package.
        start: start offset in the launch file.
        end: end offset in the launch file.
    """

    package: str
    path: str
    start: int
    end: int


def package_paths(source: Source) -> Iterator[PackagePath]:
    """Yield the constant package paths in a launch file."""
    if source.file.endswith(".py"):
        tree = parsed(source) if any(word in source.text for word in SHARE) else None
        yield from paths_in_python(source, tree, launch_reader(tree)) if tree is not None else ()
        return
    text = uncommented(source)
    for at in re.finditer(_FIND, text):
        yield PackagePath(at[1], at[2], at.start(), at.end())
    values = {name: (package, path.strip("/")) for name, package, path in re.findall(_LET, text)}
    for at in re.finditer(_LET_USE, text) if values else ():
        if at[1] in values:
            package, folder = values[at[1]]
            yield PackagePath(package, f"{folder}/{at[2]}".lstrip("/"), at.start(), at.end())


def packages_used(source: Source) -> Iterator[tuple[str, int, int]]:
    """Yield name, start and end offset of each package in a launch file whose files or executables are constants."""
    if not source.file.endswith(".py"):
        for at in re.finditer(_XACRO, uncommented(source)):
            group = 1 if at[1] is not None else 2
            yield "xacro", at.start(group), at.end(group)
        for at in re.finditer(_USES, uncommented(source)):
            group = 1 if at[1] is not None else 2
            yield at[group], at.start(group), at.end(group)
        is_yaml = not source.file.endswith((".launch", ".xml"))
        for at in re.finditer(_YAML_NODE, source.text, re.MULTILINE) if is_yaml else ():
            yield at[1], at.start(1), at.end(1)
        return
    if (tree := parsed(source)) is None:
        return
    from urdfkit.lint.facts.nodes.python_bindings import bindings, resolved

    reader = launch_reader(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = reader.share(node)
        if name_of(node.func) == "Command" and re.search(_XACRO_WORD, ast.get_source_segment(source.text, node) or ""):
            yield "xacro", *place(source, node)
        if name is None and name_of(node.func) in _STARTS:
            package = next((word.value for word in node.keywords if word.arg == "package"), None)
            for binding in bindings(tree, node):
                part = resolved(package, binding)
                name = reader.text(part) if part is not None else None
                if name is not None and part is not None:
                    start, end = place(source, node)
                    inner = place(source, part)  # at a call of a function or in a list, or in the node itself
                    yield name, *((start, end) if part is package and start <= inner[0] < end else inner)
        elif name is not None:
            yield name, *place(source, node)


def packages_imported(source: Source, others: Collection[str]) -> Iterator[tuple[str, int, int]]:
    """Yield name, start and end offset of each package that a Python launch file imports without a condition.

    Args:
        source: the launch file.
        others: further packages, such as those of the workspace.
    """
    if not source.file.endswith(".py") or (tree := parsed(source)) is None:
        return
    from urdfkit.lint.facts.ros_packages import names

    optional = {each for node in ast.walk(tree) if isinstance(node, (ast.Try, ast.If)) for each in ast.walk(node)}
    for node in ast.walk(tree):
        modules = [word.name for word in node.names] if isinstance(node, ast.Import) else []
        modules += [node.module] if isinstance(node, ast.ImportFrom) and node.module and not node.level else []
        for name in (module.partition(".")[0] for module in modules):
            is_package = name in others or (name in names() and ("_" in name or name in ("rclpy", "xacro")))
            if is_package and name not in _OF_ROS2LAUNCH and node not in optional:
                assert isinstance(node, (ast.Import, ast.ImportFrom))
                start, end = place(source, node)
                start = source.text.find(name, start, end)
                yield name, start, start + len(name)


def uncommented(source: Source) -> str:
    """Return the text of a launch or YAML file with each comment replaced by spaces of the same length."""
    pattern = r"#[^\n]*" if source.file.endswith((".yaml", ".yml")) else r"(?s)<!--.*?(?:-->|\Z)"
    return re.sub(pattern, lambda at: re.sub(r"[^\n]", " ", at[0]), source.text)


def place(source: Source, node: ast.expr | ast.stmt | ast.alias) -> tuple[int, int]:
    """Return start and end offset of a node; the columns of `ast` are UTF-8 bytes."""

    def offset(line: int, column: int) -> int:
        before = source.line(line).encode("utf-8", "surrogatepass")[:column].decode("utf-8", "ignore")
        return source.offset(line, len(before) + 1)

    end_line, end_column = node.end_lineno or node.lineno, node.end_col_offset or node.col_offset
    return offset(node.lineno, node.col_offset), offset(end_line, end_column)


def at_call(node: ast.expr) -> ast.Constant | None:
    """Return the last constant of an expression that is outside of its lines, at a call of the function around it."""
    first, last = node.lineno, node.end_lineno or node.lineno
    inner = [each for each in ast.walk(node) if isinstance(each, ast.Constant)]
    outside = [each for each in inner if not first <= each.lineno <= last]
    return max(outside, key=lambda each: (each.lineno, each.col_offset), default=None)


def paths_in_python(source: Source, tree: ast.Module, reader: LaunchReader) -> Iterator[PackagePath]:
    """Yield the package paths in a Python launch file that a reader can evaluate."""
    nodes = list(ast.walk(tree))
    inner: set[ast.AST] = set()  # parts of a longer path, and paths that are only tested for existence
    for node in nodes:
        if isinstance(node, ast.BinOp) or (
            isinstance(node, ast.Call) and name_of(node.func) in (*JOINS, *_EXISTENCE_TESTS)
        ):
            inner.update(child for child in ast.walk(node) if child is not node)
        elif isinstance(node, ast.Attribute) and node.attr in _EXISTENCE_TESTS:
            inner.update(ast.walk(node))
    for node in nodes:
        is_join = isinstance(node, ast.Call) and name_of(node.func) in JOINS
        if node in inner or not (is_join or isinstance(node, (ast.BinOp, ast.List, ast.JoinedStr))):
            continue
        if isinstance(node, ast.List) and len(node.elts) == 1 and isinstance(node.elts[0], (ast.Call, ast.BinOp)):
            continue
        assert isinstance(node, ast.expr)
        found = reader.path(node)
        if found is not None and found[1].strip("/"):
            constants = [
                each for each in ast.walk(node) if isinstance(each, ast.Constant) and each.lineno > node.lineno
            ]
            last = max(constants, key=lambda each: (each.lineno, each.col_offset), default=node)
            yield PackagePath(found[0], found[1].strip("/"), *place(source, at_call(node) or last))
