"""X113 include-not-found."""

from pathlib import Path

from urdfkit.description.packages.existence import is_folder
from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.finding import Edit, Fix, Severity
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.rule import FaultRule, Findings, Model


class IncludeNotFound(FaultRule):
    """An included file or its package does not exist.

    ## What it does
    Checks for ``<xacro:include>`` with a file that does not exist, and for ``$(find …)`` with a package that is neither
    in the workspace nor in the environment. The rest of the description is still checked. A package that package.xml
    declares as a dependency is reported as a warning, because it may be missing only on this machine. If a file does
    not exist because of the default of an argument, the finding is a note, because the caller must pass another value.

    ## Why is this bad?
    xacro aborts with an error, because the macros and properties of the file are missing.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <xacro:include filename="wheels_that_are_nowhere.xacro"/>
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
        from urdfkit.lint.facts.required_inputs import argument_in_path, is_declared_dependency

        severity: Severity | None = None
        help, message = None, fault.message
        if fault.kind == "package-not-found" and is_declared_dependency(model, fault.name or ""):
            severity, message = "warning", f"package `{fault.name}` is not installed on this machine"
            help = "install it, because package.xml depends on it, or pass its folder with --package-path"
        elif fault.kind == "include-not-found" and (name := argument_in_path(model, fault.details.get("path", ""))):
            severity, help = "note", f"pass {name}:=value: its default selects no existing file"
        fix = _nearest_file(fault, model)
        cause = "package" if fault.kind == "package-not-found" else ""
        yield self.at(
            model, fault, message, attribute=fault.attribute, help=help, fix=fix, severity=severity, cause=cause
        )


def _nearest_file(fault: Fault, model: Model) -> Fix | None:
    """Return the fix that includes the nearest file of the folder, if the file name is literal text."""
    path = Path(str(fault.details.get("path", "")))
    tag = model.tag(fault.position)
    attribute = tag.attributes.get("filename") if tag is not None else None
    if not path.name or not is_folder(path.parent) or attribute is None or not attribute.value.endswith(path.name):
        return None
    try:
        files = sorted(file.name for file in path.parent.iterdir() if file.is_file() and file.suffix == path.suffix)
        files = [name for name in files if not f"/{fault.position.file}".endswith(f"/{name}")]
    except OSError:
        return None
    suggestion = nearest(path.name, files, cutoff=0.75)
    if suggestion is None:
        return None
    start = attribute.value_end - len(path.name)
    span = model.document(fault.position.file).source.span(start, attribute.value_end)
    return Fix("unsafe", f"Include {suggestion}", (Edit(span, suggestion),))
