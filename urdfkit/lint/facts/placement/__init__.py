"""Facts on where the parts of a robot are: joints at their parent links, axes, mirrored shapes and tools.

They compare a part with its neighbours and with its counterpart on the other side.
"""
