"""K957 not-installed."""

import re
from pathlib import Path

from urdfkit.description.packages.existence import is_folder
from urdfkit.description.packages.related_files import name_in
from urdfkit.description.xml.source import Span
from urdfkit.lint.rule import Findings, Model, RobotRule


class NotInstalled(RobotRule):
    """The package does not install a folder that the description uses.

    ## What it does
    Checks ``package://…`` and ``$(find …)`` references for existing folders of the robot's own package that neither
    CMakeLists.txt nor setup.py mentions. The finding is at the first ``install(DIRECTORY …)`` of the package, if one
    exists. For a catkin package, the finding is a note, because the devel space also contains files that are not
    installed.

    ## Why is this bad?
    After installation, the share folder of the package lacks these meshes or included files.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
    -    <visual><geometry><mesh filename="package://cart_description/shapes/block.stl"/></geometry></visual>
    +    <visual><geometry><mesh filename="package://cart_description/meshes/block.stl"/></geometry></visual>
       </link>
     </robot>
    ```

    ## References
    In the package of this example, CMakeLists.txt has ``install(DIRECTORY urdf meshes DESTINATION
    share/${PROJECT_NAME})``.
    """

    code = "K957"
    name = "not-installed"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the first use of each folder that is not installed."""
        package = model.package
        package_name = name_in(model.manifest(package)) if package is not None else ""
        if package is None or not package_name:
            return
        name = re.escape(package_name)
        uses = re.compile(rf"(?:package://{name}|\$\(find(?:-pkg-share)?\s+{name}\))/([\w-]+)(?=[/\"'\s])")
        install_rules: str | None = None
        checked: set[str] = set()
        for file, source in model.expanded.sources.items():
            if package not in Path(file).absolute().parents:
                continue
            for match in uses.finditer(source.text):
                folder = match[1]
                if folder in checked or not is_folder(package / folder):
                    continue
                checked.add(folder)
                install_rules = _install_rules(package) if install_rules is None else install_rules
                word = rf"(?<![\w-]){re.escape(folder)}(?![\w-])"
                if not install_rules or re.search(rf"{word}|DIRECTORY\s+(?:\.|\$)|GLOB|foreach", install_rules):
                    continue
                place = _install_command(package, model)
                yield self.at_span(
                    source.span(match.start(), match.end()),
                    f"folder `{folder}` of this package is not installed",
                    severity="warning" if "ament" in install_rules else "note",
                    help="add it to install(DIRECTORY …) in CMakeLists.txt, or to data_files in setup.py",
                    other=place,
                    is_other_wrong=place is not None,
                    cause=f"folder {folder}",
                )


def _install_command(package: Path, model: Model) -> Span | None:
    """Return the word DIRECTORY of the first install() of folders in CMakeLists.txt; None without one."""
    from urdfkit.lint.facts.packaging.build_files import build_files
    from urdfkit.lint.facts.packaging.cmake_commands import commands

    cmake = next((files.cmake for files in build_files(model) if files.folder == package), None)
    for command in commands(cmake) if cmake is not None else ():
        word, start = command.words[0] if command.words else ("", 0)
        if cmake is not None and command.name == "install" and word == "DIRECTORY":
            return cmake.span(start, start + len(word))
    return None


def _install_rules(package: Path) -> str:
    """Return the text of CMakeLists.txt and setup.py without comments; empty if neither exists."""
    files = [file for name in ("CMakeLists.txt", "setup.py") if (file := package / name).is_file()]
    texts = [file.read_text("utf-8", "replace") for file in files]
    return "\n".join(re.sub(r"#.*", "", text) for text in texts)
