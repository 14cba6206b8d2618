"""From descriptions to what the engine takes: bodies, surfaces, start poses, validated.

A robot or a world goes in; records for `urdfkit.sim.engine` come out, or an error with its place.
"""
