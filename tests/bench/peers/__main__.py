"""``python -m tests.bench.peers``."""

import sys

from tests.bench.peers.command import main

sys.exit(main())
