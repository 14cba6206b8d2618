"""Rules on the names of links and joints."""
