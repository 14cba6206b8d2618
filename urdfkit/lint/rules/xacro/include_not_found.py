"""X113 include-not-found."""

from __future__ import annotations

from pathlib import Path

from urdfkit.lint.edits import nearest
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class IncludeNotFound(FaultRule):
    """An included file, or the package it is in, is not there.

    ## What it does
    Reports ``<xacro:include>`` whose file does not exist and ``$(find …)`` whose package is found neither in the
    workspace nor in the environment. The rest is linted without it.

    ## Why is this bad?
    xacro stops. What the file would have defined is missing from then on.

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
    Unsafe: the file with the nearest name in that folder is included. A package is left to you.
    """

    code = "X113"
    name = "include-not-found"
    fix = "unsafe"
    kinds = ("include-not-found", "package-not-found")

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; the file may be there under nearly that name."""
        yield self.at(model, fault, fault.message, attribute=fault.attribute, fix=_nearest_file(fault, model))


def _nearest_file(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that names the nearest file of the folder, where the end of the path is written out."""
    path = Path(str(fault.details.get("path", "")))
    tag = model.tag(fault.position)
    written = tag.attributes.get("filename") if tag is not None else None
    if not path.name or not path.parent.is_dir() or written is None or not written.value.endswith(path.name):
        return None
    files = sorted(file.name for file in path.parent.iterdir() if file.is_file() and file.suffix == path.suffix)
    near = nearest(path.name, files, likeness=0.75)
    if near is None or fault.position.file.endswith(near):
        return None
    start = written.value_end - len(path.name)
    span = model.document(fault.position.file).source.span(start, written.value_end)
    return Fix("unsafe", f"Include {near}", (Edit(span, near),))
