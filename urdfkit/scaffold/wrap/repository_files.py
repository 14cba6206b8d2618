"""What goes with any robot, also with one that no template made: tests, CI, pre-commit, dev container.

It is what lies below ``company/`` in the template of new robots, so that there is one source of it.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import replace
from pathlib import Path

from urdfkit.resources import templates_dir
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.templates.template_parser import load_template
from urdfkit.scaffold.update.rendering import render

FOLDER = "company/"
"""Of the layers that go with any robot."""


def company(origin: str, *, repository: bool, licensed: bool) -> Template:
    """Return the part of the template of new robots that goes with any robot.

    Args:
        origin: what the README says the robot is.
        repository: whether what lies beside the packages belongs to it.
        licensed: whether its packages have their licenses.
    """
    whole = load_template(templates_dir() / "robot")
    beside = f"{FOLDER}repository/"
    layers = [
        layer
        for layer in whole.layers
        if layer.folder.startswith(FOLDER) and (repository or not layer.folder.startswith(beside))
    ]
    for layer in whole.layers:
        if layer.folder.startswith("licenses/") and (repository if layer.spare else not licensed):
            layers.append(layer)
    words = tuple(
        replace(word, says={**word.says, "none": origin}) if word.name == "drive_in_words" else word
        for word in whole.words
    )
    return replace(whole, layers=tuple(layers), words=words)


def accompany(
    stage: Path,
    name: str,
    origin: str,
    given: Mapping[str, str],
    *,
    repository: bool,
    without: Collection[str] = (),
) -> None:
    """Render what goes with a robot beside its packages.

    Args:
        stage: where the packages were rendered to.
        name: of the robot: what the packages' names begin with.
        origin: what the README says the robot is.
        given: ros, maintainer, email, license, picture; and year, into.
        repository: whether to write what lies beside the packages.
        without: topmost names that are left out: they are there already.

    Raises:
        ResourceError: it cannot be written.
    """
    template = company(origin, repository=repository, licensed=given["ros"] != "none")
    asked = {question.name for question in template.questions}
    mine = {key: value for key, value in given.items() if key in asked}
    answers = template.answers({**mine, "name": name, "drive": "none", "repository": "yes" if repository else "no"})
    answers |= {"year": given["year"], "into": given["into"]}
    render(template, answers, stage, without=set(without) & template.spare(answers))


def told_to_test(kind: str, ros: str) -> dict[str, str]:
    """Return placeholders of the template of packages, for one that runs the tests it comes with.

    Args:
        kind: description, gazebo or bringup.
        ros: the distribution.
    """
    if ros == "noetic":
        needs = {"description": ["liburdfdom-tools", "python3-nose"], "gazebo": ["python3-nose"]}.get(kind, [])
        needs = [*needs, "roslaunch"]
    else:
        needs = ["ament_cmake_pytest", *{"description": ["liburdfdom-tools"], "gazebo": ["python3-yaml"]}.get(kind, [])]
    nose = "" if kind == "bringup" else "  catkin_add_nosetests(test)\n"
    return {
        "ament_tests": "\nif(BUILD_TESTING)\n  find_package(ament_cmake_pytest REQUIRED)\n"
        "  ament_add_pytest_test(test test)\nendif()\n",
        "catkin_tests": "\n\nif(CATKIN_ENABLE_TESTING)\n  find_package(roslaunch REQUIRED)\n"
        f"  roslaunch_add_file_check(launch)\n{nose}endif()",
        "test_depends": "\n" + "".join(f"  <test_depend>{name}</test_depend>\n" for name in needs),
    }
