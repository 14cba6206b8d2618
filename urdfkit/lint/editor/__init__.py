"""Editor features for descriptions: diagnostics, hover, definitions, references, renaming, completion.

The package is independent of the protocol, which `urdfkit.cli.lsp` implements. A `Project` stores the editor's texts,
saved or not, and the models read from them. The other modules compute the result of a request at a `Cursor`.
"""
