"""What goes through the plate: start holes with slots for the tails, holes for pins."""
