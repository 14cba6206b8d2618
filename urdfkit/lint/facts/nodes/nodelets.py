"""Nodelets of ROS 1 whose manager no launch file starts.

Source: ros/nodelet_core (nodelet/src/nodelet.cpp, Noetic): ``nodelet load TYPE MANAGER`` waits for the service
``MANAGER/load_nodelet``.
"""

import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.launched_nodes import launches, started
from urdfkit.lint.facts.topics.words import Words
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_MANAGER = r"<node\b[^<>]*\bargs\s*=\s*[\"']\s*manager\b[^<>]*>"
_NAME = r"\bname\s*=\s*[\"']([^\"'$]+)[\"']"


def unmanaged_nodelets(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the name of the manager and the message, where that launch file starts another manager."""
    words = Words(model)
    for source in launches(model):
        found = [re.search(_NAME, tag[0]) for tag in re.finditer(_MANAGER, source.text)]
        names = sorted({name[1] for name in found if name is not None})
        if not names or len(names) < len(found):
            continue
        for node in started(source):
            listed = [word.name if word is not None else "" for word in node.arguments]
            if node.package != "nodelet" or len(listed) < 3 or listed[0] != "load" or node.arguments[2] is None:
                continue
            manager = node.arguments[2]
            name = manager.name.rpartition("/")[2]
            if name not in names and not words.names(name, [(source.file, manager.start)]):
                near = names[0] if len(names) == 1 else nearest(name, names)
                yield source, manager, f"no launch file starts the nodelet manager `{name}`" + Suggestion(near, name)
