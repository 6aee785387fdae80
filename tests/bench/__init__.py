"""Benchmarks: what is measured is made, not recalled."""

import os

os.environ["WRAPIT_CACHE"] = "off"
