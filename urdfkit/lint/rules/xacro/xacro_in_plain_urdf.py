"""X123 xacro-in-plain-urdf."""

import re

from urdfkit.description.packages.related_files import LAUNCH
from urdfkit.lint.model.tags import Document, Tag
from urdfkit.lint.model.xacro_prefix import URDF_ELEMENTS
from urdfkit.lint.rule import Findings, Model, SourceRule


class XacroInPlainUrdf(SourceRule):
    """A ``.urdf`` file contains xacro.

    ## What it does
    Checks files with links and the extension ``.urdf`` for elements with the ``xacro:`` prefix and for expressions. If
    the file declares the prefix, an unknown element with attributes in ``<inertial>`` is reported as well, because it
    is probably a macro call without the prefix. A declared but unused prefix is accepted, because xacro itself writes
    it. A file is also accepted if a launch file of these packages runs xacro on it.

    ## Why is this bad?
    The extension indicates plain URDF. RViz, MoveIt and viewers read the file without expanding it, so they find macro
    calls instead of links, and ``${…}`` instead of numbers.

    ## Example
    ```diff
    -<robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
    +<robot name="cart">
       <link name="base"/>
    -  <xacro:property name="width" value="0.3"/>
     </robot>
    ```
    """

    code = "X123"
    name = "xacro-in-plain-urdf"
    severity = "warning"

    def check(self, document: Document, model: Model) -> Findings:
        """Yield a finding for a ``.urdf`` file that needs xacro."""
        text, source = document.source.text, document.source
        if not source.file.endswith(".urdf") or ("xacro" not in text and "${" not in text) or not document.roots:
            return
        root = document.roots[0]
        if not any(child.name == "link" for child in root.children) or _is_run_through_xacro(source.file, model):
            return
        declares_prefix = "xmlns:xacro" in root.attributes
        for tag in document.walk():
            start_tag = text[tag.start : tag.end]
            if (
                tag.name.startswith("xacro:")
                or ("${" in start_tag and re.search(r"\$\{[^{}]*\}", start_tag))
                or (declares_prefix and _is_unprefixed_call(tag))
            ):
                message = f"file requires xacro because of <{tag.name}> on line {source.position(tag.start).line}"
                attribute = "xmlns:xacro" if declares_prefix else None
                help = f"rename the file to {source.file.rpartition('/')[2]}.xacro"
                yield self.at(model, source.position(root.start), message, attribute=attribute, help=help)
                return


def _is_unprefixed_call(tag: Tag) -> bool:
    """Return whether an element of ``<inertial>`` is a macro call without prefix: ``<box_inertia m="1" …/>``."""
    inside = tag.parent is not None and tag.parent.name == "inertial"
    return inside and bool(tag.attributes) and tag.name not in URDF_ELEMENTS and ":" not in tag.name


def _is_run_through_xacro(file: str, model: Model) -> bool:
    """Return whether a launch file of these packages runs xacro and names the file."""
    name = file.rpartition("/")[2]
    launch_files = (other.text for other in model.related_files.values() if other.file.endswith(LAUNCH))
    ending = re.compile(r"[\"']\.urdf[\"']")  # a computed name
    return any("xacro" in text and (name in text or ending.search(text)) for text in launch_files)
