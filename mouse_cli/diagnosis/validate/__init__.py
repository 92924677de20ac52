"""Whether it is true: data that no fit has seen, and what to measure next where two answers are left."""
