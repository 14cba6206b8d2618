"""L108 launch-words-joined."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchWordsJoined(RobotRule):
    """A Python launch file joins two words of a command without a space.

    ## What it does
    Checks the parts of ``Command([...])``, which launch joins without spaces, and the strings in ``arguments`` and
    ``cmd``, which Python joins where a comma is missing.

    ## Why is this bad?
    The command is not found, or the program reads an option with the wrong name or value.

    ## Example
    ```diff title="robot.launch.py"
     from launch.substitutions import Command, PathJoinSubstitution
     from launch_ros.substitutions import FindPackageShare

     path = PathJoinSubstitution([FindPackageShare("cart_description"), "cart.urdf"])
    -description = Command(["xacro", path])
    +description = Command(["xacro ", path])
    ```
    """

    code = "L108"
    name = "launch-words-joined"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each word that runs into the one before."""
        from urdfkit.lint.facts.launch.joined_words import joined_words
        from urdfkit.lint.facts.launch.python.names import python_files

        for source, tree in python_files(model):
            for place, message in joined_words(source, tree):
                yield self.at_span(source.span(*place), message)
