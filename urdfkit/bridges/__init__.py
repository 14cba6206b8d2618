"""Carry messages out of the process: recordings.

A bus goes in; an MCAP file that ``ros2 bag`` reads comes out.
"""
