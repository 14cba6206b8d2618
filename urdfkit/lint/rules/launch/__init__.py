"""Rules on launch files: their arguments, the arguments of included files and of xacro, and executables.

They read launch files in XML, YAML and Python without executing them.
"""
