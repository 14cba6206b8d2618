"""L101 launch-argument-undeclared."""

from __future__ import annotations

import re

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.launch.actions import launch_files
from urdfkit.lint.facts.launch.records import LaunchActions
from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchArgumentUndeclared(RobotRule):
    """A launch file uses an argument that it does not declare.

    ## What it does
    Compares the names in ``$(arg …)``, ``$(var …)`` and ``LaunchConfiguration(…)`` with the declared arguments. In ROS
    2, a launch file can also use the arguments of other launch files. Therefore, a name is reported there only if no
    launch file of these packages declares it. In addition, the name must be misspelt, or launch files outside these
    packages must be unable to declare it. If other launch files declare or pass the argument, but neither the file nor
    its included files declare it, the finding is a warning. A file without declared arguments can inherit them from a
    file that includes it.

    ## Why is this bad?
    The launch fails with "requires the 'model' arg to be set" or "launch configuration 'model' does not exist". With a
    default in ``LaunchConfiguration``, the argument has no effect.

    ## Example
    ```diff
     <launch>
       <arg name="model" default="cart"/>
    -  <param name="robot_name" value="$(arg modle)"/>
    +  <param name="robot_name" value="$(arg model)"/>
     </launch>
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L101"
    name = "launch-argument-undeclared"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undeclared name."""
        files = list(launch_files(model))
        elsewhere = {name for file in files if not file.is_ros1 for name in (*file.declared, *file.assigned)}
        elsewhere |= {word.name for file in files if not file.is_ros1 for call in file.includes for word in call.passed}
        for file in files:
            reported: set[str] = set()
            for use, has_default in file.used:
                if use.name in file.declared or use.name in file.assigned or use.name in reported:
                    continue
                reported.add(use.name)
                if not file.is_computed:
                    yield from self._undeclared(file, use, has_default, use.name in elsewhere, model)

    def _undeclared(
        self, file: LaunchActions, use: Named, has_default: bool, is_elsewhere: bool, model: Model
    ) -> Findings:
        from urdfkit.lint.facts.launch.receivers import OUTSIDE, receiver
        from urdfkit.lint.fix_builders import nearest
        from urdfkit.lint.model.masked_names import is_typo

        used = {name.name for name, _ in file.used}
        unused = [name for name in file.declared if name not in used]
        candidates = unused if is_elsewhere and not file.is_ros1 else file.declared
        near = nearest(use.name, candidates, cutoff=0.75)
        if near is not None and not is_typo(use.name, near):
            near = None
        are_found = all(
            receiver(call, model) is not None or (call.package, call.path.rpartition("/")[2]) in OUTSIDE
            for call in file.includes
        )
        is_certain = are_found and not has_default and not is_elsewhere and bool(file.declared)
        is_certain &= not file.imports_code
        if near is None and not file.is_ros1 and not is_certain:
            if is_elsewhere and are_found and not has_default and not file.imports_code:
                yield from self._inherited(file, use, model)
            return
        renamed = _unused(file, use.name, model) if near is None and file.is_ros1 else None
        if renamed is not None or (near is not None and near not in used and _is_rarer(near, use.name, file)):
            place = renamed or file.declared[near or ""].name
            near = place.name
            message = f"launch argument `{near}` is declared but not used" + Suggestion(use.name, near)
        else:
            place = use
            hint = Suggestion(near, use.name)
            message = f"launch argument `{use.name}` is not declared" + hint
        span = file.source.span(place.start, place.end)
        severity = "warning" if has_default else self.severity
        yield self.at_span(span, message, severity=severity)

    def _inherited(self, file: LaunchActions, use: Named, model: Model) -> Findings:
        """Warn of a name that has a value only if another launch file includes this one."""
        from urdfkit.lint.facts.launch.receivers import included_files

        included = [each for each in included_files(file, model) if each is not None]
        passing = {
            call.path.rpartition("/")[2] for call in file.includes for word in call.passed if word.name == use.name
        }
        included = [each for each in included if each.source.file.rpartition("/")[2] not in passing]  # evaluated before
        if any(each.is_computed or use.name in {*each.declared, *each.assigned} for each in included):
            return
        if not file.declared and _is_passed_down(file, use.name, model):
            return
        span = file.source.span(use.start, use.end)
        message = f"launch argument `{use.name}` is not declared; the file fails unless an including file declares it"
        unused = _unused(file, use.name, model)
        if unused is not None:
            other = file.source.span(unused.start, unused.end)
            message = f"launch argument `{unused.name}` is declared but not used, and `{use.name}` is not declared"
            details = {"other": other, "is_other_wrong": True, "cause": f"argument {use.name}"}
            help = f"declare `{use.name}` instead, or in addition"
            yield self.at_span(span, message, severity="warning", help=help, **details)
            return
        yield self.at_span(span, message, severity="warning", help="declare the argument, with a default")


def _is_passed_down(file: LaunchActions, name: str, model: Model) -> bool:
    """Return whether a launch file that includes another one gives it an argument."""
    from urdfkit.lint.facts.launch.receivers import included_files

    for other in (each for each in launch_files(model) if each.includes):
        passed = {word.name for call in other.includes for word in call.passed}
        included = included_files(other, model) if name in {*other.declared, *other.assigned, *passed} else ()
        if any(each is not None and each.source.file == file.source.file for each in included):
            return True
    return False


def _unused(file: LaunchActions, name: str, model: Model) -> Named | None:
    """Return the only declaration that is not used or passed, if a file that includes this file passes a name."""
    files = list(launch_files(model))
    passed = {word.name for each in files for call in each.includes for word in call.passed}
    used = {word.name for word, _ in file.used} | passed
    unused = [declaration for each, declaration in file.declared.items() if each not in used]
    if len(unused) != 1 or name not in passed:
        return None
    return unused[0].name


def _is_rarer(name: str, other: str, file: LaunchActions) -> bool:
    """Return whether a name occurs less often in a launch file than another, or as often but is no common argument."""
    counts = [len(re.findall(rf"(?<!\w){re.escape(word)}(?!\w)", file.source.text)) for word in (name, other)]
    return counts[0] < counts[1] or (counts[0] == counts[1] and other in _COMMON.split())


_COMMON = (
    "use_sim_time world world_name model gui rviz headless paused namespace robot_name prefix roll pitch yaw debug"
    " verbose rvizconfig rviz_config params_file map autostart use_rviz robot_description urdf_file output"
)
"""Common names of launch arguments."""
