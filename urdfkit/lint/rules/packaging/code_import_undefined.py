"""K994 code-import-undefined."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class CodeImportUndefined(RobotRule):
    """The code of a node imports a message, service, action or module that its package does not have.

    ## What it does
    Checks the code in Python and C++ of the robot's package and of related packages for:

    - names of messages, services and actions of these packages that do not exist, such as a service that is imported
      from ``.msg``
    - the same for the modules of std_msgs, std_srvs, geometry_msgs and trajectory_msgs, which contain only one kind of
      interface
    - modules that are imported by the name of their file from another module of the same package. This works only if
      the node is started in the folder of the file

    Imports under a condition or in a function are not checked.

    ## Why is this bad?
    The node stops at once with an ``ImportError``, or the build fails because a header is missing.

    ## Example
    ```diff title="scripts/server.py"
    -from pruner.msg import PruneCane
    +from pruner.srv import PruneCane
    ```
    """

    code = "K994"
    name = "code-import-undefined"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each import that fails."""
        from urdfkit.lint.facts.packaging.build_files import build_files
        from urdfkit.lint.facts.packaging.code_imports import wrong_imports
        from urdfkit.lint.facts.packaging.target_defects import INTERFACES
        from urdfkit.lint.project.code_files import CPP

        for files in build_files(model):
            model.expanded.packages.watch(files.folder, *INTERFACES, *CPP, ".py")
            for source, start, name, message in wrong_imports(files):
                yield self.at_span(source.span(start, start + len(name)), message)
