"""Controllers, launch files and bridges of a package, read without executing launch files.

Input: YAML and launch files; output: controllers, joints, interfaces and nodes with their source positions.
"""
