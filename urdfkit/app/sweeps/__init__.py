"""Sweeps: many runs of a simulation with different parameters, on all cores or a Dask cluster.

Variations and metrics go in; a table with a row for each run comes out. A sweep that was killed continues where it was.
"""
