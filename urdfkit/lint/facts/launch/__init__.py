"""XML, YAML and Python launch files with source positions; no launch file is executed.

Input: the launch files of a package; output: the arguments they declare, use and pass, and the nodes they start.
"""
