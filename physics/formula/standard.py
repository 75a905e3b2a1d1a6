"""What holds where a page says nothing."""

from __future__ import annotations

PER_METRE = 100.0
"""Page units in a metre."""
DENSITY = 1.0
"""kg per m² of area, of a solid of which nothing is said: a ball of 50 units across weighs 0.2 kg."""
GRAVITY = 9.81
"""m/s², unless the page says otherwise."""
