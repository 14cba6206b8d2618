"""The robot expands, is one tree with movable joints, and has no lint findings."""

import shutil
import subprocess
import xml.etree.ElementTree as ET
from pathlib import Path
from unittest import SkipTest

PACKAGE = Path(__file__).resolve().parents[1]
MODEL = PACKAGE / "urdf" / "simpleton.urdf.xacro"


def output_of(*command, stdin=""):
    """Return the output of a program with `stdin` as its input; skip the test if it is not installed."""
    if shutil.which(command[0]) is None:
        raise SkipTest("{} is not installed".format(command[0]))
    done = subprocess.run([str(word) for word in command], input=stdin.encode(), capture_output=True)
    assert done.returncode == 0, (done.stdout + done.stderr).decode()
    return done.stdout.decode()


def urdf():
    """Return the expanded robot."""
    return output_of(*(["urdfkit", "expand"] if shutil.which("urdfkit") else ["xacro"]), MODEL)


def test_is_one_tree():
    robot = ET.fromstring(urdf())
    assert robot.get("name") == "simpleton"
    links = [link.get("name") for link in robot.findall("link")]
    children = [joint.find("child").get("link") for joint in robot.findall("joint")]
    assert len(set(links)) == len(links)
    assert len(set(children)) == len(children) == len(links) - 1


def test_what_moves_has_mass():
    robot = ET.fromstring(urdf())
    mass = {link.get("name"): link.find("inertial/mass") for link in robot.findall("link")}
    for joint in robot.findall("joint"):
        link = joint.find("child").get("link")
        assert joint.get("type") == "fixed" or float(mass[link].get("value")) > 0, link


def test_check_urdf():
    output_of("check_urdf", "/dev/stdin", stdin=urdf())


def test_lint():
    output_of("urdfkit", "lint", PACKAGE)
