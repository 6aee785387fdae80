"""The files of the test pieces that measure kerf, fit and clearance."""

from __future__ import annotations

from pathlib import Path

from wrapit.config import JigConfig, PlateConfig
from wrapit.exports.plate_dxf import write_dxf
from wrapit.jig.laser_coupon import clearance_coupon, kerf_coupon

PRINTED, CUT = "coupon-clearance.stl", "coupon-kerf.dxf"


def write_coupons(
    folder: Path, diameter_mm: float, jig_config: JigConfig, plate_config: PlateConfig
) -> tuple[Path, Path]:
    """The clearance coupon to print (STL) and the kerf coupon to cut (DXF), for this wire.

    Raises JigError when the wire is too thin, KernelError or ExportError when a file can't be made.
    """
    from wrapit.kernel.files import write_stl
    from wrapit.kernel.terraces import Terrace, terraced_solid

    cut = kerf_coupon(diameter_mm, plate_config)
    write_dxf(folder / CUT, cut.contours, plate_config.profile, plate_config.curves, plate_config.tolerance)
    printed = clearance_coupon(diameter_mm, jig_config)
    terraces = [Terrace(region, top_mm) for region, top_mm in printed.terraces]
    body = terraced_solid(printed.base.outer, 0.0, printed.base_mm, terraces, (), "clearance coupon")
    write_stl(folder / PRINTED, [body.solid], jig_config.stl_tolerance)
    return folder / PRINTED, folder / CUT
