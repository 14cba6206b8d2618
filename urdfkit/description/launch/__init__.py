"""Read launch files without executing them.

Input: a launch file; output: its xacro commands with their constant arguments.
"""
