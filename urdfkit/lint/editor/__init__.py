"""Editor features for descriptions: diagnostics, hover, definitions, references, renaming, completion.

The package is independent of the protocol, which `urdfkit.cli.lsp`
implements. A `Project` holds the texts as they are in the editor, saved
or not, and the models they make; the other modules answer questions about a `Cursor` in one of them.
"""
