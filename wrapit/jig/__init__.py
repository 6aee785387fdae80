"""The jig: planned without a kernel, then built as exact solids."""
