"""The desk: what a picture works on besides a packet, `WIDTH` numbers per row."""

from __future__ import annotations

from urdfkit.scene.rays.ray_packet import WIDTH

AT, FACING, COLOR, SHONE, TOWARDS, BLENT = (row * WIDTH for row in (0, 3, 6, 9, 12, 15))
"""What a packet met: where, which way the surface faces, its colour, the light on it; the rays' directions and what
they have seen so far (three rows each) …"""
SHAPE, GAIN, OPAQUE, LEFT, PAST, DEPTH, FIRST = (row * WIDTH for row in range(18, 25))
"""… which shape (-1: none), what of one light gets there, its opacity; how much of a ray goes on behind it, how long
the ray has been; how far and which shape the first was."""
SPECULAR, EXPONENT, SHEEN = (row * WIDTH for row in (25, 28, 29))
"""The gloss of what was met: its colour and exponent (zero: matt); what of the lights it throws back."""
DYE = 32 * WIDTH
DESK = DYE + 4
"""Numbers that a picture works on besides a packet's: the last are a colour from a texture."""
