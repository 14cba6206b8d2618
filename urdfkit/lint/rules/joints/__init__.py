"""Rules on joints, axes and limits."""
