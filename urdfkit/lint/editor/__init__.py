"""What an editor asks of a description: what is wrong, what this is, where it comes from, who uses it, what fits here.

Nothing here knows a protocol: `urdfkit.cli.lsp` speaks it. A `Project` holds the texts as they are in the editor, saved
or not, and the models they make; the other modules answer questions about a `Cursor` in one of them.
"""
