"""Trees at rest sleep with the forces they rest on, and wake when something happens to them.

Velocities and contacts go in; which trees are advanced comes out.
"""
