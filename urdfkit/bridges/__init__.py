"""Carry messages between a simulation and other programs: recordings and bridges.

A bus goes in; an MCAP file that ``ros2 bag`` reads comes out, or peers connect that subscribe and publish.
"""
