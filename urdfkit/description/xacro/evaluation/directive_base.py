"""Elements: what every directive does with its element: attributes, comments before it, namespaces."""

from __future__ import annotations

from urdfkit.description.xacro.evaluation.expressions.limits import MAX_EXPANDED
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import Failure, SourceElement, short
from urdfkit.description.xacro.evaluation.files import Files
from urdfkit.description.xacro.evaluation.tree import COMMENT, NOTHING, TEXT, Copy, Node, Tag, expressions_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any


class Elements(Files):
    """Reads the attributes of directives and tidies up around them."""

    _expanded = 0
    _separator: Node

    def count(self, copied: int) -> None:
        """Count elements and attributes that are copied.

        Raises:
            Failure: there are too many by now.
        """
        self._expanded += copied
        if self._expanded > MAX_EXPANDED:
            what = f"more than {MAX_EXPANDED:,} elements and attributes"
            message = f"macros, blocks and includes create {what}; check for nested calls"
            raise self.placed(Failure("too-many", message))

    def _attributes(self, tag: Tag, scope: Scope) -> None:
        attributes = tag.attributes
        for name, value in list(attributes.items()):
            if name.startswith("xacro:"):
                del attributes[name]
            elif type(value) is not str or "$" in value:
                self.at = (tag, name)
                attributes[name] = str(self.text(value, scope))
        attributes.pop("xmlns:xacro", None)

    def _values(self, tag: Tag, scope: Scope) -> None:
        """Evaluate an element without directives."""
        if tag.work == NOTHING:
            return
        if type(tag) is Copy and tag.source is not None:
            values = []
            for index, (position, name, text) in enumerate(expressions_of(tag.source)):
                self.at = (SourceElement(position, tag.chain), name)
                values.append(str(self.text(text if tag.values is None else tag.values[index], scope)))
            tag.values = values
            return
        for name, value in tag.attributes.items():
            if "$" in value:
                self.at = (tag, name)
                tag.attributes[name] = str(self.text(value, scope))
        for node in tag.children():
            if isinstance(node, Tag):
                self._values(node, scope)
            elif node.kind == TEXT and "$" in node.data:
                self.at = (tag, None)
                node.data = str(self.text(node.data, scope))

    def _required(self, node: Tag, name: str) -> Any:
        value = node.attributes.get(name)
        if value is None:
            self.at = (node, None)
            raise self.placed(Failure("other", f"<{node.name}> has no attribute `{name}`", name=name))
        return value

    def _checked(self, node: Tag, required: tuple[str, ...], optional: tuple[str, ...]) -> list[Any]:
        values = [self._required(node, name) for name in required]
        values += [node.attributes.get(name) for name in optional]
        unknown = [
            name for name in node.attributes if name not in (*required, *optional) and not name.startswith("xmlns:")
        ]
        if unknown:
            self.warn(f"{node.name}: unknown attribute(s): {', '.join(unknown)}")
        return values

    def _boolean(self, value: Any, condition: Any) -> bool:
        if isinstance(value, str):
            if value in ("true", "True", "false", "False"):
                return value in ("true", "True")
            try:
                return bool(int(value))
            except ValueError:
                message = f"condition `{short(str(condition))}` is `{short(value)}`, neither true nor false"
                raise self.placed(Failure("conditional", message)) from None
        return bool(value)

    def _remove_comments_before(self, node: Tag) -> None:
        """Remove the comments that belong to a directive, and part it from the comments of the next one."""
        following, before = node.after, node.before
        while before is not None:
            if before.kind == TEXT and before.data.isspace() and before.data.count("\n") <= 1:
                before = before.before
            if before is not None and before.kind == COMMENT:
                comment, before = before, before.before
                comment.remove()
            else:
                if following is not None and following is not self._separator:
                    self._separator.insert_before(following)
                return

    def _import_namespaces(self, parent: Tag | None, source: Tag) -> None:
        if parent is None:
            return
        for name, value in source.attributes.items():
            if name.startswith("xmlns:"):
                old = parent.attributes.get(name)
                if old is not None and old != value:
                    self.warn(
                        f"inconsistent namespace redefinitions for {name}:\n old: {old}\n new: {value} "
                        f"({self.file_stack[-1]})"
                    )
                else:
                    parent.attributes[name] = value
