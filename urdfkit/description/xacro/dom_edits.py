"""Taking elements out of a tree of minidom, and putting others in their place."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any
    from xml.dom import minidom


def replace(node: minidom.Element, by: list[Any]) -> None:
    """Put what is in `by` in the place of `node`, as ``xacro.replace_node`` does with ``content_only``.

    minidom looks through all the siblings for the place of each element that is inserted; here it is done once.

    Args:
        node: the element to replace.
        by: the elements whose content is taken.
    """
    parent: Any = node.parentNode
    moved: list[Any] = []
    for whole in by:
        child = whole.firstChild
        while child is not None:
            moved.append(child)
            child = child.nextSibling
        whole.childNodes.clear()
    siblings = parent.childNodes
    index = siblings.index(node)
    siblings[index : index + 1] = moved
    before, after = node.previousSibling, node.nextSibling
    for child in (*moved, after):
        if before is not None:
            before.nextSibling = child
        if child is not None:
            child.previousSibling, before = before, child
    for child in moved:
        child.parentNode = parent
    node.parentNode = node.previousSibling = node.nextSibling = None


def child_at_fault(error: BaseException, parent: minidom.Element) -> Any:
    """Return the child of `parent` that xacro was at, from the frames of the exception."""
    traceback = error.__traceback__
    while traceback is not None:
        frame = traceback.tb_frame
        if frame.f_code.co_name == "eval_all" and "next" in frame.f_locals:
            node = frame.f_locals.get("node")
            if node is not None and node.parentNode is parent:
                return node
        traceback = traceback.tb_next
    return None


def drop(node: Any, parent: Any) -> bool:
    """Take a child away from its parent; return whether it was one."""
    if node is None or node.parentNode is None or node.parentNode is not parent:
        return False
    parent.removeChild(node)
    return True
