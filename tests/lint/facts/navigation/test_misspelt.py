"""Each name of the tables of Nav2 with one letter too many: the name is suggested; the names themselves are silent."""

from __future__ import annotations

from collections.abc import Callable, Collection

import pytest

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.navigation import tables
from urdfkit.lint.facts.navigation.misspelt import _TOPICS, misspelt_navigation

NODE = "controller_server:\n  ros__parameters:\n"
PARAMETERS = tables.DOUBLES | tables.INTEGERS | tables.OTHERS | tables.SWITCHES
TABLES: dict[str, tuple[Collection[str], Callable[[list[str]], str]]] = {
    "parameter": (
        [name for name in PARAMETERS if len(name) >= 6],
        lambda names: NODE + "".join(f"    {name}: 1.0\n" for name in names),
    ),
    "node": (tables.NODES, lambda names: "".join(f"{name}:\n  ros__parameters: {{a: 1}}\n" for name in names)),
    "topic": (_TOPICS, lambda names: NODE + "".join(f"    a{n}_topic: /r/{name}\n" for n, name in enumerate(names))),
    "plugin": (
        tables.PLUGINS,
        lambda names: NODE + "".join(f'    a{n}:\n      plugin: "{name}"\n' for n, name in enumerate(names)),
    ),
}


@pytest.mark.parametrize("kind", TABLES)
def test_the_name_is_suggested(kind: str) -> None:
    names, text = TABLES[kind]
    missed = {}
    for name in sorted(names):
        misspelt = name[:-2] + name[-2] + name[-2:]
        found = list(misspelt_navigation(Source("nav2.yaml", text([misspelt]))))
        if misspelt not in names and [(one[1], one[2].removeprefix("/r/")) for one in found] != [(kind, name)]:
            missed[misspelt] = [one[1:] for one in found]
    assert missed == {}


@pytest.mark.parametrize("kind", TABLES)
def test_the_names_are_silent(kind: str) -> None:
    names, text = TABLES[kind]
    assert [one[1:] for one in misspelt_navigation(Source("nav2.yaml", text(sorted(names))))] == []
