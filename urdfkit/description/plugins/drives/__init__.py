"""Plugin tables of drives, one module per family; `table.DRIVES` lists them.

Pure data: names, parameters, units and defaults, read by linter, simulator and docs.
"""
