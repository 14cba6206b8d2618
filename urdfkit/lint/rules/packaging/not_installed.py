"""K957 not-installed."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.description.surroundings import name_in
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.model import Model


class NotInstalled(RobotRule):
    """A folder that the description names is not installed.

    ## What it does
    Looks for the folders of the robot's own package in ``package://…`` and ``$(find …)`` that are there, and that
    neither CMakeLists.txt nor setup.py mentions. With catkin it is a note: what is not installed is still found in
    a development space.

    ## Why is this bad?
    After the build the package's share folder lacks it: the meshes, or the included files, are not there.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base">
        <visual><geometry><mesh filename="package://cart_description/shapes/block.stl"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base">
        <visual><geometry><mesh filename="package://cart_description/meshes/block.stl"/></geometry></visual>
      </link>
    </robot>
    ```

    ## References
    The CMakeLists.txt beside the example has ``install(DIRECTORY urdf meshes DESTINATION share/${PROJECT_NAME})``.
    """

    code = "K957"
    name = "not-installed"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each folder that is named and not installed, where it is named first."""
        package = model.package
        own = name_in(model.manifest(package)) if package is not None else ""
        if package is None or not own:
            return
        name = re.escape(own)
        uses = re.compile(rf"(?:package://{name}|\$\(find(?:-pkg-share)?\s+{name}\))/([\w-]+)/")
        rules: str | None = None
        known: set[str] = set()
        for file, source in model.expanded.sources.items():
            if package not in Path(file).absolute().parents:
                continue
            for at in uses.finditer(source.text):
                folder = at[1]
                if folder in known or not (package / folder).is_dir():
                    continue
                known.add(folder)
                rules = _install_rules(package) if rules is None else rules
                word = rf"(?<![\w-]){re.escape(folder)}(?![\w-])"
                if not rules or re.search(rf"{word}|DIRECTORY\s+(?:\.|\$)|GLOB|foreach", rules):
                    continue
                yield Finding(
                    self.code,
                    self.name,
                    "warning" if "ament" in rules else "info",
                    f"the folder `{folder}` of this package is not installed",
                    source.span(at.start(), at.end()),
                    help="add it to install(DIRECTORY …) in CMakeLists.txt, or to data_files in setup.py",
                )


def _install_rules(package: Path) -> str:
    """Return what CMakeLists.txt and setup.py say, comments left out; empty where there is neither."""
    files = [file for name in ("CMakeLists.txt", "setup.py") if (file := package / name).is_file()]
    texts = [file.read_text("utf-8", "replace") for file in files]
    return "\n".join(re.sub(r"#.*", "", text) for text in texts)
