"""L116 launch-include-cycle."""

from pathlib import Path

from urdfkit.lint.facts.launch.records import LaunchActions
from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchIncludeCycle(RobotRule):
    """A launch file includes itself.

    ## What it does
    Follows the includes of launch files in these packages, except includes with a condition. Each cycle is reported
    once.

    ## Why is this bad?
    The launch file includes itself repeatedly until the launch stops with an error.

    ## Example
    ```diff
     <launch>
    -  <include file="$(find cart_description)/example.launch"/>
    +  <include file="$(find cart_description)/launch/state.launch"/>
     </launch>
    ```

    ## References
    In this example, the file is named example.launch.
    """

    code = "L116"
    name = "launch-include-cycle"

    def check(self, model: Model) -> Findings:
        """Yield a finding at the include that closes each cycle."""
        from urdfkit.lint.facts.launch.actions import launch_files
        from urdfkit.lint.facts.launch.receivers import actions_at, receiver

        reported: set[frozenset[Path]] = set()
        for file in launch_files(model):
            first = Path(file.source.file).resolve()
            pending: list[tuple[LaunchActions, tuple[Path, ...]]] = [(file, (first,))]
            seen = {first}
            while pending:
                current, path = pending.pop()
                for call in current.includes:
                    found = receiver(call, model) if not call.is_conditional else None
                    target = found.resolve() if found is not None else None
                    if target == first and frozenset(path) not in reported:
                        reported.add(frozenset(path))
                        names = " → ".join(each.name for each in (*path, first))
                        message = "launch file includes itself" + (f": {names}" if len(path) > 1 else "")
                        yield self.at_span(current.source.span(call.start, call.end), message)
                    elif found is not None and target is not None and target not in seen:
                        seen.add(target)
                        inner = actions_at(found, model)
                        pending += [(inner, (*path, target))] if inner is not None else []
