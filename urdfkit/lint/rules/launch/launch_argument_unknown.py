"""L102 launch-argument-unknown."""

import re
from collections.abc import Iterable
from pathlib import Path

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.launch.receivers import (
    COMPLETE,
    EVERYWHERE,
    OUTSIDE,
    actions_at,
    included_files,
    misspelt_file,
    receiver,
)
from urdfkit.lint.facts.launch.records import Call, LaunchActions
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchArgumentUnknown(RobotRule):
    """A launch file passes an argument that the included launch file or the xacro file does not declare.

    ## What it does
    Compares the arguments of includes with the arguments that launch files in these packages and common launch files of
    Gazebo declare. Compares the arguments of xacro commands with the ``<xacro:arg>`` elements of the description. Also
    reports required arguments that are not passed and, in ROS 1, an unused argument of the including file that the
    included file also declares.

    ## Why is this bad?
    roslaunch fails with "unused args". ROS 2 and xacro ignore the argument, and the default applies.

    ## Example
    ```diff
     <launch>
    -  <param name="robot_description" command="xacro $(find cart_description)/urdf/cart.urdf.xacro lenght:=2"/>
    +  <param name="robot_description" command="xacro $(find cart_description)/urdf/cart.urdf.xacro length:=2"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.

    ## References
    In the package of this example, cart.urdf.xacro has ``<xacro:arg name="length" default="1"/>``.
    """

    code = "L102"
    name = "launch-argument-unknown"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unknown or missing argument."""
        from urdfkit.lint.facts.launch.actions import launch_files

        for file in launch_files(model):
            for call in file.includes:
                path = receiver(call, model)
                actions = actions_at(path, model) if path is not None else None
                folder, _, name = call.path.rpartition("/")
                outside = OUTSIDE.get((call.package, name))
                if actions is not None:
                    yield from self._include(file, call, actions, model)
                elif path is None and (near := misspelt_file(call)) is not None:
                    message = f"package `{call.package}` has no launch file `{call.path}`" + Suggestion(near, call.path)
                    written = call.path.rpartition("/")[2]
                    start = max(file.source.text.find(written, call.start), call.start)
                    yield self._at(file, Named(written, start), message, "error")
                elif outside is not None and folder != "launch":
                    start = max(file.source.text.find(call.path, call.start), call.start)
                    message = f"package `{call.package}` has no launch file `{call.path}`" + Suggestion(
                        f"launch/{name}", call.path
                    )
                    yield self._at(file, Named(call.path, start), message, "error")
                elif outside is not None:
                    yield from self._outside(file, call, outside.split(), name)
            yield from self._not_passed_on(file, model) if file.is_ros1 else ()
            for call in file.xacro:
                yield from self._xacro(file, call, model)

    def _not_passed_on(self, file: LaunchActions, model: Model) -> Findings:
        """Yield the includes without an unused argument of their ROS 1 file; in ROS 2, the files share arguments."""
        from urdfkit.lint.facts.launch.actions import is_used

        unused = [name for name, each in file.declared.items() if not (each.is_fixed or is_used(name, file))]
        for call in file.includes if unused and not any(call.passes_all for call in file.includes) else ():
            path = receiver(call, model)
            actions = actions_at(path, model) if path is not None else None
            target = call.path.rpartition("/")[2]
            if actions is not None:
                names = {name for name, each in actions.declared.items() if not (each.is_fixed or each.is_required)}
            else:
                names = {*OUTSIDE.get((call.package, target), "").split()} if path is None else set()
            passed = {name.name for name in call.passed}
            lost = [name for name in unused if name in names - passed]
            if lost and passed <= {*names, *(actions.declared if actions is not None else ())}:
                message = f"the include does not pass the argument `{lost[0]}` on to {target}, which uses its default"
                yield self.at_span(file.source.span(call.start, call.end), message)
                unused = [name for name in unused if name not in lost]

    def _outside(self, file: LaunchActions, call: Call, names: list[str], target: str) -> Findings:
        is_strict = file.is_ros1 and target == "empty_world.launch"
        is_complete = is_strict or (call.package, target) in COMPLETE
        accepted = names if is_strict else [*names, *EVERYWHERE]
        yield from self._unknown(
            file, call.passed, accepted, target, not is_complete, "error" if is_strict else self.severity
        )
        for name in (each for each in call.passed if call.package == "ros_gz_sim" and each.name.startswith("ign_")):
            meant = f"gz_{name.name.removeprefix('ign_')}"  # gz_sim.launch.py.in of ros_gz declares both
            message = f"argument `{name.name}` of {target} is deprecated; write `{meant}`"
            if meant in names and name.name in names:
                yield self._at(file, name, message, "note")
        if "gz_args" in names and not call.passes_all and not re.search(r"(?:gz|ign)_args", file.source.text):
            for name in (each for each in call.passed if "world" in each.name):
                message = f"{target} has no argument `{name.name}`; write the world in `gz_args`"
                yield self._at(file, name, message, self.severity)

    def _include(self, file: LaunchActions, call: Call, actions: LaunchActions, model: Model) -> Findings:
        names, target = set(actions.declared), call.path.rpartition("/")[2]
        only_misspelt = actions.is_computed or (not actions.declared and not file.is_ros1)
        if not actions.is_ros1:
            for other in included_files(actions, model):
                if other is None:
                    only_misspelt = True
                else:
                    names |= {*other.declared, *other.assigned, *(use.name for use, _ in other.used)}
                    for each in other.includes:
                        names |= {*OUTSIDE.get((each.package, each.path.rpartition("/")[2]), "").split()}
        severity: Severity = "error" if file.is_ros1 else self.severity
        yield from self._unknown(file, call.passed, names, target, only_misspelt, severity)
        passed = {name.name for name in call.passed}
        for name in call.passed:
            if name.name in actions.declared and actions.declared[name.name].is_fixed and actions.is_ros1:
                message = f"argument `{name.name}` of {target} has a fixed value and cannot be set"
                yield self._at(file, name, message, severity)
        outer = () if file.is_ros1 else (*file.declared, *file.assigned)
        missing = [
            name
            for name, declared in actions.declared.items()
            if declared.is_required and name not in passed and name not in outer
        ]
        # A misspelt name has its own finding.
        if missing and not call.passes_all and file.is_ros1 == actions.is_ros1 and passed <= names:
            message = f"the include does not pass the required argument `{missing[0]}` of {target}"
            yield self.at_span(file.source.span(call.start, call.end), message, severity=severity)

    def _xacro(self, file: LaunchActions, call: Call, model: Model) -> Findings:
        from urdfkit.description.xacro.declared_arguments import declared_arguments, is_used

        path = receiver(call, model) if call.passed else None
        # The description of another robot can be a part of this one.
        if path is None or path.resolve() not in (Path(each).resolve() for each in model.expanded.sources):
            return
        left_out = _files_left_out(model)
        sources = [*model.expanded.sources.values(), *(left_out or ())]
        names = [*declared_arguments(sources), *(each.name for each in call.passed if is_used(each.name, sources))]
        may_have_more = call.passes_all or bool(model.missing_file) or left_out is None
        yield from self._unknown(file, call.passed, names, path.name, may_have_more, self.severity)

    def _unknown(
        self,
        file: LaunchActions,
        passed: tuple[Named, ...],
        names: Iterable[str],
        target: str,
        only_misspelt: bool,
        severity: Severity,
    ) -> Findings:
        from urdfkit.lint.facts.launch.python.api import first_slip
        from urdfkit.lint.fix_builders import meant

        names = list(names)
        for name in passed:
            if name.name in names:
                continue
            others = [other for other in names if other not in {one.name for one in passed}]
            near = meant(name.name, others)[0] or first_slip(name.name, others)
            if near is None:
                near = _with_these_words(name.name, others, only_misspelt)
            hint = Suggestion(near, name.name)
            if near is not None or not only_misspelt:
                yield self._at(file, name, f"{target} has no argument `{name.name}`" + hint, severity)

    def _at(self, file: LaunchActions, name: Named, message: str, severity: Severity) -> Finding:
        return self.at_span(file.source.span(name.start, name.end), message, severity=severity)


_OPTIONAL = frozenset(("enable", "launch", "name", "path", "run", "show", "start", "use", "with"))
"""Words that names of arguments have or lack without another meaning."""


def _with_these_words(name: str, others: list[str], only_optional: bool) -> str | None:
    """Return the only argument of a file that has all words of a name, such as ``slam_params_file``, or fewer words.

    Args:
        name: the name of the passed argument.
        others: the arguments of the file.
        only_optional: whether the names may differ by `_OPTIONAL` words only, unless the name is that of a file.
    """
    words = set(name.split("_"))
    near = [each for each in others if words < set(each.split("_")) or set(each.split("_")) < words]
    is_meant = len(near) == 1 and (
        not only_optional or name.endswith("_file") or words ^ set(near[0].split("_")) <= _OPTIONAL
    )
    return near[0] if is_meant else None


def _files_left_out(model: Model) -> list[Source] | None:
    """Return the files that a description includes only with other arguments, which may declare more arguments.

    None if one of them is not a file of these packages.
    """
    from urdfkit.description.packages.existence import is_file
    from urdfkit.description.packages.related_files import neighbours
    from urdfkit.description.xml.reader import read_source, shown_path
    from urdfkit.errors import ResourceError
    from urdfkit.lint.facts.launch.actions import share_of

    names = {name.rpartition("/")[2] for name in model.expanded.sources}
    texts = [source.text for source in model.expanded.sources.values()]
    packages = neighbours(model.package) if model.package is not None else {}
    found: list[Source] = []
    for text in texts:  # the list grows during the iteration
        for at in re.finditer(_INCLUDE, text):
            package, path = share_of(at[1])
            if at[1].rpartition("/")[2] in names:
                continue
            names.add(at[1].rpartition("/")[2])
            if package not in packages or not is_file(packages[package] / path) or len(found) > _MOST_FILES:
                return None
            try:
                file = packages[package] / path
                found.append(read_source(file, shown_as=shown_path(file), texts=model.texts))
            except ResourceError:
                return None
            texts.append(found[-1].text)
    return found


_MOST_FILES = 40
_INCLUDE = r"<xacro:include\b[^<>]*?\bfilename\s*=\s*[\"']([^\"'<>]*)[\"']"
