"""The physics engine: rigid bodies, contacts, friction, joint limits and motors, compiled."""

from urdfkit.sim.engine.body import Body, Member, Piece
from urdfkit.sim.engine.engine import Engine
from urdfkit.sim.engine.loose import Loose
from urdfkit.sim.engine.surface import Contact, Ground, Surface
from urdfkit.sim.engine.warmup import warmup

__all__ = ["Body", "Contact", "Engine", "Ground", "Loose", "Member", "Piece", "Surface", "warmup"]
