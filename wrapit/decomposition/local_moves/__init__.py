"""A matching that changes by local moves: what annealing and the repair of an answer have in common."""
