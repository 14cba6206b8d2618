"""The installed packages: versions for bug reports, and the licences of all dependencies.

`distributions` finds the installed distributions that urdfkit requires.
"""
