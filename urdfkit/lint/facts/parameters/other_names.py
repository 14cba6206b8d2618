"""Parameters under the names that other releases or nodes give them, one finding for each group."""

from collections.abc import Iterator, Mapping

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.control.yaml_tree import Node


def renamed_in(owner: str, group: Node, names: Mapping[str, str]) -> Iterator[tuple[Node, str]]:
    """Yield the first parameter of a group with a name of another release, and a message that lists the others.

    Args:
        owner: name of the node, plugin or controller that reads the group.
        group: the parameters.
        names: name in another release → name that the owner reads.
    """
    written = {key.text for key, _ in group.entries}
    found = [key for key, _ in group.entries if key.text in names and names[key.text] not in written]
    if len(found) == 1:
        message = f"`{owner}` has no parameter `{found[0].text}`" + Suggestion(names[found[0].text], found[0].text)
        yield found[0], message
    elif found:
        old, new = (
            ", ".join(f"`{each}`" for each in part)
            for part in zip(*((key.text, names[key.text]) for key in found), strict=True)
        )
        yield found[0], f"`{owner}` has no parameters {old}; write {new}"
