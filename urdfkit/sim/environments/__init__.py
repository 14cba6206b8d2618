"""Environments of Gymnasium for any robot.

A task is a function of a batch, which returns observations, rewards and whether episodes end.

::

    import gymnasium
    import numpy as np

    def reach_goal(batch):
        error = batch.base_pose[:, :2] - (1.0, 0.5)
        distance = np.hypot(*error.T)
        return error, -distance, distance < 0.1

    environment = gymnasium.make("urdfkit/Robot-v0", model="simpleton", task=reach_goal)
"""
