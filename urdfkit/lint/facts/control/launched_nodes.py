"""Nodes that launch files start, with their constant arguments; launch files are not executed.

``ros2 control load_controller`` counts as a spawner.
"""

import ast
import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.model.model import Model
from urdfkit.record import record

Binding = dict[str, ast.expr]

_NODE = r"<node\b[^<>]*>"
_CONDITION = r"\s(?:if|unless)\s*="
_GROUP = rf"<group\b[^<>]*{_CONDITION}"
_ARGUMENTS = r"\bargs\s*=\s*(?:\"([^\"]*)\"|'([^']*)')"


@record(eq=False)
class Started:
    """A node that a launch file starts.

    Attributes:
        package: package of the executable; empty if it is computed.
        program: name of the executable; empty if it is computed.
        arguments: command line arguments in order, with their offsets; None for each computed argument.
        is_conditional: whether it starts under a condition only, or may do so.
        computed: arguments that a loop over constants composes, and the offset of each of their characters.
    """

    package: str
    program: str
    arguments: tuple[Named | None, ...]
    is_conditional: bool = False
    computed: tuple[tuple[str, tuple[int, ...]], ...] = ()


def launches(model: Model) -> Iterator[Source]:
    """Yield the launch files of the model's package and of related packages."""
    yield from (source for name, source in model.related_files.items() if name.endswith(LAUNCH))


@lru_cache(maxsize=400)
def started(source: Source) -> tuple[Started, ...]:
    """Return the nodes that a launch file starts."""
    return tuple(_started(source))


def _started(source: Source) -> Iterator[Started]:
    from urdfkit.lint.facts.control.launch_package_paths import uncommented

    if source.file.endswith(".py"):
        yield from _in_python(source)
        return
    if source.file.endswith((".yaml", ".yml")):
        yield from _in_yaml(source)
        return
    text = uncommented(source)
    in_groups = re.search(_GROUP, text) is not None
    for tag in re.finditer(_NODE, text):
        program = re.search(r"\b(?:type|exec)\s*=\s*[\"']([^\"'$]*)[\"']", tag[0])
        package = re.search(r"\bpkg\s*=\s*[\"']([^\"'$]*)[\"']", tag[0])
        written = re.search(_ARGUMENTS, tag[0])
        group = 1 if written is not None and written[1] is not None else 2
        start = tag.start() + (written.start(group) if written is not None else 0)
        arguments = _words(written[group], start) if written is not None else ()
        is_conditional = in_groups or re.search(_CONDITION, tag[0]) is not None
        yield Started(package[1] if package else "", program[1] if program else "", arguments, is_conditional)


def _words(text: str, start: int) -> tuple[Named | None, ...]:
    return tuple(
        Named(word[0], start + word.start()) if "$" not in word[0] else None for word in re.finditer(r"\S+", text)
    )


def _in_yaml(source: Source) -> Iterator[Started]:
    from urdfkit.lint.facts.control.yaml_tree import documents, walk

    for root in documents(source) if "node" in source.text else ():
        for group in walk(root):
            node = group.find("node")
            if node is None or node.kind != "group":
                continue
            names = [found.text if (found := node.find(key)) is not None else "" for key in ("pkg", "exec")]
            arguments = node.find("args")
            written: tuple[Named | None, ...] = ()
            if arguments is not None and arguments.kind == "text":
                start = source.offset(arguments.line, arguments.column)
                start += not arguments.is_plain
                if source.text.startswith(arguments.text, start):  # neither folded nor escaped
                    written = _words(arguments.text, start)
            package, program = ("" if "$" in name else name for name in names)
            yield Started(package, program, written, "if:" in source.text or "unless:" in source.text)


def _in_python(source: Source) -> Iterator[Started]:
    from urdfkit.description.launch.python_constants import launch_reader, name_of, parsed
    from urdfkit.lint.facts.control.launch_package_paths import place
    from urdfkit.lint.facts.nodes.python_bindings import bindings, resolved

    tree = parsed(source) if re.search(r"Node|load_controller", source.text) else None
    if tree is None:
        return
    reader = launch_reader(tree)
    conditional: set[ast.AST] = set()
    for node in ast.walk(tree):
        is_conditional = isinstance(node, (ast.If, ast.IfExp, ast.For, ast.Try, ast.While)) or (
            isinstance(node, ast.Call)
            and (name_of(node.func) == "GroupAction" or any(word.arg == "condition" for word in node.keywords))
        )
        conditional.update(ast.walk(node) if is_conditional else ())
        if not isinstance(node, ast.Call) or name_of(node.func) not in ("Node", "LifecycleNode", "ExecuteProcess"):
            continue
        keywords = {word.arg: word.value for word in node.keywords}
        if name_of(node.func) == "ExecuteProcess":
            last = next(iter(reader.items(keywords.get("cmd"))[-1:]), None)
            texts = [reader.text(each) for each in reader.items(keywords.get("cmd"))]
            if "load_controller" in texts[:-1] and isinstance(last, ast.Constant) and texts[-1]:
                word = Named(texts[-1], place(source, last)[0] + 1)
                yield Started("controller_manager", "spawner", (word,), node in conditional)
            continue
        names = [reader.text(keywords[key]) if key in keywords else None for key in ("package", "executable")]
        written = keywords.get("arguments")
        for binding in bindings(tree, node):
            arguments: list[Named | None] = []
            computed: list[tuple[str, tuple[int, ...]]] = []
            for part, inner in _items(tree, written):
                value = resolved(part, inner | binding) or part
                text = value.value if isinstance(value, ast.Constant) else None
                arguments.append(Named(text, place(source, value)[0] + 1) if isinstance(text, str) else None)
                computed += _composed(source, value, inner | binding) if isinstance(value, ast.JoinedStr) else ()
            yield Started(names[0] or "", names[1] or "", tuple(arguments), node in conditional, tuple(computed))


def _items(tree: ast.Module, node: ast.expr | None) -> Iterator[tuple[ast.expr, Binding]]:
    """Yield the items of a list, also of later calls of `append` and `extend`, with the values of their names."""
    from urdfkit.description.launch.python_constants import launch_reader
    from urdfkit.lint.facts.nodes.python_bindings import bindings

    reader = launch_reader(tree)
    if isinstance(node, ast.ListComp):
        yield from ((node.elt, binding) for binding in bindings(tree, node.elt))
    yield from ((item, {}) for item in reader.items(node))
    name = node.id if isinstance(node, ast.Name) and node.id in reader.assigned else ""
    for call in ast.walk(tree) if name else ():
        target = call.func if isinstance(call, ast.Call) and len(call.args) == 1 else None
        is_own = isinstance(target, ast.Attribute) and isinstance(target.value, ast.Name) and target.value.id == name
        if isinstance(call, ast.Call) and isinstance(target, ast.Attribute) and is_own:
            added = {"append": call.args, "extend": reader.items(call.args[0])}.get(target.attr, [])
            yield from ((item, binding) for binding in bindings(tree, call) for item in added)


def _composed(source: Source, node: ast.JoinedStr, binding: Binding) -> Iterator[tuple[str, tuple[int, ...]]]:
    """Yield the text of an f-string whose parts are constants, and the offset of each character."""
    from urdfkit.lint.facts.control.launch_package_paths import place
    from urdfkit.lint.facts.nodes.python_bindings import resolved

    text, offsets = "", list[int]()
    for part in node.values:
        value = resolved(part.value, binding) if isinstance(part, ast.FormattedValue) else part
        if not isinstance(value, ast.Constant) or not isinstance(value.value, str):
            return
        text += value.value
        start = place(source, value if value is not part else node)[0] + 1
        offsets += range(start, start + len(value.value)) if value is not part else [start] * len(value.value)
    yield text, tuple(offsets)
