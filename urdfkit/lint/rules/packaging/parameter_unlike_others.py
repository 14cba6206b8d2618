"""K992 parameter-unlike-others."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class ParameterUnlikeOthers(RobotRule):
    """A key, name, list or value in YAML differs from the other entries of its file.

    ## What it does
    Compares the entries of each YAML file with each other and with the joints of the robot. Reports:

    - keys and names that differ by a letter from those of at least two sections of the same shape
    - lists of numbers that are one value longer or shorter than the lists of the other sections
    - names in a list without a section, next to a section that the list does not name
    - names that occur twice in a list of joints, plugins or controllers
    - misspelt joints and frames of the robot, and misspelt parameters, in the parameters of any node
    - sections that lack a key of all others, minima above their maxima, and the only key without underscores
    - Booleans and numbers in quotes, and negative rates and sizes

    Entries that a rule for their node reports are left out.

    ## Why is this bad?
    Nodes ignore unknown keys and use their defaults, and reject values of another type.

    ## Example
    ```diff
     FL_hip_controller: {type: legged_control/JointController, joint: FL_hip_joint}
     FR_hip_controller: {type: legged_control/JointController, joint: FR_hip_joint}
    -RL_hip_controller: {type: legged_control/JointController, jiont: RL_hip_joint}
    +RL_hip_controller: {type: legged_control/JointController, joint: RL_hip_joint}
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "K992"
    name = "parameter-unlike-others"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each entry, one for each line."""
        from urdfkit.description.xml.reader import shown_path
        from urdfkit.lint.facts.control.yaml_tree import span_of, yamls
        from urdfkit.lint.facts.parameters.odd_entries import odd_entries
        from urdfkit.lint.facts.parameters.odd_values import odd_values

        read = {shown_path(file) for file in model.expanded.files}
        for source in yamls(model):
            lines = set[int]()
            for place, message in (*odd_values(source, model), *odd_entries(source)):
                if place.line not in lines:
                    lines.add(place.line)
                    kind = "numbered" if "unlike the other names" in message else ""
                    if ", more than `" in message and source.file in read:
                        kind = "bounds"
                    yield self.at_span(span_of(source, place), message, kind=kind)
