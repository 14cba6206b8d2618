"""Plugin tables of sensors, one module per family; `table.SENSORS` lists them.

Pure data: names, parameters, units and defaults, read by linter, simulator and docs.
"""
