"""Facts about the build files of packages, and about the packages that their code needs.

Input: a `Model` or the folder of a package; output: defects with source positions.
"""
