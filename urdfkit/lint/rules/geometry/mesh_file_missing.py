"""G601 mesh-file-missing."""

from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.existence import is_absolute, is_file
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.model.mesh_files import is_remote, missing
from urdfkit.lint.rule import Findings, Model, RobotRule

_MAX_FOLDERS = 4
"""Number of folders above a xacro file in which the expanded robot may lie."""


class MeshFileMissing(RobotRule):
    """A mesh file does not exist.

    ## What it does
    Resolves the ``filename`` of every mesh (``package://``, ``model://``, ``file://`` and paths) and checks that the
    file exists. The comparison is case-sensitive, and the message suggests the nearest name. Absolute paths of other
    machines, and names with expressions, are reported as notes, because a simulation with urdfkit ignores such meshes.

    ## Why is this bad?
    check_urdf does not check mesh files. Viewers show nothing, and simulators stop. A name in the wrong case works only
    on file systems that ignore case.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
    -    <visual><geometry><mesh filename="meshes/base.stl"/></geometry></visual>
    +    <visual><geometry><mesh filename="meshes/Base.stl"/></geometry></visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest file name in the same folder, which may not be the intended one.
    """

    code = "G601"
    name = "mesh-file-missing"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each missing mesh file."""
        failures: dict[str, tuple[str, str | None] | None] = {}
        for mesh, element, link in model.meshes:
            if model.is_unresolved(element, "filename"):
                continue
            if "$" in mesh.uri or is_remote(mesh.uri):
                fault = "is not a file on this machine" if is_remote(mesh.uri) else "contains an expression"
                message = f"mesh `{mesh.uri.strip()}` {fault}; a simulation with urdfkit ignores it"
                yield self.at(model, element, message, attribute="filename", link=link.name, severity="note")
                continue
            if mesh.uri not in failures:
                failures[mesh.uri] = missing(mesh, model.expanded)
            failure = failures[mesh.uri]
            if failure is None or failure[0] != "file":
                continue
            if is_absolute(mesh.uri) and model.literal(element, "filename") is not None:
                continue  # Reported by G603.
            is_of_output = _is_relative_to_output(mesh.uri.strip(), model.expanded.path)
            near = failure[1]
            uri = f"{mesh.uri.strip().rpartition('/')[0]}/{near}".lstrip("/") if near else ""
            has_same_suffix = (
                near is not None and near.rpartition(".")[2].lower() == mesh.uri.strip().rpartition(".")[2].lower()
            )
            yield self.at(
                model,
                element,
                f"mesh `{mesh.uri.strip()}` not found" + Suggestion(near),
                attribute="filename",
                link=link.name,
                fix=new_value(model, element, "filename", uri, "unsafe") if has_same_suffix else None,
                severity="note" if is_of_output else None,
                cause=(f"format of {uri.rpartition('.')[2]}" if _is_other_format(mesh.uri.strip(), uri) else "")
                if near
                else f"folder of {mesh.uri.strip().rpartition('/')[0]}",
            )


def _is_other_format(uri: str, other: str) -> bool:
    """Return whether two paths differ in the suffix only: all meshes were converted."""
    return uri.rpartition(".")[0].rpartition("/")[2] == other.rpartition(".")[0].rpartition("/")[2]


def _is_relative_to_output(uri: str, path: Path) -> bool:
    """Return whether a relative path in a xacro file names a file above its folder, where xacro writes the robot."""
    if "://" in uri or path.suffix != ".xacro":
        return False
    return any(is_file(folder / uri) for folder in list(path.absolute().parents)[1:_MAX_FOLDERS])
