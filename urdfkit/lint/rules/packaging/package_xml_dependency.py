"""K956 package-xml-dependency."""

import re
from collections.abc import Iterable
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.packages.related_files import LAUNCH, dependencies_in, name_in, neighbours, package_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.ros_packages import is_in_metapackage, misspelling_of
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

_OPTIONAL = """
default_warehouse_db.launch gazebo.launch joystick_control.launch run_benchmark_ompl.launch setup_assistant.launch
warehouse.launch warehouse_settings.launch.xml
"""
"""Launch files in the templates of moveit_setup_assistant that need packages which its package.xml leaves out."""

_NOT_AT_RUN_TIME = ("build_depend", "buildtool_depend", "doc_depend", "test_depend")
"""Elements of package.xml whose packages are not installed for users of the package (REP 149)."""

_TESTS = frozenset(("test", "tests"))
"""Folders whose files do not add runtime dependencies."""


_COVERED = {"tf2_ros": "tf2_ros_py", "tf2_py": "tf2_ros"}
"""Package that code imports → another package that installs it."""


_ADD = "add <exec_depend>{}</exec_depend> to package.xml"


class PackageXmlDependency(RobotRule):
    """A package is used without a dependency in package.xml.

    ## What it does
    Compares these packages with the dependencies in package.xml:

    - packages that the files of the robot's package use in ``$(find …)`` and ``package://…``
    - packages that launch files start, include or import, and ``xacro`` if they call it; these are compared with the
      package.xml of the launch file's package
    - packages that the Python code of a package imports, except under a condition, and that its CMakeLists.txt finds
    - packages of the controllers in YAML, if any package of the robot depends on other controller packages
    - packages of the plugins of Nav2 and MoveIt, and of the Gazebo plugin that runs controllers, if the package starts
      Gazebo or depends on other packages of this kind

    A build or test dependency is not sufficient for launch files and imports. A run or test dependency is not
    sufficient for packages that CMakeLists.txt finds. A dependency on a metapackage, such as ``navigation2``, covers
    the packages that the metapackage depends on. A name that misspells a dependency, a package of the workspace or a
    common package by one letter is reported as an error at each place. Every other package is reported once, at the
    line of package.xml after which the dependency belongs, with a list of the places that use the package. A comment
    that suppresses the rule at one of these places suppresses that use.

    Test folders, optional launch files of the MoveIt Setup Assistant, and dependencies that are commented out in
    package.xml are not checked.

    ## Why is this bad?
    The package works only where the dependency happens to be installed: rosdep and the ROS build farm do not install
    it. A misspelt package does not exist on any machine.

    ## Example
    ```diff
     <robot name="cart" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <xacro:property name="meshes" value="$(find simpleton_description)/meshes"/>
    +  <xacro:property name="meshes" value="$(find mybot_description)/meshes"/>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.

    ## References
    In the package of this example, package.xml has ``<exec_depend>mybot_description</exec_depend>``.
    """

    code = "K956"
    name = "package-xml-dependency"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each use of a package without a dependency, with its place in package.xml."""
        from urdfkit.lint.facts.plugin_packages import place_of_dependency, plural_dependency

        for finding in self._uses(model):
            added = re.match(r"add <(\w+)>", finding.help or "")
            name = finding.names[0] if added is not None else ""
            is_own, tag = finding.kind == "own", added[1] if added is not None else ""
            place = place_of_dependency(name, finding.file, model, is_own, tag) if name else None
            plural = plural_dependency(name, finding.file, model) if name else None
            if plural is not None:
                span, written = plural
                message = f"unknown dependency `{written}`" + Suggestion(name, written)
                yield self.at_span(span, message, names=(name,))
            elif place is None:
                yield finding
            else:
                cause = {"other": place, "is_other_wrong": True, "cause": f"package {name}"}
                yield Finding(**{**finding.__dict__, **cause})

    def _uses(self, model: Model) -> Findings:
        """Yield a finding at each use of a package without a dependency; where code does not use it, at the first."""
        package = model.package
        if package is None:
            return
        manifest = model.manifest(package)
        near = neighbours(package)
        own = name_in(manifest, package.name)
        declared = {own, *_dependencies(manifest, near)}
        unknown = {fault.name for fault in model.expanded.faults if fault.kind == "package-not-found"}
        for file, source in model.expanded.sources.items():
            uses = "$(find" in source.text or "package://" in source.text
            path = Path(file).absolute()
            if not uses or package not in path.parents or not _TESTS.isdisjoint(path.relative_to(package).parts):
                continue
            comments = model.document(file).comments
            for match in re.finditer(r"\$\(find(?:-pkg-share)?\s+([\w-]+)\)|package://([\w-]+)/", source.text):
                name = match[1] or match[2]
                if name in declared or any(start <= match.start() < end for start, end, _ in comments):
                    continue
                if is_in_metapackage(name, declared):
                    continue
                if name == package.name:
                    declared.add(name)
                    span = source.span(match.start(), match.end())
                    message = f"`{name}` is the folder of this package; its name in package.xml is `{own}`"
                    yield self.at_span(span, message, names=(name, own))
                    continue
                finding = self._missing(name, source, match.start(), match.end(), {*near, *declared})
                if finding.severity == self.severity or name not in unknown:  # xacro has no other finding for it
                    yield finding
        folders = {package: declared}
        yield from self._check_launch_files(model, folders)
        yield from self._check_code(model)
        yield from self._check_moveit(model, folders)
        yield from self._check_yaml(model)
        yield from self._check_simulated_control(model)

    def _check_launch_files(self, model: Model, declared: dict[Path, set[str]]) -> Findings:
        """Yield a finding for each package that a launch file uses without a dependency in its own package."""
        from urdfkit.lint.facts.control.launch_package_paths import packages_imported, packages_used

        files = {Path(file).absolute(): source.text for file, source in model.related_files.items()}
        manifests = {file: text for file, text in files.items() if file.name == "package.xml"}
        reported = set[tuple[Path, str]]()
        for file, source in model.related_files.items():
            package = package_of(Path(file)) if file.endswith(LAUNCH) else None
            if package is None or not _TESTS.isdisjoint(Path(file).absolute().relative_to(package).parts):
                continue
            if Path(file).name in _OPTIONAL.split() and (package / ".setup_assistant").is_file():
                continue
            if package not in declared:
                manifest = model.manifest(package)
                needed = _dependencies(manifest, neighbours(package))
                declared[package] = {name_in(manifest, package.name), package.name, *needed}
            disabled = next((_disabled(manifests[each]) for each in manifests if each.parent == package), set[str]())
            # A dependency on the package itself, which is reported, stands for the missing one.
            own = model.manifest(package)
            is_own = name_in(own, package.name) in dependencies_in(own)
            near = {*neighbours(package), *declared[package]}
            for name, start, end in () if is_own else (*packages_used(source), *packages_imported(source, near)):
                yield from self._not_at_run_time(name, package, model, reported)
                if name not in declared[package] | disabled and not is_in_metapackage(name, declared[package]):
                    yield self._missing(name, source, start, end, near)

    def _check_code(self, model: Model) -> Findings:
        """Yield a finding for each package that Python code imports or CMake finds without a dependency."""
        from urdfkit.lint.facts.packaging.build_files import build_files
        from urdfkit.lint.facts.packaging.code_packages import packages_found, packages_in_code
        from urdfkit.lint.facts.packaging.dependency_kinds import wrong_kinds

        for files in build_files(model):
            near, manifest = neighbours(files.folder), model.manifest(files.folder)
            needed = {*_dependencies(manifest, near), *_disabled(files.manifest.text)}
            if files.name in needed:  # a dependency on the package itself stands for the missing one
                continue
            model.expanded.packages.watch(files.folder, ".py")
            uses = list(packages_in_code(files.folder, near))
            imported = {name for _, name, *_ in uses}
            uses += ((files.cmake, *each) for each in packages_found(files.cmake, near)) if files.cmake else ()
            for tag, name, message, help in wrong_kinds(files, {name for _, name, *_ in uses} - imported, imported):
                span = files.manifest.span(tag.start, tag.close_end)
                yield self.at_span(span, message, help=help, names=(name,))
            for source, name, start, end in uses:
                of_system = f"lib{name.replace('_', '-')}-dev"  # for example liburdfdom-headers-dev
                is_covered = of_system in needed or (name in _COVERED and _COVERED[name] in needed)
                if name not in {*needed, files.name} and not is_covered and not is_in_metapackage(name, needed):
                    yield self._missing(name, source, start, end, set())

    def _check_yaml(self, model: Model) -> Findings:
        """Yield a finding for each package of a controller or plugin in YAML on which no related package depends."""
        from urdfkit.lint.facts.packages_in_yaml import packages_of_controllers, packages_of_plugins

        needed = _needed(model)
        for use in (*packages_of_controllers(model, needed), *packages_of_plugins(model, needed)):
            kind = "controller type" if use.is_type else ""
            message, help = f"missing dependency on `{use.package}`, {use.use}", _ADD.format(use.package)
            span = use.source.span(use.start, use.end)
            yield self.at_span(span, message, help=help, kind=kind, names=(use.package,))

    def _check_simulated_control(self, model: Model) -> Findings:
        """Yield a finding for the plugin that runs controllers, if the packages depend on that of another Gazebo."""
        from urdfkit.lint.facts.gazebo.plugins import plugins
        from urdfkit.lint.facts.plugin_packages import SIMULATED_CONTROL

        needed = _needed(model)
        others = [name for name in SIMULATED_CONTROL if name in needed]
        for plugin, _, _ in plugins(model.robot):
            used = next((name for name in SIMULATED_CONTROL if name in (plugin.filename or "")), None)
            starters = [name for name in SIMULATED_CONTROL.get(used or "", "").split() if name in needed]
            if used is not None and used not in needed and (others or starters):
                message = f"missing dependency on `{used}`, whose plugin the robot loads"
                message += f"; the packages name `{others[0]}`" if others else ""
                help = _ADD.format(used)
                hardware = [each.text for block in model.robot.ros2_control for each in block.element.walk()]
                is_of_other = any(text.startswith(f"{name}/") for name in others[:1] for text in hardware)
                kind = "foreign" if is_of_other else ""
                help = f"load the plugin of `{others[0]}`, like the hardware of the robot" if is_of_other else help
                yield self.at(model, plugin.element, message, attribute="filename", help=help, names=(used,), kind=kind)
                return

    def _check_moveit(self, model: Model, declared: dict[Path, set[str]]) -> Findings:
        """Yield a finding for each package of plugins or descriptions that a package with MoveIt's files needs."""
        from urdfkit.lint.facts.plugin_packages import moveit_uses

        for source in model.related_files.values():
            folder = package_of(Path(source.file))
            if folder is not None and folder not in declared:
                manifest = model.manifest(folder)
                needed = _dependencies(manifest, neighbours(folder))
                declared[folder] = {name_in(manifest, folder.name), folder.name, *needed}
        needed = _needed(model)
        for use in moveit_uses(model, declared):
            folder = package_of(Path(use.source.file))
            own = declared.get(folder, set()) if folder is not None and use.is_own else needed
            if use.package in own or is_in_metapackage(use.package, own):
                continue
            own.add(use.package)
            span = use.source.span(use.start, use.end)
            message = f"missing dependency on `{use.package}`, {use.use}"
            help = _ADD.format(use.package)
            yield self.at_span(span, message, help=help, names=(use.package,), kind="own" if use.is_own else "")

    def _not_at_run_time(self, name: str, package: Path, model: Model, reported: set[tuple[Path, str]]) -> Findings:
        """Yield a finding for a package that launch files use, but whose dependency is for builds or tests only."""
        manifest = next((source for file, source in model.related_files.items() if _is_of(file, package)), None)
        if manifest is None or (package, name) in reported:
            return
        reported.add((package, name))
        uses = list(re.finditer(rf"<(\w+_depend|depend)\b[^>]*>\s*{re.escape(name)}\s*<", manifest.text))
        if uses and all(use[1] in _NOT_AT_RUN_TIME for use in uses):
            written = "run_depend" if re.search(r"<run_depend\b", manifest.text) else "exec_depend"
            message = f"launch files need `{name}` at run time, but <{uses[0][1]}> does not install it"
            span = manifest.span(uses[0].start(), uses[0].end() - 1)
            help = f"write <{written}>, or <depend> if the build needs the package too"
            yield self.at_span(span, message, help=help, names=(name,))

    def _missing(self, name: str, source: Source, start: int, end: int, near: set[str]) -> Finding:
        from urdfkit.lint.facts.launch.ros_version import reads_version

        span = source.span(start, end)
        version = reads_version(source) if source.file.endswith(LAUNCH) else 0
        if (meant := misspelling_of(name, near, version)) is not None:
            message = f"unknown package `{name}`" + Suggestion(meant, name)
            return self.at_span(span, message, severity="error", cause=f"package {name}", kind="misspelt")
        message = f"missing dependency on `{name}`"
        tag = "depend" if source.file.endswith("CMakeLists.txt") else "exec_depend"
        help = f"add <{tag}>{name}</{tag}> to package.xml"
        return self.at_span(span, message, help=help, kind="own", names=(name,))


def _is_of(file: str, package: Path) -> bool:
    """Return whether a file is the package.xml of a package."""
    return file.endswith("package.xml") and Path(file).absolute().parent == package


def _needed(model: Model) -> set[str]:
    """Return the names and dependencies of the packages around a robot."""
    manifests = [source.text for name, source in model.related_files.items() if name.endswith("package.xml")]
    return {name for text in manifests for name in (*dependencies_in(text), name_in(text))}


def _disabled(manifest: str) -> set[str]:
    """Return the packages that dependencies in comments of a package.xml name."""
    return {name for comment in re.findall(r"(?s)<!--.*?-->", manifest) for name in dependencies_in(comment[4:-3])}


def _dependencies(manifest: str, near: Iterable[str]) -> set[str]:
    """Return the dependencies, and the packages that misspelt dependencies mean; manifest-invalid reports these."""
    found, version = dependencies_in(manifest), 2 if ">ament" in manifest and ">catkin" not in manifest else 0
    return found | {meant for name in found if (meant := misspelling_of(name, near, version)) is not None}
