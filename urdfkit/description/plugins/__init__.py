"""PluginSpec tables: the names and parameters of each Gazebo plugin. Pure data for linter, simulator and docs.

``match(plugin)`` finds the table; ``read(plugin, spec)`` returns meaning → text, ``read_all`` all texts of repeated
parameters.
"""

from urdfkit.description.plugins.drives.diff_drive import DIFF_DRIVE
from urdfkit.description.plugins.lookup import ALL_SPECS, match, read, read_all, values
from urdfkit.description.plugins.spec import Parameter, PluginSpec

__all__ = ["ALL_SPECS", "DIFF_DRIVE", "Parameter", "PluginSpec", "match", "read", "read_all", "values"]
