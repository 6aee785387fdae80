"""Test pieces whose measurements go into the config."""

from __future__ import annotations

import tempfile
from pathlib import Path

from wrapit.config import Config
from wrapit.errors import ExportError
from wrapit.jig.coupons import PrintedCoupon, clearance_coupon, kerf_coupon
from wrapit.pipeline.worker import Worker

# Two flat plates of a few walls take a second or two; this is for a machine that is busy or slow.
TIMEOUT_S = 120.0


def write_coupons(config: Config, folder: Path) -> tuple[Path, Path]:
    """`coupon-kerf.dxf` for the laser and `coupon-clearance.stl` for the printer, for the config's wire.

    Raises ExportError when they can't be written.
    """
    from wrapit.exports.plate_dxf import write_dxf

    plate = config.plate
    contours = kerf_coupon(config.wire.gauge, plate).contours
    coupon = clearance_coupon(config.wire.gauge, config.jig)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=folder, prefix=".coupon") as partial, Worker() as worker:
            cut, printed = Path(partial) / "coupon-kerf.dxf", Path(partial) / "coupon-clearance.stl"
            write_dxf(cut, contours, plate.profile, plate.curves, plate.tolerance)
            tolerance_mm = config.jig.stl_tolerance
            worker.result(worker.start("coupon", TIMEOUT_S, write_printed, coupon, printed, tolerance_mm))
            return cut.replace(folder / cut.name), printed.replace(folder / printed.name)
    except OSError as error:
        problem = f"can't write here ({error.strerror})"
        raise ExportError(problem, str(folder), "choose another folder with -o") from None


def write_printed(coupon: PrintedCoupon, path: Path, tolerance_mm: float) -> None:
    """The printed coupon's STL; runs in the kernel's process."""
    from wrapit.kernel.files import write_stl
    from wrapit.kernel.terraces import Terrace, terraced_solid

    terraces = [Terrace(region, top_mm) for region, top_mm in coupon.terraces]
    made = terraced_solid(coupon.base.outer, 0.0, coupon.base_mm, terraces, coupon.base.holes, path.name)
    write_stl(path, [made.solid], tolerance_mm)
