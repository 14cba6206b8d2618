"""``python -m tests.bench.contact_rich``."""

import sys

from tests.bench.contact_rich.command import main

sys.exit(main())
