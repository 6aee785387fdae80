"""`make docs`: writes the pages that are made from the code."""

from __future__ import annotations

from tests.docs.troubleshooting import PAGE, page

PAGE.write_text(page(), encoding="utf-8", newline="\n")
print(f"written: {PAGE}")
