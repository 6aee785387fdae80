"""What was made once is kept, by what it was made of; it knows keys and bytes, no stages."""
