"""Which pieces need no build: their folders hold what would be built."""

from __future__ import annotations

from pathlib import Path

from wrapit.batch.model import Piece


def is_up_to_date(piece: Piece, folder: Path) -> bool:
    """Whether a folder holds a whole build of this config and drawing by this version; starts nothing."""
    from wrapit.pipeline import report as reports
    from wrapit.pipeline.output.ownership import is_whole, own_report, sha256
    from wrapit.pipeline.work import STAGES

    report = own_report(folder)
    if report is None or piece.config is None or report.get("until") != STAGES[-1]:
        return False
    drawing = piece.config_path.parent / piece.config.drawing
    try:
        if not drawing.is_file():
            return False
        head = reports.head(piece.config, sha256(drawing))
        return all(report.get(key) == head[key] for key in reports.HEAD_KEYS) and is_whole(folder, report)
    except OSError:  # the drawing or a file of the folder can't be read: its build will say so
        return False
