"""Rules on the tree of links and joints."""
