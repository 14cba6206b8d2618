"""What a command starts, and a script or notebook can start too.

A robot or a simulation goes in; a running page with its address comes out.
"""
