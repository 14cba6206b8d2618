"""What every test shares: how hypothesis searches."""

import os

from hypothesis import settings

# Machines are shared and noisy, so no example has a deadline. A developer's every run tries new examples; in CI
# the examples are the same each time, so that a change is judged by itself.
settings.register_profile("developer", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True)
settings.load_profile("ci" if os.environ.get("CI") else "developer")
