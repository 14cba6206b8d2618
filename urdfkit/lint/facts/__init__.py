"""Facts about a robot that several rules share: features, neighbouring names, root causes.

Input: a `Model`; output: facts with their source positions, not findings.
"""
