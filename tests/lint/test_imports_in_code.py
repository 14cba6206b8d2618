"""Imports in the code of nodes: messages, services, actions and modules that exist, next to those that do not."""

import pytest

from tests.lint.test_build_files import MANIFEST, write
from urdfkit.lint import lint

FILES = {
    "cart.urdf": '<robot name="cart"><link name="base_link"/></robot>\n',
    "msg/RowState.msg": "float64 offset\n",
    "srv/Load.srv": "---\n",
    "action/Dock.action": "---\n---\n",
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.8)\nproject(cart)\n",
}


def found(folder, **files):
    names = {"python": "scripts/node.py", "cpp": "src/node.cpp", "manifest": "package.xml"}
    write(folder, FILES | {names[key]: text for key, text in files.items()})
    return [each.message for each in lint(folder) if each.code == "K994"]


@pytest.mark.parametrize(
    ("tool", "code", "messages"),
    [
        ("ament_cmake", "from cart.msg import RowState", []),
        ("ament_cmake", "from cart.srv import Load, Load_Request", []),
        ("catkin", "from cart.srv import (Load,  # of a box\n    LoadRequest, LoadResponse)", []),
        ("catkin", "from cart.msg import DockAction, DockGoal as Goal", []),
        ("ament_cmake", "from cart.action import Dock", []),
        ("ament_cmake", "from cart.msg import Load", ["`Load` is a service; did you mean `cart.srv`?"]),
        ("ament_cmake", "from cart.srv import Dock, Load", ["`Dock` is an action; did you mean `cart.action`?"]),
        (
            "catkin",
            "from cart.msg import DockActoin",
            ["`cart` has no message `DockActoin`; did you mean `DockAction`?"],
        ),
        ("ament_cmake", "from cart.msg import Unknown", ["`cart` has no message `Unknown`"]),
        ("ament_cmake", "try:\n    from cart.msg import Load\nexcept ImportError:\n    Load = None", []),
        ("ament_cmake", "from other.msg import Load", []),
        ("ament_cmake", "from std_srvs.srv import Empty", []),
        ("ament_cmake", "from std_msgs.srv import Empty", ["`std_msgs` has no services; did you mean `std_msgs.msg`?"]),
        ("ament_cmake", '"""\nfrom cart.msg import Load\n"""', []),
    ],
)
def test_interfaces_in_python(tmp_path, tool, code, messages):
    assert found(tmp_path, python=f"{code}\n", manifest=MANIFEST.replace("ament_cmake", tool)) == messages


@pytest.mark.parametrize(
    ("header", "messages"),
    [
        ("cart/msg/row_state.hpp", []),
        ("cart/srv/load.hpp", []),
        ("cart/msg/rowstate.hpp", ["`cart` has no message with the header `rowstate.hpp`; did you mean `row_state`?"]),
        ("cart/msg/load.hpp", ["`Load` is a service of `cart`; did you mean `srv`?"]),
        ("cart/RowState.h", []),
        ("cart/Rowstate.h", ["`cart` has no message, service or action `Rowstate`; did you mean `RowState`?"]),
        ("cart/wheels.hpp", []),
        ("cart/loadd.h", []),  # a header of the package
        ("cart/msg/detail/load__struct.hpp", []),
        ("other/msg/load.hpp", []),
    ],
)
def test_interfaces_in_cpp(tmp_path, header, messages):
    write(tmp_path, {"include/cart/loadd.h": "#pragma once\n"})
    assert found(tmp_path, cpp=f"#include <{header}>\n", manifest=MANIFEST) == messages


SETUP = """from setuptools import setup

setup(
    name="cart",
    version="1.0.0",
    packages=["cart"{}],
    entry_points={{"console_scripts": ["node = cart.node:main"]}},
)
"""


@pytest.mark.parametrize(
    ("code", "more", "messages"),
    [
        ("from stops import parse", "", ["after installation, `stops` is found only as a module of `cart`"]),
        ("import stops", "", ["after installation, `stops` is found only as a module of `cart`"]),
        ("from cart.stops import parse", "", []),
        ("from .stops import parse", "", []),
        ("from . import stops", "", []),
        ("import sys\nsys.path.append('.')\nfrom stops import parse", "", []),
        ("from stops import parse", ', "stops/"', []),  # a package of its own
        ("import json", "", []),  # of Python, although the package has a file with this name
    ],
)
def test_modules_next_to_a_module(tmp_path, code, more, messages):
    manifest = MANIFEST.replace("ament_cmake", "ament_python")
    files = {"cart.urdf": FILES["cart.urdf"], "package.xml": manifest, "setup.py": SETUP.format(more)}
    modules = {"__init__": "", "stops": "", "json": "", "node": f"{code}\n\n\ndef main():\n    pass\n"}
    write(tmp_path, files | {f"cart/{name}.py": text for name, text in modules.items()})
    messages_of_code = [each.message.partition(";")[0] for each in lint(tmp_path) if each.code == "K994"]
    assert messages_of_code == messages
