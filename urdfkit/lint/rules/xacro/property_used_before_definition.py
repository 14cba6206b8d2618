"""X105 property-used-before-definition."""

from __future__ import annotations

from pathlib import PurePosixPath

from urdfkit.lint.edits import removal
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class PropertyUsedBeforeDefinition(FaultRule):
    """A property is used before it is defined.

    ## What it does
    Reports names in ``${…}`` that are defined further down, or in a file that is included later.

    ## Why is this bad?
    xacro reads from top to bottom (the only mode since ROS Melodic) and stops at the first use.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="${side}_arm"/>
      <xacro:property name="side" value="left"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="side" value="left"/>
      <link name="${side}_arm"/>
    </robot>
    ```

    ## Fix safety
    Unsafe: where the use is in an included file, the include is moved behind the definition, and with it all that the
    file defines. Within one file the definition is moved above the first use; what it needs itself may come later.
    """

    code = "X105"
    name = "property-used-before-definition"
    fix = "unsafe"
    kinds = ("undefined-property",)

    def claims(self, fault: Fault) -> bool:
        """Return whether the property is defined, but too late."""
        return fault.kind == "undefined-property" and fault.defined_at is not None

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; its help says where the definition is."""
        definition = f" ({model.shown(fault.defined_at)})" if fault.defined_at is not None else ""
        yield self.at(
            model,
            fault,
            f"property `{fault.name}` is used before it is defined",
            attribute=fault.attribute,
            help=f"move the definition{definition} above this use",
            fix=_later_include(fault, model) or _earlier_definition(fault, model),
        )


def _later_include(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that moves the include that the use comes through behind the definition of what it uses."""
    used, first = fault.position.file, fault.defined_at
    if first is None or used == first.file:
        return None
    others = [other for other in model.expanded.faults if other.position.file == used and other.kind == fault.kind]
    defined = max(at for other in others if (at := other.defined_at) is not None and at.file == first.file)
    document = model.document(defined.file)
    definition = model.tag(defined)
    includes = [
        tag
        for tag in document.walk()
        if tag.name == "xacro:include"
        and (written := tag.attributes.get("filename")) is not None
        and PurePosixPath(written.value).name == PurePosixPath(used).name
    ]
    if definition is None or len(includes) != 1:
        return None
    include, source = includes[0], document.source
    if include.parent is not definition.parent or include.start > definition.start:
        return None
    line = source.line_before(definition.start)
    moved = source.text[include.start : include.close_end]
    text = f"{source.line_end}{line}{moved}" if not line.strip() else moved
    there = source.span(definition.close_end, definition.close_end)
    title = f"Include {PurePosixPath(used).name} after what it uses is defined"
    return Fix("unsafe", title, (removal(document, include), Edit(there, text)))


def _earlier_definition(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that moves a definition above its first use in the same file."""
    defined = fault.defined_at
    if defined is None or fault.position.file != defined.file:
        return None
    document, definition = model.document(defined.file), model.tag(defined)
    uses = [other.position for other in model.expanded.faults if other.defined_at == defined]
    if definition is None or any(use.file != defined.file for use in uses):
        return None
    first = model.tag(min(uses))
    while first is not None and first.parent is not definition.parent:
        first = first.parent
    if first is None or first.start >= definition.start:
        return None
    source = document.source
    moved = source.text[definition.start : definition.close_end]
    line = source.line_before(first.start)
    there = source.span(first.start, first.start)
    text = f"{moved}{source.line_end}{line}" if not line.strip() else moved
    return Fix(
        "unsafe", f"Define `{fault.name}` above its first use", (Edit(there, text), removal(document, definition))
    )
