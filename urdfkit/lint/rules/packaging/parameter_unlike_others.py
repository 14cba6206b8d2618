"""K992 parameter-unlike-others."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class ParameterUnlikeOthers(RobotRule):
    """A key, name, list or value in YAML differs from the other entries of its file.

    ## What it does
    Compares the entries of each YAML file with each other and with the joints of the robot. Reports:

    - keys and names that differ by a letter from those of at least half of the sections of the same shape
    - numbers and Booleans in quotes, if the other sections have them without quotes
    - lists of numbers that are one value longer or shorter than all other lists, including the list of the opposite key
      (for a list of minima, the list of maxima)
    - names in a list that have no section, if the file also has a section that the list does not name
    - a name that occurs twice in a list of joints, plugins or controllers
    - misspelt joints and frames of the robot, and misspelt parameters, in the parameters of any node
    - negative rates and sizes, and minima above their maxima

    The rule reads files with `ros__parameters`, files that launch files name, and files in configuration folders of
    packages. It does not report names that occur in the code of the workspace, or entries that a rule for their node
    already reports.

    ## Why is this bad?
    Nodes ignore unknown keys and use their defaults, and reject values of another type.

    ## Example
    ```diff
     gait:
       ros__parameters:
         front: {type: gait/Leg, joint: front_hip}
         middle: {type: gait/Leg, joint: middle_hip}
    -    rear: {type: gait/Leg, jiont: rear_hip}
    +    rear: {type: gait/Leg, joint: rear_hip}
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
        from urdfkit.lint.facts.control.yaml_tree import span_of
        from urdfkit.lint.facts.parameters.odd_entries import odd_entries
        from urdfkit.lint.facts.parameters.odd_files import files_of_nodes, is_in_code
        from urdfkit.lint.facts.parameters.odd_values import odd_values

        read = {shown_path(file) for file in model.expanded.files}
        for source in files_of_nodes(model):
            lines = set[int]()
            for place, message in (*odd_values(source, model), *odd_entries(source)):
                if place.line in lines or ("did you mean" in message and is_in_code(place.text, model)):
                    continue
                lines.add(place.line)
                kind = "numbered" if "unlike the other names" in message else ""
                if ", more than `" in message and source.file in read:
                    kind = "bounds"
                yield self.at_span(span_of(source, place), message, kind=kind)
