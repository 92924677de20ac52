"""Where a cause may be: bars, the lines they make, points on them, and the channels through which a force acts there."""
