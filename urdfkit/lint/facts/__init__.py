"""Facts about a robot that several rules share: features, neighbouring names, root causes.

Input is a `Model`; output are facts with their source positions, not findings.
"""
