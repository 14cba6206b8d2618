"""Each block and command of the pages belongs to a test, or to the list of those without one, with the reason."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path

from tests.docs import course, test_commands, test_page_scripts

ROOT = Path(__file__).parents[2]

TESTED = {
    "docs/editors json": "tests/docs/test_fragments.py",
    "docs/editors toml": "tests/docs/test_fragments.py",
    "docs/exports python": "tests/docs/test_exports_page.py",
    "docs/exports text": "tests/docs/test_exports_page.py",
    "docs/formatting toml": "tests/docs/test_fragments.py",
    "docs/formatting xml": "tests/docs/test_fragments.py",
    "docs/learning python": "tests/docs/test_learning_page.py",
    "docs/library python": "tests/docs/test_library_page.py",
    "docs/library text": "tests/docs/test_library_page.py",
    "docs/linting toml": "tests/docs/test_fragments.py",
    "docs/mcp json": "tests/docs/test_fragments.py",
    "docs/physics text": "tests/docs/test_fragments.py",
    "docs/protocol python": "tests/docs/test_page_scripts.py",
    "docs/protocol text": "tests/docs/test_page_scripts.py",
    "docs/reach csv": "tests/docs/test_commands.py",
    "docs/retiming csv": "tests/docs/test_commands.py",
    "docs/simulator python": "tests/docs/test_simulator_page.py",
    "docs/simulator text": "tests/docs/test_simulator_page.py",
    "docs/sweeps python": "tests/docs/test_sweeps_page.py",
    "docs/sweeps text": "tests/docs/test_sweeps_page.py",
    "docs/tutorials/own_node python": "tests/docs/test_tutorials.py",
    "docs/tutorials/own_node text": "tests/docs/test_tutorials.py",
}
"""Page and language of blocks without a title: the test that runs or compares them."""

UNTESTED = {
    "README text": (2, "install urdfkit and packages of the system"),
    "docs/architecture text": (2, "lists of folders and layers; import-linter checks the layers"),
    "docs/bridges js": (1, "needs roslibjs in a browser"),
    "docs/bridges python": (
        1,
        "needs roslibpy; tests/bridges/rosbridge/client.py does the same",
    ),
    "docs/editors lisp": (1, "needs Emacs"),
    "docs/editors lua": (1, "needs Neovim"),
    "docs/editors text": (1, "downloads packages of npm"),
    "docs/learning text": (
        3,
        "the third one takes 75 s of CPU; tests/docs/test_learning_page.py compares the others",
    ),
    "docs/loading text": (3, "the third one downloads a robot; tests/cli/test_launch_arguments.py compares the others"),
    "docs/performance text": (1, "the shape of an output, whose keys tests/sim/bench/test_command.py checks"),
    "docs/ros1 python": (1, "needs rospy; tests/bridges/ros1 runs a node that does the same, where ROS 1 is installed"),
    "docs/ros1 text": (1, "needs the programs of ROS 1"),
    "docs/ros2 python": (1, "needs rclpy; tests/bridges/ros2 runs a node that does the same, where ROS 2 is installed"),
    "docs/ros2 text": (1, "needs slam_toolbox and Nav2"),
    "docs/teleop text": (1, "a line of a terminal that changes while the robot drives"),
}
"""Page and language of blocks without a title that no test covers: how many, and why."""

UNTESTED_COMMANDS = {
    'make test ARGS="tests/test_architecture.py -q"': "runs the tests themselves",
    'make test ARGS="tests/test_words.py tests/test_architecture.py -q"': "runs the tests themselves",
    "python -m tests.bench.peers --list": "tests/sim/bench/test_command.py runs it",
    "cd ws && colcon build": "tests/docs/test_new_robot_page.py runs it, where colcon is installed",
    ". install/setup.sh": "tests/docs/test_new_robot_page.py runs it, where colcon is installed",
    "ros2 launch scout_bringup scout.launch.py rviz:=true": "needs ROS 2 and Gazebo",
    "python hold.py": "tests/docs/test_kinematics_page.py runs it",
}
"""Commands of other programs on pages whose commands are not run as those of a course."""


def pages() -> dict[str, str]:
    """Return the name of each page, without its suffix, and its text."""
    files = (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    texts = {str(file.relative_to(ROOT).with_suffix("")): file.read_text("utf-8") for file in files}
    return {name: re.sub("^ +```", "```", text, flags=re.MULTILINE) for name, text in texts.items()}


def test_each_block_is_tested_or_listed_with_a_reason() -> None:
    found = Counter(
        f"{name} {block.language or 'text'}"
        for name, text in pages().items()
        for block in course.blocks(text)
        if not block.title and block.language != "console"
    )
    tested = dict(TESTED)
    for name in test_page_scripts.PAGES:
        tested |= {f"{name} python": ""} | ({f"{name} text": ""} if "\nIt prints:\n" in pages()[name] else {})
    counts = {key: count for key, count in found.items() if key not in tested}
    assert counts == {key: count for key, (count, _) in UNTESTED.items()}
    assert sorted(TESTED.keys() - found.keys()) == []
    assert [key for key in TESTED if key in UNTESTED] == []
    for key, test in TESTED.items():
        path = ROOT / test
        text = path.read_text() if path.is_file() else "".join(each.read_text() for each in path.glob("*.py"))
        name = key.split()[0].rpartition("/")[2]
        assert name in text or "csv" in key, f"{test} does not name the page {name}"


def test_each_command_of_another_program_is_tested_or_listed_with_a_reason() -> None:
    found = {
        command
        for page in test_commands.PAGES
        for block in course.blocks(page.read_text("utf-8"))
        if block.language == "console"
        for command, _ in course.commands(block.text)
        if not command.startswith("urdfkit ")
    }
    assert found == set(UNTESTED_COMMANDS)
