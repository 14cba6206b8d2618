"""K956 package-xml-dependency."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.description.surroundings import LAUNCH, dependencies_in, name_in, package_of
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.source import Source
    from urdfkit.lint.model import Model

_TESTS = frozenset(("test", "tests"))
"""Folders whose files need nothing to be installed."""


class PackageXmlDependency(RobotRule):
    """A package is used that package.xml does not name.

    ## What it does
    Looks in the files of the robot's package for ``$(find …)`` and ``package://…`` of other packages, and in its launch
    files, and those of the packages beside it that depend on it, for the packages of what they start and include; and
    compares with the dependencies in package.xml. Each package is reported once; folders of tests are left out.

    ## Why is this bad?
    It works on machines that happen to have the package. rosdep and the build farm do not install it.

    ## Example
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="meshes" value="$(find simpleton_description)/meshes"/>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="meshes" value="$(find mybot_description)/meshes"/>
      <link name="base"/>
    </robot>
    ```

    ## References
    The package.xml beside the example has ``<exec_depend>mybot_description</exec_depend>``.
    """

    code = "K956"
    name = "package-xml-dependency"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each package that is used and not named, at its first use."""
        package = model.package
        if package is None:
            return
        manifest = model.manifest(package)
        named = {name_in(manifest), *dependencies_in(manifest)}
        for file, source in model.expanded.sources.items():
            uses = "$(find" in source.text or "package://" in source.text
            path = Path(file).absolute()
            if not uses or package not in path.parents or not _TESTS.isdisjoint(path.relative_to(package).parts):
                continue
            comments = model.document(file).comments
            for at in re.finditer(r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)|package://([\w-]+)/", source.text):
                name = at[1] or at[2]
                if name in named or any(start <= at.start() < end for start, end, _ in comments):
                    continue
                named.add(name)
                yield self._missing(name, source, at.start(), at.end())
        yield from self._check_launch_files(model, {package: named})

    def _check_launch_files(self, model: Model, named: dict[Path, set[str]]) -> Iterator[Finding]:
        """Yield a finding for each package that a launch file needs and that its own package does not name."""
        from urdfkit.lint.launch import packages_used

        for file, source in model.around.items():
            package = package_of(Path(file)) if file.endswith(LAUNCH) else None
            if package is None or not _TESTS.isdisjoint(Path(file).absolute().relative_to(package).parts):
                continue
            if package not in named:
                written = model.manifest(package)
                named[package] = {name_in(written, package.name), *dependencies_in(written)}
            for name, start, end in packages_used(source):
                if name not in named[package]:
                    named[package].add(name)
                    yield self._missing(name, source, start, end)

    def _missing(self, name: str, source: Source, start: int, end: int) -> Finding:
        return Finding(
            self.code,
            self.name,
            self.severity,
            f"package.xml names no dependency on `{name}`",
            source.span(start, end),
            help=f"add <exec_depend>{name}</exec_depend>",
        )
