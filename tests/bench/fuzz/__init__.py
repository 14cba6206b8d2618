"""Structure-aware fuzzing of every input; ``python -m tests.bench.fuzz FAMILY [COUNT] [SEED]``."""
