"""T206 duplicate-link."""

from urdfkit.description.urdf.queries import repeated
from urdfkit.description.urdf.robot import Joint, Link
from urdfkit.description.xml.source import Expansion
from urdfkit.lint.facts.twins import mirrored, side_of
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
        earlier: dict[Expansion, Expansion] = {}
        pairs = [(link, first) for link, first in repeated(model.robot.links) if "$" not in link.name]
        for link, first in pairs:
            here, there = link.element.origin, first.element.origin
            if here.position == there.position and here.expansions and here.expansions != there.expansions:
                call = _different_call(here.expansions, there.expansions)
                calls.setdefault(call, []).append(link)
                earlier[call] = _different_call(there.expansions, here.expansions)
        # Several calls that repeat one link each have the names of a macro that uses too few of its parameters.
        macros = [call.macro for call in calls]
        calls = {call: links for call, links in calls.items() if links[1:] or macros.count(call.macro) == 1}
        for call, links in calls.items():
            yield self._of_call(model, call, links, earlier[call])
        single = [(link, first) for link, first in pairs if not any(link in each for each in calls.values())]
        for link, first in single:
            message = f"duplicate link `{link.name}`"
            help = f"rename or remove it; the first definition is at {model.shown(first.element.origin.position)}"
            yield self.at(model, link.element, message, attribute="name", link=link.name, help=help)

    def _of_call(self, model: Model, call: Expansion, links: list[Link], earlier: Expansion) -> Finding:
        joints = (one for one in model.robot.joints if call in one.element.origin.expansions)
        made = [*(link.name for link in links), *(joint.name for joint in joints)]
        some = f"{len(links)} links of another call, such as `{links[0].name}`"
        some = some if links[1:] else f"link `{links[0].name}` of another call"
        message = f"the call of macro `{call.macro}` repeats {some}"
        return self.at_span(
            model.span((earlier if _is_on_other_side(model, links[0].name, earlier, call) else call).position),
            message,
            link=links[0].name,
            kind="call",
            help="pass another name or prefix",
            chains=tuple(link.element.origin.expansions for link in links),
            names=tuple(name for one in made for name in (one, *mirrored(one))),
        )


def _is_on_other_side(model: Model, name: str, call: Expansion, other: Expansion) -> bool:
    """Return whether a call, unlike another one, places the link of a name on the side that the name contradicts."""
    sign = {"left": 1.0, "right": -1.0}.get(side_of(name), 0.0)
    sides = {
        made: [sign * joint.origin.xyz[1] for joint in model.robot.parents_of.get(name, ()) if made in _calls_of(joint)]
        for made in (call, other)
    }
    return bool(sides[call] and sides[other]) and max(sides[call]) < 0.0 < min(sides[other])


def _calls_of(joint: Joint) -> tuple[Expansion, ...]:
    return joint.element.origin.expansions


def _different_call(calls: tuple[Expansion, ...], others: tuple[Expansion, ...]) -> Expansion:
    """Return the outermost macro call that is not around the other element."""
    return next((call for call in reversed(calls) if call not in others), calls[-1])
