"""Rules on what xacro makes of the files."""
