"""X101 unprefixed-xacro-directive."""

import re

from urdfkit.lint.finding import Fix
from urdfkit.lint.model.tags import Document
from urdfkit.lint.model.xacro_prefix import is_unprefixed_directive, prefixing
from urdfkit.lint.rule import Findings, Model, SourceRule

_CANDIDATE = re.compile(r"<(?:macro|property|include|if|unless|arg|insert_block)[\s/>]")


class UnprefixedDirective(SourceRule):
    """A xacro directive lacks the ``xacro:`` prefix.

    ## What it does
    Checks for ``<macro>``, ``<property>``, ``<include>``, ``<if>``, ``<unless>``, ``<arg>`` and ``<insert_block>``
    without the prefix.

    ## Why is this bad?
    Since ROS Melodic, xacro treats these elements as plain XML. The body of a macro is evaluated in place ("name 'm' is
    not defined"), an include is not read, and the elements are copied to the robot.

    ## Example
    ```diff
     <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <macro name="wheel" params="side">
    +  <xacro:macro name="wheel" params="side">
         <link name="${side}_wheel"/>
    -  </macro>
    +  </xacro:macro>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe: neither URDF nor the formats embedded in it have such elements in these places. The fix also declares the
    prefix in the root element of the file if necessary.
    """

    code = "X101"
    name = "unprefixed-xacro-directive"
    fix = "safe"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for each directive without the prefix."""
        if not _CANDIDATE.search(document.source.text):
            return
        for tag in document.walk():
            if is_unprefixed_directive(tag):
                message = f"directive `<{tag.name}>` lacks the `xacro:` prefix"
                help = f"write `<xacro:{tag.name}>`"
                fix = Fix("safe", f"Replace with `xacro:{tag.name}`", prefixing(document, tag))
                yield self.at(model, document.source.position(tag.start), message, help=help, fix=fix)
