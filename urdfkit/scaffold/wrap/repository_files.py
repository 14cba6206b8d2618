"""Files of a robot's repository that do not depend on its template: tests, CI, pre-commit, dev container.

They come from ``project/`` in the robot template, which is their only source.
"""

from collections.abc import Collection, Mapping
from dataclasses import replace
from pathlib import Path

from urdfkit.resources import templates_dir
from urdfkit.scaffold.templates.template import Template
from urdfkit.scaffold.templates.template_parser import load_template
from urdfkit.scaffold.update.rendering import render

FOLDER = "project/"
"""Folder of the layers that any robot gets."""


def repository_template(origin: str, *, repository: bool, licensed: bool) -> Template:
    """Return the part of the robot template that any robot gets.

    Args:
        origin: description of the robot's origin for the README.
        repository: whether to include files outside the packages.
        licensed: whether the packages already have their licenses.
    """
    whole = load_template(templates_dir() / "robot")
    outside = f"{FOLDER}repository/"
    layers = [
        layer
        for layer in whole.layers
        if layer.folder.startswith(FOLDER) and (repository or not layer.folder.startswith(outside))
    ]
    for layer in whole.layers:
        if layer.folder.startswith("licenses/") and (repository if layer.spare else not licensed):
            layers.append(layer)
    words = tuple(
        replace(word, values={**word.values, "none": origin}) if word.name == "drive_in_words" else word
        for word in whole.words
    )
    return replace(whole, layers=tuple(layers), words=words)


def render_repository_files(
    staged: Path, name: str, origin: str, values: Mapping[str, str], *, repository: bool, without: Collection[str] = ()
) -> None:
    """Render the tests of a robot's packages, and the files outside the packages.

    Args:
        staged: folder of the rendered packages.
        name: name of the robot, with which the packages' names begin.
        origin: description of the robot's origin for the README.
        values: answers to ros, maintainer, email, license and picture, and the placeholders year and into.
        repository: whether to write files outside the packages.
        without: names of existing files and folders at the top of the output, which are ignored.

    Raises:
        ResourceError: a file cannot be written.
    """
    template = repository_template(origin, repository=repository, licensed=values["ros"] != "none")
    names = {question.name for question in template.questions}
    used_values = {key: value for key, value in values.items() if key in names}
    answers = template.answers(
        {**used_values, "name": name, "drive": "none", "repository": "yes" if repository else "no"}
    )
    answers |= {"year": values["year"], "into": values["into"]}
    render(template, answers, staged, without=set(without) & template.spare(answers))


def placeholders_of_tests(kind: str, ros: str) -> dict[str, str]:
    """Return the placeholders of the package template for a package with tests.

    Args:
        kind: description, gazebo or bringup.
        ros: the ROS distribution.
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
