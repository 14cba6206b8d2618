"""Find packages and files: ``package://``, ``model://``, ``$(find ...)`` and relative paths, with or without ROS.

Input: a URI and the file that contains it; output: a path.
"""
