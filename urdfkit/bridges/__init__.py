"""What carries messages out of the process: recordings."""
