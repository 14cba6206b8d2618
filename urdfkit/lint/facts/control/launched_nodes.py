"""Nodes that launch files start, with their constant arguments; launch files are not executed."""

import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.model.model import Model
from urdfkit.record import record

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
    """

    package: str
    program: str
    arguments: tuple[Named | None, ...]
    is_conditional: bool = False


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
    import ast

    from urdfkit.description.launch.python_constants import launch_reader, name_of, parsed
    from urdfkit.lint.facts.control.launch_package_paths import place
    from urdfkit.lint.facts.nodes.python_bindings import bindings, resolved

    tree = parsed(source) if "Node" in source.text else None
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
        if not isinstance(node, ast.Call) or name_of(node.func) not in ("Node", "LifecycleNode"):
            continue
        keywords = {word.arg: word.value for word in node.keywords}
        names = [reader.text(keywords[key]) if key in keywords else None for key in ("package", "executable")]
        written = keywords.get("arguments")
        for binding in bindings(tree, node):
            arguments: list[Named | None] = []
            for part in written.elts if isinstance(written, (ast.List, ast.Tuple)) else ():
                word = resolved(part, binding) or part
                text = word.value if isinstance(word, ast.Constant) else None
                arguments.append(Named(text, place(source, word)[0] + 1) if isinstance(text, str) else None)
            yield Started(names[0] or "", names[1] or "", tuple(arguments), node in conditional)
