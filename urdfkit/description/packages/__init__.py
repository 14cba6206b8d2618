"""Find packages and files: ``package://``, ``model://``, ``$(find ...)`` and relative paths, with or without ROS.

A URI and the file it is written in go in; a path comes out.
"""
