"""Controllers, launch files and bridges of a package, read without executing launch files.

YAML and launch files go in; controllers, joints, interfaces and nodes with their places come out.
"""
