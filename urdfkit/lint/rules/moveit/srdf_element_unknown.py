"""M102 srdf-element-unknown."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_TYPES = ("fixed", "floating", "planar")


class SrdfElementUnknown(RobotRule):
    """An SRDF has a misspelt element, a misspelt or missing attribute, or an empty group.

    ## What it does
    Compares elements and attributes with the elements and attributes of srdfdom. Elements of other programs are
    accepted unless their name differs slightly from one of srdfdom.

    ## Why is this bad?
    srdfdom ignores the element: the group does not exist, or the links collide.

    ## Example
    ```xml
    <robot name="arm">
      <group name="arm">
        <chain base_link="base" tip="hand"/>
      </group>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <group name="arm">
        <chain base_link="base" tip_link="hand"/>
      </group>
    </robot>
    ```
    """

    code = "M102"
    name = "srdf-element-unknown"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each element or attribute that srdfdom does not read."""
        from urdfkit.lint.facts.moveit.srdf import ELEMENTS, OPTIONAL, elements, semantics_of, severity_for
        from urdfkit.lint.fix_builders import nearest

        for root in semantics_of(model):
            severity, weaker = (severity_for(root, model, each) for each in (self.severity, "warning"))
            for key, element in elements(root):
                attributes = ELEMENTS.get(key)
                if attributes is None:
                    parent, _, tag = key.rpartition("/")
                    tags = [other.rpartition("/")[2] for other in ELEMENTS if other.rpartition("/")[0] == parent]
                    suggestion = nearest(tag, tags, cutoff=0.8)
                    if suggestion is not None:
                        message = f"unknown element <{tag}> of SRDF; did you mean <{suggestion}>?"
                        yield self.at(model, element, message, severity=severity)
                    continue
                missing = [name for name in attributes if name not in element.attributes and name not in OPTIONAL]
                for name in element.attributes:
                    suggestion = nearest(name, missing, cutoff=0.5) if name not in attributes else None
                    if suggestion is not None:
                        missing.remove(suggestion)
                        message = f"unknown attribute `{name}` of <{element.tag}>; did you mean `{suggestion}`?"
                        yield self.at(model, element, message, attribute=name, severity=severity)
                for name in missing:
                    yield self.at(model, element, f"<{element.tag}> has no attribute `{name}`", severity=severity)
                if key == "group" and not element.children:
                    yield self.at(model, element, f"group `{element.get('name')}` is empty", severity=weaker)
                if key == "virtual_joint" and (kind := element.get("type")) not in (None, *_TYPES):
                    suggestion = nearest(kind or "", _TYPES)
                    hint = f"; did you mean `{suggestion}`?" if suggestion else ""
                    message = f"unknown type `{kind}` of virtual joint `{element.get('name')}`{hint}"
                    help = f"use one of {', '.join(_TYPES)}"
                    yield self.at(model, element, message, attribute="type", help=help, severity=severity)
