"""The proven optimum of drawings whose closed loops share no segment."""
