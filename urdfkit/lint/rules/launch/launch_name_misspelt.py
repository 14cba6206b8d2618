"""L104 launch-name-misspelt."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

_NAMES = ("use_sim_time", "robot_description")
_QUOTED = r"(?<=[\"'])[A-Za-z]\w{8,20}(?=[\"'])"


class LaunchNameMisspelt(RobotRule):
    """A launch file or YAML file misspells ``use_sim_time`` or ``robot_description``.

    ## What it does
    Compares quoted words in launch files and keys in YAML files with these two names. Words that differ by more than
    one letter, or that the file declares as a launch argument, are accepted.

    ## Why is this bad?
    The node does not use the simulated time, or waits for a description that is never published.

    ## Example
    ```xml
    <launch>
      <param name="use_sim_tme" value="true"/>
    </launch>
    ```

    ## Use instead
    ```xml
    <launch>
      <param name="use_sim_time" value="true"/>
    </launch>
    ```
    """

    code = "L104"
    name = "launch-name-misspelt"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt name."""
        from urdfkit.description.packages.related_files import LAUNCH
        from urdfkit.lint.facts.control.launch_package_paths import uncommented
        from urdfkit.lint.facts.launch.actions import actions_of
        from urdfkit.lint.facts.ros_packages import is_slip

        for source in model.related_files.values():
            is_launch = source.file.endswith(LAUNCH)
            if not is_launch and not source.file.endswith((".yaml", ".yml")):
                continue
            pattern = _QUOTED if is_launch else r"(?m)(?<=[\s{,])[A-Za-z]\w{8,20}(?=[ \t]*:)"
            for word in re.finditer(pattern, uncommented(source)):
                near = next((name for name in _NAMES if word[0] != name and is_slip(word[0], name)), None)
                before = source.text[max(word.start() - 25, 0) : word.start()]
                if near is None or re.search(r"-(?:topic|param)\b", before):  # spawn-argument-misspelt reports these
                    continue
                if not (is_launch and word[0] in actions_of(source).declared):
                    message = f"unknown name `{word[0]}`; did you mean `{near}`?"
                    yield Finding(self.code, self.name, self.severity, message, source.span(*word.span()))
