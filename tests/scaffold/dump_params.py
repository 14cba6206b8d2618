"""`roslaunch --dump-params` for many launch files in one start of Debian's Python; and what `$(find)` finds.

Reads a JSON object from standard input: ``launches``, a list of [package, file], and ``packages``, a list of names.
Prints one: ``params``, a list of the parameters of each launch file, and ``places``, the folder of each package.
"""

import json
import sys

import roslaunch.config
import roslaunch.rlutil
import rospkg


def params(package, name):
    """Return what `roslaunch --dump-params PACKAGE FILE` prints, by name."""
    files = roslaunch.rlutil.resolve_launch_arguments([package, name])
    config = roslaunch.config.load_config_default(files, None, verbose=False, assign_machines=False)
    assert not config.config_errors, config.config_errors
    return {key: str(param.value) for key, param in config.params.items()}


asked = json.load(sys.stdin)
found = rospkg.RosPack()
json.dump(
    {
        "places": {name: found.get_path(name) for name in asked["packages"]},
        "params": [params(*launch) for launch in asked["launches"]],
    },
    sys.stdout,
)
