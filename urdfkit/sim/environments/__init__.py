"""Environments of Gymnasium for any robot. The import of this package registers them as ``urdfkit/Robot-v0``.

A task is a function of a batch, which returns observations, rewards and whether episodes end.

::

    import gymnasium
    import numpy as np
    import urdfkit.sim.environments

    def reach_goal(batch):
        error = batch.base_pose[:, :2] - (1.0, 0.5)
        distance = np.hypot(*error.T)
        return error, -distance, distance < 0.1

    environment = gymnasium.make("urdfkit/Robot-v0", model="simpleton", task=reach_goal)
"""

from urdfkit.errors import MissingDependencyError

try:
    import gymnasium
except ImportError:
    raise MissingDependencyError("environments need Gymnasium: pip install 'urdfkit[learn]'") from None

ID = "urdfkit/Robot-v0"
"""Identifier for `gymnasium.make` and `gymnasium.make_vec`."""

if ID not in gymnasium.registry:
    gymnasium.register(
        ID,
        entry_point="urdfkit.sim.environments.robot_environment:RobotEnvironment",
        vector_entry_point="urdfkit.sim.environments.vector_environment:RobotVectorEnvironment",
    )
