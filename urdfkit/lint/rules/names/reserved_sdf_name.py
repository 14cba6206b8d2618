"""N303 reserved-sdf-name."""

from __future__ import annotations

from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class ReservedSdfName(RobotRule):
    """A name is reserved in SDF.

    ## What it does
    Looks for links and joints called ``__…__``, for joints called ``world`` and for ``::`` in names.

    ## Why is this bad?
    sdformat, and with it Gazebo, refuses the model: names between double underscores and ``world`` are its own, and
    ``::`` separates the names of nested models.

    ## Example
    ```xml
    <robot name="cart">
      <link name="__base__"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
    </robot>
    ```
    """

    code = "N303"
    name = "reserved-sdf-name"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each reserved name."""
        for part in model.parts:
            name, kind = part.name, part.element.tag
            if name.startswith("__") and name.endswith("__") and len(name) > 4:
                why = "names between double underscores are reserved in SDF"
            elif "::" in name:
                why = "`::` separates the names of nested models in SDF"
            elif name == "world" and kind == "joint":
                why = "`world` is reserved in SDF"
            else:
                continue
            yield self.at(
                model,
                part.element,
                f"{kind} `{name}`: {why}",
                attribute="name",
                link=name if kind == "link" else None,
                joint=name if kind == "joint" else None,
            )
