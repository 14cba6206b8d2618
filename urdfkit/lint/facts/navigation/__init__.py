"""parameters of Nav2 and robot_localization in YAML.

Input: YAML files; output: the sections of nodes and their defects.
"""
