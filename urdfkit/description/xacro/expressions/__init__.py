"""Evaluate xacro expressions within limits on time, memory and reach, as they come from untrusted files.

Python source goes in; a value comes out, or an error that names the limit.
"""
