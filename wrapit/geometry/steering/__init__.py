"""The path nearest to a curve that bends within a bound: a car's, whose wheels turn only so far."""
