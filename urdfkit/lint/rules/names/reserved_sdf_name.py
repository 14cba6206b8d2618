"""N303 reserved-sdf-name."""

from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ReservedSdfName(RobotRule):
    """A link or joint has a name that is reserved in SDF.

    ## What it does
    Checks for link and joint names that begin and end with two underscores or contain ``::``, and for joints named
    ``world``.

    ## Why is this bad?
    sdformat, and therefore Gazebo, rejects the model. Names that begin and end with two underscores are reserved, and
    so is ``world``. ``::`` separates the names of nested models.

    ## Example
    ```diff
     <robot name="cart">
    -  <link name="__base__"/>
    +  <link name="base"/>
     </robot>
    ```
    """

    code = "N303"
    name = "reserved-sdf-name"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each reserved name."""
        for part in model.parts:
            name, kind = part.name, part.element.tag
            if name.startswith("__") and name.endswith("__") and len(name) > 4:
                reason = "names between double underscores are reserved in SDF"
            elif "::" in name:
                reason = "`::` separates the names of nested models in SDF"
            elif name == "world" and kind == "joint":
                reason = "`world` is reserved in SDF"
            else:
                continue
            yield self.at(
                model,
                part.element,
                f"invalid name `{name}` of a {kind}: {reason}",
                attribute="name",
                link=name if kind == "link" else None,
                joint=name if kind == "joint" else None,
                help=f"rename the {kind}",
            )
