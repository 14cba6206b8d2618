"""Batches: many worlds of one robot, advanced together on all processor cores. Plugins do not run in them.

Actions set the motors of joints, and the state is read from arrays with a row for each world.

::

    import numpy as np
    from urdfkit.sim.batch import Batch

    batch = Batch("simpleton", 64, vary={"chassis.mass": (0.5, 2.0), "spawn.yaw": (-3.14, 3.14)})
    batch.step(np.full((64, 2), 5.0), 1000)
    print(batch.base_pose[:, :2])
"""

from urdfkit.sim.batch.batch import Batch
from urdfkit.sim.batch.joint_control import Servo

__all__ = ["Batch", "Servo"]
