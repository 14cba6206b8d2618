"""Evaluator: expands one xacro file into elements that carry their place and the macro calls that produced them.

The tree is expanded in place, directive by directive, in the order of stock xacro. Each step is a generator that
yields the steps below it. `Evaluator.run` keeps them on a stack of its own, so that depth is limited by numbers of
ours and not by Python.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import MappingProxyType

from urdfkit.description.xacro.evaluation.directives import Directives
from urdfkit.description.xacro.evaluation.element_conversion import element_of
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_PROPERTY_DEPTH
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import Failure, error_of
from urdfkit.description.xacro.evaluation.tree import COMMENT, MORE, TEXT, Node, Tag
from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xacro.memory import Memory, Root
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    Steps = Iterator["Steps"]
    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xml.element import Element


class Evaluator(Directives):
    """One expansion of one file.

    Args:
        path: as the user named it; appears in the banner of the output.
        arguments: values of ``$(arg …)``.
        packages: resolves ``$(find …)``.
        texts: contents to read instead of those on disk, by absolute path.
        memory: what earlier expansions of the file read.

    Attributes:
        top_scope: the properties of the file.
        top_macros: its macros.
    """

    def __init__(
        self,
        path: str,
        arguments: Mapping[str, str],
        packages: Packages,
        *,
        texts: Mapping[str, str] | None = None,
        memory: Memory | None = None,
    ) -> None:
        super().__init__(path, arguments, packages, texts=texts)
        self._memory = memory
        self._separator = Node(TEXT, "\n\n")
        self.macros, self._stack = {}, []
        self.properties = {}
        self.open_blocks = []
        self.top_scope, self.top_macros = Scope(self.globals, self), Scope({})
        self._directives: dict[str, Callable[[Tag, Scope, Scope], Steps | None]] = {
            "xacro:insert_block": self._insert_block,
            "xacro:include": self._include,
            "xacro:property": self._property,
            "xacro:macro": self._macro,
            "xacro:arg": self._argument,
            "xacro:attribute": self._attribute,
            "xacro:if": self._condition,
            "xacro:unless": self._condition,
        }

    def expand(self) -> Expanded:
        """Expand the file.

        Raises:
            ResourceError: the file cannot be read.
            XmlError: it, or a file it includes, is not well-formed.
            XacroError: it cannot be expanded; the position is that of the element.
        """
        try:
            document, root = self._expand_all()
        except Failure as failure:
            raise error_of(self.placed(failure), self.sources.values()) from None
        return self._outcome(document, element_of(root))

    def _expand_all(self) -> tuple[Tag, Tag]:
        """Expand the tree of the file; return what holds it, and its root."""
        document = self.open(Path(self.path))
        root = next(document.tags())
        self._set_target_namespace(root)
        with deep_calls():
            self.run(self._element(root, self.top_macros, self.top_scope))
        return document, root

    def _outcome(self, document: Tag, root: Element | None, **facts: Any) -> Expanded:
        return Expanded(
            path=Path(self.path),
            root=root,
            files=tuple(self.files),
            sources=self.sources,
            packages=self.packages,
            macros=MappingProxyType(self.macros),
            properties=MappingProxyType(self.properties),
            warnings=tuple(self.warnings),
            _print=lambda: self.printed(document),
            **facts,
        )

    def run(self, steps: Steps) -> None:
        """Take all steps; an exception goes through the generators that are open, innermost first."""
        stack = [steps]
        error: Exception | None = None
        while stack:
            try:
                if error is None:
                    below = next(stack[-1])
                else:
                    thrown, error = error, None
                    below = stack[-1].throw(thrown)  # type: ignore[attr-defined]
                stack.append(below)
            except StopIteration:
                stack.pop()
            except Exception as raised:
                stack.pop()
                error = raised
        if error is not None:
            raise error

    def _set_target_namespace(self, root: Tag) -> None:
        namespace = root.attributes.get("xacro:targetNamespace")
        if namespace:
            del root.attributes["xacro:targetNamespace"]
            root.attributes["xmlns"] = namespace

    # Elements

    def _element(self, tag: Tag, macros: Scope, scope: Scope) -> Steps:
        """Evaluate the attributes of an element and all below it."""
        if tag.work < MORE:
            self._values(tag, scope)
            return iter(())
        self._attributes(tag, scope)
        return self._remembered(tag, macros, scope) if type(tag) is Root else self._below(tag, macros, scope)

    def _below(self, tag: Tag, macros: Scope, scope: Scope) -> Steps:
        node = tag.first
        evaluates_comments = False
        while node is not None:
            following = node.after
            if isinstance(node, Tag):
                evaluates_comments = False
                if node.work < MORE:
                    self._values(node, scope)
                    node = following
                    continue
                try:
                    yield from self._child(node, macros, scope)
                except (Failure, XmlError) as failure:
                    if not self._recovers(failure, node):
                        raise
            elif node.kind == TEXT:
                if "$" in node.data:
                    self.at = (tag, None)
                    node.data = str(self.text(node.data, scope))
                if evaluates_comments and node.data.strip():
                    evaluates_comments = False
            elif node.kind == COMMENT:
                if "xacro:eval-comments" in node.data:
                    evaluates_comments = "xacro:eval-comments:off" not in node.data
                    node.remove()
                elif evaluates_comments:
                    self.at = (tag, None)
                    node.data = str(self.text(node.data, scope))
            node = following

    def _child(self, node: Tag, macros: Scope, scope: Scope) -> Steps:
        while node.tag == "xacro:element":
            self.at = (node, "xacro:name")
            name = self.text(self._required(node, "xacro:name"), scope)
            if not name or not isinstance(name, str):
                self.at = (node, None)
                raise self.placed(
                    Failure("other", "xacro:element: empty name" if not name else "the name is not a string")
                )
            del node.attributes["xacro:name"]
            node.tag = node.name = name
        self.at = (node, None)
        directive = self._directives.get(node.tag)
        if directive is not None:
            steps = directive(node, macros, scope)
            if steps is not None:
                yield steps
        elif node.tag.startswith("xacro:"):
            yield self._call(node, macros, scope)
        elif node.first is None:
            self._attributes(node, scope)
        else:
            yield self._element(node, macros, scope)

    def _recovers(self, failure: Failure | XmlError, node: Tag) -> bool:
        """Return whether to continue after an element that cannot be expanded."""
        return False


class deep_calls:  # noqa: N801 - used like a function; `contextlib` takes 0.5 ms to load
    """Let properties use each other as deep as `MAX_PROPERTY_DEPTH` allows; each takes about ten calls of Python."""

    def __enter__(self) -> None:
        self._limit = sys.getrecursionlimit()
        sys.setrecursionlimit(max(self._limit, 20 * MAX_PROPERTY_DEPTH))

    def __exit__(self, *_: object) -> None:
        sys.setrecursionlimit(self._limit)
