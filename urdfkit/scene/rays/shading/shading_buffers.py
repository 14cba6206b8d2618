"""Layout of the shading buffers: one row of `WIDTH` numbers per quantity, in addition to the ray packet."""

from urdfkit.scene.rays.ray_packet import WIDTH

AT, NORMAL, COLOR, LIGHT_SUM, VIEW, BLENDED = (row * WIDTH for row in (0, 3, 6, 9, 12, 15))
"""Hit point, surface normal, colour and incident light of each ray; ray direction and blended colour so far (three
rows each)."""
SHAPE, GAIN, ALPHA, TRANSMITTED, TRAVELLED, DEPTH, FIRST = (row * WIDTH for row in range(18, 25))
"""Hit shape (-1: none), gain of the current light, opacity; transmitted share and travelled distance of the ray;
distance and shape of the first hit."""
SPECULAR, EXPONENT, HIGHLIGHT = (row * WIDTH for row in (25, 28, 29))
"""Specular colour and exponent of the surface (zero: matt), and the reflected highlight."""
WAITING = 32 * WIDTH
"""Whether the ray waits for its packet of shadow rays (positive), is in the current one, or is done (zero)."""
TEXTURE_COLOR = 33 * WIDTH
BUFFER_SIZE = TEXTURE_COLOR + 4
"""Size of the buffers; the last four numbers are a colour from a texture."""
