"""Driving from the terminal: keys of standard input go in, commands of a driver and a status line come out.

The driver takes turns with the pages by the same lock, so a simulation has one driver at a time.
"""
