"""Topics of a robot across its description, bridges, controllers, launch files and parameter files.

Input: a `Model`; output: names of topics with source positions.
"""
