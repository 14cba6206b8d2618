"""T206 duplicate-link."""

from urdfkit.description.urdf.queries import repeated
from urdfkit.description.urdf.robot import Link
from urdfkit.description.xml.source import Expansion
from urdfkit.lint.facts.twins import mirrored
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule


class DuplicateLink(RobotRule):
    """Two links have the same name.

    ## What it does
    Checks for links with the name of an earlier link.

    ## Why is this bad?
    Other elements and tools identify a link by its name. urdfdom rejects the robot; other tools keep one of the two
    links.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
    -  <link name="upper"/>
       <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
     </robot>
    ```
    """

    code = "T206"
    name = "duplicate-link"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link with the name of an earlier one; one for a macro call that repeats another."""
        calls: dict[Expansion, list[Link]] = {}
        pairs = list(repeated(model.robot.links))
        for link, first in pairs:
            here, there = link.element.origin, first.element.origin
            if here.position == there.position and here.expansions and here.expansions != there.expansions:
                calls.setdefault(_different_call(here.expansions, there.expansions), []).append(link)
        # Several calls that repeat one link each have the names of a macro that uses too few of its parameters.
        macros = [call.macro for call in calls]
        calls = {call: links for call, links in calls.items() if links[1:] or macros.count(call.macro) == 1}
        for call, links in calls.items():
            yield self._of_call(model, call, links)
        single = [(link, first) for link, first in pairs if not any(link in each for each in calls.values())]
        for link, first in single:
            message = f"duplicate link `{link.name}`"
            help = f"rename or remove it; the first definition is at {model.shown(first.element.origin.position)}"
            yield self.at(model, link.element, message, attribute="name", link=link.name, help=help)

    def _of_call(self, model: Model, call: Expansion, links: list[Link]) -> Finding:
        joints = (one for one in model.robot.joints if call in one.element.origin.expansions)
        made = [*(link.name for link in links), *(joint.name for joint in joints)]
        some = f"{len(links)} links of another call, such as `{links[0].name}`"
        some = some if links[1:] else f"link `{links[0].name}` of another call"
        message = f"the call of macro `{call.macro}` repeats {some}"
        return self.at_span(
            model.span(call.position),
            message,
            link=links[0].name,
            kind="call",
            help="pass another name or prefix",
            chains=tuple(link.element.origin.expansions for link in links),
            names=tuple(name for one in made for name in (one, *mirrored(one))),
        )


def _different_call(calls: tuple[Expansion, ...], others: tuple[Expansion, ...]) -> Expansion:
    """Return the outermost macro call that is not around the other element."""
    return next((call for call in reversed(calls) if call not in others), calls[-1])
