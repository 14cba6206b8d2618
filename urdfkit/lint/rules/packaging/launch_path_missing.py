"""K958 launch-path-missing."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model import Model


class LaunchPathMissing(RobotRule):
    """A launch file names a file that is not there.

    ## What it does
    Looks in the launch files of the robot's package, and of packages beside it that depend on it, for ``$(find …)``,
    ``get_package_share_directory`` and ``FindPackageShare`` of these packages with a path behind. Launch files in
    Python are read, not run: paths that are computed, or only asked whether they are there, are left alone. So are
    files that CMakeLists.txt or setup.py speaks of, and those that lie elsewhere in the package.

    ## Why is this bad?
    The launch stops there, or comes up without the robot, the world or the settings that are meant.

    ## Example
    ```xml
    <launch>
      <param name="robot_description" command="xacro $(find cart_description)/urdf/carts.urdf"/>
    </launch>
    ```

    ## Use instead
    ```xml
    <launch>
      <param name="robot_description" command="xacro $(find cart_description)/urdf/cart.urdf"/>
    </launch>
    ```
    """

    code = "K958"
    name = "launch-path-missing"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each path in one of the packages around that is not there."""
        from urdfkit.description.packages import near_path
        from urdfkit.description.surroundings import LAUNCH, neighbours
        from urdfkit.lint.launch import package_paths

        if model.package is None:
            return
        near: dict[str, Path] | None = None
        for source in model.around.values():
            if not source.file.endswith(LAUNCH) or ("find" not in source.text and "hare" not in source.text):
                continue
            near = neighbours(model.package) if near is None else near
            for named in package_paths(source):
                package = near.get(named.package)
                if package is None or _is_there(package, named.path, model):
                    continue
                yield Finding(
                    self.code,
                    self.name,
                    self.severity,
                    f"`{named.path}` is not in the package {named.package}{near_path(package / named.path)}",
                    source.span(named.start, named.end),
                )


def _is_there(package: Path, path: str, model: Model) -> bool:
    """Whether the file is in the package, may be installed from elsewhere in it, or is made when it is built."""
    ask = model.expanded.packages.whereabouts
    if ask(package / path):
        return True
    if any(file.is_file() for pattern in (f"*/{path}", f"*/*/{path}", f"{path}.*") for file in package.glob(pattern)):
        return True
    build = [file for name in ("CMakeLists.txt", "setup.py") if (file := package / name).is_file()]
    stem = rf"(?<![\w-]){re.escape(Path(path).name.partition('.')[0])}(?![\w-])"
    texts = [re.sub(_OWN_NAME, "", file.read_text("utf-8", "replace")) for file in build]
    return any(re.search(stem, text) for text in texts)


_OWN_NAME = r"(?m)^\s*(?:project\s*\([^)]*\)|(?:package_)?name\s*=.*)"
"""Where the build files say what the package is called: its robot is often called so, too."""
