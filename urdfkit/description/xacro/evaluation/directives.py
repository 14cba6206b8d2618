"""Directives: the effects of the elements of xacro, except macros and their calls."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xacro.evaluation.expressions.limits import MAX_MACRO_DEPTH
from urdfkit.description.xacro.evaluation.expressions.symbols import Namespace, Scope
from urdfkit.description.xacro.evaluation.failures import Failure, cycle, recursive_block, short, undefined_block
from urdfkit.description.xacro.evaluation.reuse import Reuse
from urdfkit.description.xacro.evaluation.tree import Tag

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xml.source import Position

    Steps = Iterator["Steps"]


class Directives(Reuse):
    """Evaluates properties, arguments, blocks, conditions, includes and computed attributes.

    Attributes:
        properties: where each property was defined (the last definition).
        open_blocks: the blocks that are being inserted, outermost first.
    """

    properties: dict[str, Position]
    open_blocks: list[str]

    def _insert_block(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        (name,) = self._checked(node, ("name",), ())
        if f"**{name}" in scope:
            block, content_only = scope[f"**{name}"], True
        elif f"*{name}" in scope:
            block, content_only = scope[f"*{name}"], False
        else:
            candidates = dict.fromkeys(key.lstrip("*") for key in scope.names() if key.startswith("*"))
            raise self.placed(undefined_block(str(name), candidates))
        if len(self.open_blocks) >= MAX_MACRO_DEPTH:
            raise self.placed(recursive_block(cycle(self.open_blocks)))
        block = block.copy(None, self.count)
        self.open_blocks.append(str(name))
        try:
            yield self._element(block, macros, scope)
        finally:
            self.open_blocks.pop()
        if content_only:
            node.replace([block])
        else:
            block.insert_before(node)
            node.remove()

    def _include(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        specification, space, optional = self._checked(node, ("filename",), ("ns", "optional"))
        inner_macros, inner_scope = macros, scope
        if space:
            self.at = (node, "ns")
            space = self.text(space, scope)
            if isinstance(space, (dict, list, set, tuple)):
                raise self.placed(Failure("other", f"the namespace `{short(str(space))}` is not text"))
            inner_macros, inner_scope = Namespace({}), Namespace(scope)
            macros.set(space, inner_macros, is_lazy=False)
            scope.set(space, inner_scope, is_lazy=False)
        self.at = (node, None)
        is_optional = self._boolean(optional, optional)
        if next(node.tags(), None) is not None:
            self.warn("Child elements of a <xacro:include> tag are ignored")
        included: list[Tag] = []
        for file in self.included_files(node, specification, scope):
            depth = len(self.file_stack)
            try:
                self.at = (node, None)
                root = self.open_included(file)
                yield self._element(root, inner_macros, inner_scope)
                self.at = (node, None)
                self._import_namespaces(node.parent, root)
                included.append(root)
            except Failure as failure:
                if not (is_optional is True and failure.is_missing_file):
                    raise
            finally:
                del self.file_stack[depth:]
        self._remove_comments_before(node)
        node.replace(included)

    def _property(self, node: Tag, macros: Scope, scope: Scope) -> None:
        self._remove_comments_before(node)
        optional = ("value", "default", "remove", "scope", "lazy_eval")
        name, value, default, remove, reach, lazy = self._checked(node, ("name",), optional)
        self.at = (node, "name")
        name = self.text(name, scope)
        self.at = (node, None)
        if not is_identifier(name):
            raise self.placed(Failure("other", f"Property names must be valid python identifiers: {short(str(name))}"))
        if name.startswith("__"):
            raise self.placed(Failure("other", f"Property names must not start with double underscore:{name}"))
        self.properties[name] = node.position
        self.at = (node, "remove")
        removes = self._boolean(self.text(remove or "false", scope), remove)
        self.at = (node, None)
        if (value is not None) + (default is not None) + removes > 1:
            message = f"Property attributes default, value, and remove are mutually exclusive: {name}"
            raise self.placed(Failure("other", message))
        if removes and name in scope:
            scope.remove(name)
            if name in scope:
                self.warn(f"Cannot remove global symbol: {name}")
            node.remove()
            return
        if default is not None:
            if reach is not None:
                self.warn(f"{name}: default property value can only be defined on local scope")
            if name in scope:
                node.remove()
                return
            value = default
        stored: Any = value
        if value is None:
            name, stored = f"**{name}", node
        node.remove()
        self.at = (node, "lazy_eval")
        is_lazy = self._boolean(self.text(lazy or "true", scope), lazy)
        target: Any = scope
        if reach == "global":
            self.untraced += 1
            target, is_lazy = scope.top(), False
        elif reach == "parent":
            target, is_lazy = scope.outer, False
            if not isinstance(scope, Namespace):
                while isinstance(target, Namespace):
                    target = target.parent
        self.at = (node, "default" if default is not None else "value")
        if not is_lazy and isinstance(stored, str):
            stored = self.text(stored, scope)
        if not isinstance(target, Scope):
            self.at = (node, None)
            raise self.placed(Failure("other", f"{name}: no parent scope at global scope"))
        target.set(name, stored, is_lazy=is_lazy)

    def _argument(self, node: Tag, macros: Scope, scope: Scope) -> None:
        self.untraced += 1
        name, default = self._checked(node, ("name", "default"), ())
        if name not in self.commands.arguments:
            self.at = (node, "default")
            value = self.text(default, scope)
            self.commands.arguments[name] = value if isinstance(value, str) else str(value)
        self._remove_comments_before(node)
        node.remove()

    def _attribute(self, node: Tag, macros: Scope, scope: Scope) -> None:
        self._required(node, "name")
        self._required(node, "value")
        self.at = (node, "name")
        name = self.text(node.attributes["name"], scope)
        self.at = (node, "value")
        value = self.text(node.attributes["value"], scope)
        self.at = (node, None)
        if not name or not isinstance(name, str):
            raise self.placed(
                Failure("other", "xacro:attribute: empty name" if not name else "the name is not a string")
            )
        if node.parent is not None:
            node.parent.attributes[name] = value
        node.remove()

    def _condition(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        self._remove_comments_before(node)
        (condition,) = self._checked(node, ("value",), ())
        self.at = (node, "value")
        keep = self._boolean(self.text(condition, scope), condition)
        if keep == (node.tag == "xacro:if"):
            yield self._element(node, macros, scope)
            node.replace([node])
        else:
            node.remove()


def is_identifier(name: Any) -> bool:
    """Whether a property can have a name."""
    import keyword

    if not isinstance(name, str) or not name.isidentifier() or keyword.iskeyword(name):
        return False
    if name.isascii():
        return True
    import unicodedata

    return unicodedata.normalize("NFKC", name) == name
