"""Z822 conflicting-gazebo-blocks."""

from __future__ import annotations

from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class ConflictingBlocks(RobotRule):
    """Two blocks for Gazebo set the same thing differently.

    ## What it does
    Compares what several ``<gazebo>`` blocks for one link or joint say.

    ## Why is this bad?
    One of them wins, and it is not said which.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <material>Gazebo/Blue</material>
      </gazebo>
      <gazebo reference="base">
        <material>Gazebo/Green</material>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <material>Gazebo/Green</material>
      </gazebo>
    </robot>
    ```
    """

    code = "Z822"
    name = "conflicting-gazebo-blocks"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each value that contradicts one before."""
        said: dict[tuple[str, str], Element] = {}
        for block in model.robot.gazebo:
            for child in block.element.children if block.reference else ():
                value = _value(child)
                if value and not child.children:
                    first = said.setdefault((block.reference or "", child.tag), child)
                    if _value(first) != value:
                        yield self.at(
                            model,
                            child,
                            f"<{child.tag}> of `{block.reference}` is {value} here and {_value(first)} elsewhere",
                            help=f"the other is at {model.shown(first.origin.position)}",
                        )


def _value(element: Element) -> str:
    return " ".join((element.text or element.get("value") or "").split())
