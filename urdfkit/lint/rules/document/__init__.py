"""Rules on the XML document and the values in it."""
