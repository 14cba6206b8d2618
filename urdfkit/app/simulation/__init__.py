"""A simulation that is driven from the page: the loop, and the parts of the page with what may be ordered of each."""
