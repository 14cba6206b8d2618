"""``python -m urdfkit``."""

import sys

from urdfkit.cli import main

sys.exit(main())
