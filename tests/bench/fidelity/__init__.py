"""Physics next to closed forms: rows of docs/fidelity.md, for our engine and for peers on the same models."""
