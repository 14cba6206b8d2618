"""Which module of a package imports which, read from the source text; what is imported for types alone counts too."""

from __future__ import annotations

import ast
from pathlib import Path

Graph = dict[str, set[str]]


def import_graph(folder: Path) -> Graph:
    """Return module → the modules of the same package that it imports, at any place in its text.

    A package that imports names on first use (it has `__getattr__`) depends on nothing by that: who imports such a name
    from it depends on the module that holds the name.

    Args:
        folder: of the package.
    """
    trees = {_name(path, folder.parent): ast.parse(path.read_text("utf-8")) for path in folder.rglob("*.py")}
    lazy = {module: _imports(tree) for module, tree in trees.items() if _imports_on_first_use(tree)}

    def holder(module: str, name: str) -> str | None:
        if f"{module}.{name}" in trees:
            return f"{module}.{name}"
        for home, original, known_as in lazy.get(module, ()):
            if known_as == name and original is not None:
                return holder(home, original)
        return module if module in trees else None

    graph: Graph = {module: set() for module in trees}
    for module, tree in trees.items():
        if module not in lazy:
            found = (holder(home, name) if name else home for home, name, _ in _imports(tree))
            graph[module] = {other for other in found if other in trees} - {module}
    return graph


def cycles(graph: Graph) -> list[list[str]]:
    """Return the groups of modules each of which imports all others of its group, directly or through others."""
    reachable: dict[str, set[str]] = {}
    for start in graph:
        found: set[str] = set()
        waiting = [*graph[start]]
        while waiting:
            module = waiting.pop()
            if module not in found:
                found.add(module)
                waiting += graph[module]
        reachable[start] = found
    groups = {
        frozenset(other for other in reachable[module] if module in reachable[other])
        for module in graph
        if module in reachable[module]
    }
    return sorted(sorted(group) for group in groups)


def _name(path: Path, root: Path) -> str:
    parts = path.relative_to(root).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def _imports(tree: ast.Module) -> list[tuple[str, str | None, str | None]]:
    """Return module, name in it and name here of each import; no names where a module is imported whole."""
    found: list[tuple[str, str | None, str | None]] = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            found += [(alias.name, None, None) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, "imports are absolute"
            found += [(str(node.module), alias.name, alias.asname or alias.name) for alias in node.names]
    return found


def _imports_on_first_use(tree: ast.Module) -> bool:
    return any(isinstance(node, ast.FunctionDef) and node.name == "__getattr__" for node in tree.body)
