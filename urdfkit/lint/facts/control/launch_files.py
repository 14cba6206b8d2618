"""Package paths in launch files, read without executing the files; computed paths are ignored."""

from __future__ import annotations

import re

from urdfkit.record import record

TYPE_CHECKING = False
if TYPE_CHECKING:
    import ast
    from collections.abc import Iterator

    from urdfkit.description.xml.source import Source

_FIND = r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)/([^\s\"'<>$(){}:;,|&*]+)(?=[\s\"'<:;])"
_USES = r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)|<(?:node|composable_node)\b[^<>]*?\bpkg\s*=\s*[\"']([\w-]+)[\"']"
_STARTS = frozenset(("Node", "LifecycleNode", "ComposableNode", "ComposableNodeContainer"))
_EXISTENCE_TESTS = frozenset(("exists", "isfile", "isdir", "is_file", "is_dir"))
_SHARE = frozenset(("get_package_share_directory", "get_package_share_path", "FindPackageShare"))
_JOINS = frozenset(("join", "PathJoinSubstitution"))


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
        yield from _in_python(source)
        return
    text = uncommented(source)
    for at in re.finditer(_FIND, text):
        yield PackagePath(at[1], at[2], at.start(), at.end())


def packages_used(source: Source) -> Iterator[tuple[str, int, int]]:
    """Yield name, start and end offset of each package in a launch file whose files or executables are constants."""
    if not source.file.endswith(".py"):
        for at in re.finditer(_USES, uncommented(source)):
            group = 1 if at[1] is not None else 2
            yield at[group], at.start(group), at.end(group)
        return
    if (tree := parsed(source)) is None:
        return
    import ast

    reader = LaunchReader(tree)
    for node in ast.walk(tree):
        if not isinstance(node, ast.Call):
            continue
        name = reader.share(node)
        if name is None and name_of(node.func) in _STARTS:
            package = next((word.value for word in node.keywords if word.arg == "package"), None)
            name = reader.text(package) if package is not None else None
        if name is not None:
            yield name, *place(source, node)


def uncommented(source: Source) -> str:
    """Return the text of a launch or YAML file with each comment replaced by spaces of the same length."""
    pattern = r"#[^\n]*" if source.file.endswith((".yaml", ".yml")) else r"(?s)<!--.*?(?:-->|\Z)"
    return re.sub(pattern, lambda at: re.sub(r"[^\n]", " ", at[0]), source.text)


def parsed(source: Source) -> ast.Module | None:
    """Return the syntax tree of a Python launch file; None if it cannot be parsed."""
    import ast
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return ast.parse(source.text)
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            return None


def place(source: Source, node: ast.expr) -> tuple[int, int]:
    """Return start and end offset of a node; the columns of `ast` are UTF-8 bytes."""

    def offset(line: int, column: int) -> int:
        before = source.line(line).encode("utf-8", "surrogatepass")[:column].decode("utf-8", "ignore")
        return source.offset(line, len(before) + 1)

    end_line, end_column = node.end_lineno or node.lineno, node.end_col_offset or node.col_offset
    return offset(node.lineno, node.col_offset), offset(end_line, end_column)


def _in_python(source: Source) -> Iterator[PackagePath]:
    if not any(word in source.text for word in _SHARE) or (tree := parsed(source)) is None:
        return
    import ast

    reader = LaunchReader(tree)
    nodes = list(ast.walk(tree))
    inner: set[ast.AST] = set()  # parts of a longer path, and paths that are only tested for existence
    for node in nodes:
        if isinstance(node, ast.BinOp) or (
            isinstance(node, ast.Call) and name_of(node.func) in (*_JOINS, *_EXISTENCE_TESTS)
        ):
            inner.update(child for child in ast.walk(node) if child is not node)
        elif isinstance(node, ast.Attribute) and node.attr in _EXISTENCE_TESTS:
            inner.update(ast.walk(node))
    for node in nodes:
        is_join = isinstance(node, ast.Call) and name_of(node.func) in _JOINS
        if node in inner or not (is_join or isinstance(node, ast.BinOp)):
            continue
        assert isinstance(node, ast.expr)
        found = reader.path(node)
        if found is not None and found[1].strip("/"):
            yield PackagePath(found[0], found[1].strip("/"), *place(source, node))


class LaunchReader:
    """Evaluate constants, and names that are assigned exactly once.

    Args:
        tree: syntax tree of the launch file.
    """

    def __init__(self, tree: ast.Module) -> None:
        import ast

        assigned: dict[str, list[ast.expr | None]] = {}
        for node in ast.walk(tree):
            if isinstance(node, ast.Assign) and len(node.targets) == 1 and isinstance(node.targets[0], ast.Name):
                assigned.setdefault(node.targets[0].id, []).append(node.value)
        stored = [n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)]
        arguments = {node.arg for node in ast.walk(tree) if isinstance(node, ast.arg)}
        self._assigned = {
            name: values[0]
            for name, values in assigned.items()
            if len(values) == 1 and stored.count(name) == 1 and name not in arguments
        }

    def text(self, node: ast.expr, depth: int = 0) -> str | None:
        """Return the text of a constant expression; None for other expressions."""
        import ast

        if isinstance(node, ast.Constant):
            return node.value if isinstance(node.value, str) else None
        if isinstance(node, ast.Name) and depth < 8 and (value := self._assigned.get(node.id)) is not None:
            return self.text(value, depth + 1)
        return None

    def share(self, node: ast.expr) -> str | None:
        """Return the package whose share folder a call returns; None for other calls."""
        import ast

        if isinstance(node, ast.Call) and name_of(node.func) in _SHARE:
            words = [*node.args, *(word.value for word in node.keywords)]
            return self.text(words[0]) if len(words) == 1 else None
        return None

    def path(self, node: ast.expr, depth: int = 0) -> tuple[str, str] | None:
        """Return package and path that an expression evaluates to; None if it is computed or not a package path."""
        import ast

        if depth > 20:
            return None
        if isinstance(node, ast.Name) and (value := self._assigned.get(node.id)) is not None:
            return self.path(value, depth + 1)
        if (package := self.share(node)) is not None:
            return package, ""
        if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Div)):
            head, tail = self.path(node.left, depth + 1), self.text(node.right)
            if head is None or tail is None or (isinstance(node.op, ast.Add) and not tail.startswith("/")):
                return None
            return head[0], f"{head[1]}/{tail.strip('/')}"
        if isinstance(node, ast.Call) and name_of(node.func) in (*_JOINS, "Path", "str"):
            parts = node.args
            if len(parts) == 1 and isinstance(parts[0], (ast.List, ast.Tuple)):
                parts = parts[0].elts
            if not parts or node.keywords:
                return None
            head, tails = self.path(parts[0], depth + 1), [self.text(part) for part in parts[1:]]
            if head is None or None in tails:
                return None
            return head[0], "/".join((head[1], *(tail.strip("/") for tail in tails if tail is not None)))
        return None


def name_of(node: ast.expr) -> str:
    """Return the last part of a dotted name; empty for other expressions."""
    return str(getattr(node, "attr", getattr(node, "id", "")))
