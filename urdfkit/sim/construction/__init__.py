"""Construction of simulations from descriptions: bodies, surfaces and start poses, validated.

A robot or a world goes in; records for `urdfkit.sim.engine` come out, or an error with its place.
"""
