"""Controllers of single joints and groups: forward commands, PID, grippers, the joint state broadcaster.

Commands and joint states go in; position, velocity or effort commands come out.
"""
