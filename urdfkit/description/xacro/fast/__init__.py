"""A faster expansion whose result is not printed: light nodes instead of minidom, and reuse after an edit.

The same files go in as for `urdfkit.description.xacro.expand`; the same elements come out.
"""
