"""Features of the page of a simulation, one module each: driving, pushing, plots, topics, sensor views, replay.

A feature registers the requests it serves and publishes what its panel shows.
"""
