"""Rules on masses and inertia tensors."""
