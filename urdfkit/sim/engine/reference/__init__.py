"""The same step with mass matrix, bias and Jacobians from Pinocchio: the reference that tests compare the kernel with.

It takes the arrays of the engine and advances them as the kernel does.
"""
