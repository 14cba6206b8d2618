"""Git LFS pointers: the short text files that a clone without Git LFS has in the place of large files."""

LFS = b"version https://git-lfs"
"""First bytes of a pointer (git-lfs: docs/spec.md)."""

POINTER = "is a Git LFS pointer: run `git lfs pull`"
"""Fault of a file that is a pointer, for messages that begin with its name."""
