"""Rules on launch files: their arguments, the arguments of included files and of xacro, and executables.

They read XML, YAML and Python launch files without executing them.
"""
