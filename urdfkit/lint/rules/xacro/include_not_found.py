"""X113 include-not-found."""

from pathlib import Path

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import FaultRule, Findings, Model


class IncludeNotFound(FaultRule):
    """An included file or its package does not exist.

    ## What it does
    Checks for ``<xacro:include>`` with a file that does not exist, and for ``$(find …)`` with a package that is neither
    in the workspace nor in the environment. The rest of the description is still checked.

    ## Why is this bad?
    xacro aborts with an error. Everything that the file defines is undefined.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:include filename="wheels_that_are_nowhere.xacro"/>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
    </robot>
    ```

    ## Fix safety
    Unsafe: the fix includes the file with the most similar name in the same folder. No fix is offered for a missing
    package.
    """

    code = "X113"
    name = "include-not-found"
    fix = "unsafe"
    kinds = ("include-not-found", "package-not-found")

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding, with a fix if a file with a similar name exists."""
        yield self.at(model, fault, fault.message, attribute=fault.attribute, fix=_nearest_file(fault, model))


def _nearest_file(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that includes the nearest file of the folder, if the file name is literal text."""
    path = Path(str(fault.details.get("path", "")))
    tag = model.tag(fault.position)
    attribute = tag.attributes.get("filename") if tag is not None else None
    if not path.name or not path.parent.is_dir() or attribute is None or not attribute.value.endswith(path.name):
        return None
    try:
        files = sorted(file.name for file in path.parent.iterdir() if file.is_file() and file.suffix == path.suffix)
    except OSError:
        return None
    suggestion = nearest(path.name, files, cutoff=0.75)
    if suggestion is None or fault.position.file.endswith(suggestion):
        return None
    start = attribute.value_end - len(path.name)
    span = model.document(fault.position.file).source.span(start, attribute.value_end)
    return Fix("unsafe", f"Include {suggestion}", (Edit(span, suggestion),))
