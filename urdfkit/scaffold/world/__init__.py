"""Worlds for `urdfkit new world`: rooms, offices, houses, obstacles.

Answers go in, SDF comes out; the same answers give the same bytes.
"""

from urdfkit.scaffold.world.world_contents import contents

__all__ = ["contents"]
