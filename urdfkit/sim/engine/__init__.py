"""The physics engine: rigid bodies, contacts, friction, joint limits and motors, compiled.

Robots, bodies and targets go in; configurations, velocities and contacts after each step come out.
"""

from urdfkit.sim.engine.bodies import Body, Member, Piece
from urdfkit.sim.engine.contact_surface import Contact, Ground, Surface
from urdfkit.sim.engine.engine import Engine
from urdfkit.sim.engine.free_body import FreeBody
from urdfkit.sim.engine.kernel_cache import warmup

__all__ = ["Body", "Contact", "Engine", "FreeBody", "Ground", "Member", "Piece", "Surface", "warmup"]
