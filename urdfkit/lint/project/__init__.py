"""What is linted and how: the entry files below a folder, the settings that apply to them, the target of the robot.

Paths and options go in; entry files, settings and the selection of rules come out.
"""
