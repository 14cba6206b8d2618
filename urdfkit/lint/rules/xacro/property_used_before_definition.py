"""X105 property-used-before-definition."""

from pathlib import PurePosixPath

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.fix_builders import removal
from urdfkit.lint.rule import FaultRule, Findings, Model


class PropertyUsedBeforeDefinition(FaultRule):
    """A property is used before it is defined.

    ## What it does
    Checks for names in ``${…}`` that are defined later in the file, or in a file that is included later.

    ## Why is this bad?
    xacro evaluates properties from top to bottom (the only mode since ROS Melodic) and aborts at the first use.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    +  <xacro:property name="side" value="left"/>
       <link name="${side}_arm"/>
    -  <xacro:property name="side" value="left"/>
     </robot>
    ```

    ## Fix safety
    Unsafe: if the use is in an included file, the fix moves the include, with everything that the file defines, after
    the definition. Within one file, the fix moves the definition before its first use. The definition may use
    properties that are defined only after its new position.
    """

    code = "X105"
    name = "property-used-before-definition"
    fix = "unsafe"
    kinds = ("undefined-property",)

    def claims(self, fault: Fault) -> bool:
        """Return whether the property is defined after its use."""
        return fault.kind == "undefined-property" and fault.defined_at is not None

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding, with the position of the definition in its help."""
        definition = f" ({model.shown(fault.defined_at)})" if fault.defined_at is not None else ""
        message = f"property `{fault.name}` is used before it is defined"
        help = f"move the definition{definition} before this use"
        fix = _move_include(fault, model) or _move_definition(fault, model)
        yield self.at(model, fault, message, attribute=fault.attribute, help=help, fix=fix)


def _move_include(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that moves the include of the file with the use after the definition."""
    using_file, first = fault.position.file, fault.defined_at
    if first is None or using_file == first.file:
        return None
    others = [
        other for other in model.expanded.faults if other.position.file == using_file and other.kind == fault.kind
    ]
    definition_position = max(
        position for other in others if (position := other.defined_at) is not None and position.file == first.file
    )
    document = model.document(definition_position.file)
    definition = model.tag(definition_position)
    includes = [
        tag
        for tag in document.walk()
        if tag.name == "xacro:include"
        and (attribute := tag.attributes.get("filename")) is not None
        and PurePosixPath(attribute.value).name == PurePosixPath(using_file).name
    ]
    if definition is None or len(includes) != 1:
        return None
    include, source = includes[0], document.source
    if include.parent is not definition.parent or include.start > definition.start:
        return None
    line = source.line_before(definition.start)
    moved = source.text[include.start : include.close_end]
    text = f"{source.line_end}{line}{moved}" if not line.strip() else moved
    target = source.span(definition.close_end, definition.close_end)
    title = f"Include {PurePosixPath(using_file).name} after the definition"
    return Fix("unsafe", title, (removal(document, include), Edit(target, text)))


def _move_definition(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that moves a definition before its first use in the same file."""
    definition_position = fault.defined_at
    if definition_position is None or fault.position.file != definition_position.file:
        return None
    document, definition = model.document(definition_position.file), model.tag(definition_position)
    uses = [other.position for other in model.expanded.faults if other.defined_at == definition_position]
    if definition is None or any(use.file != definition_position.file for use in uses):
        return None
    first = model.tag(min(uses))
    while first is not None and first.parent is not definition.parent:
        first = first.parent
    if first is None or first.start >= definition.start:
        return None
    source = document.source
    moved = source.text[definition.start : definition.close_end]
    line = source.line_before(first.start)
    target = source.span(first.start, first.start)
    text = f"{moved}{source.line_end}{line}" if not line.strip() else moved
    return Fix(
        "unsafe", f"Define `{fault.name}` before its first use", (Edit(target, text), removal(document, definition))
    )
