"""Structure-aware fuzzing of every input; ``python -m tests.bench.fuzz FAMILY [COUNT] [SEED]``.

Last runs, all from seed 0, with the failures that are not repaired:

- lint 20,000, expand 5,000, lsp 5,000, sdf 5,000, mesh 5,000, parameters 5,000, frames 1,000 (100,000 frames): none.
- sim 4,300: 2,204 stepped, 231 diverged, 1,861 refused; seeds 2411, 2432, 2467 and 2480 need more than 12 s of CPU for
  100 steps.

lint and lsp ran before attributes were no longer copied to elements that have them already.
"""
