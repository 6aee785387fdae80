"""The stages from Python: a drawing, its wires, and what to cut.

Run it with `python examples/from_python.py`.
"""

from __future__ import annotations

from pathlib import Path

from wrapit import decompose, draw_wires, load_config, trace

CONFIGS = Path(__file__).parent.parent / "configs"


def main() -> None:
    config = load_config(CONFIGS / "butterfly.yaml", ["size=45 mm"])
    drawing, _ = trace(CONFIGS / config.drawing, config)
    print(f"{len(drawing.segments)} segments between {len(drawing.junctions)} junctions")
    solution, _ = decompose(drawing, config)
    print(f"{solution.energy.complexity} wires, {solution.energy.smoothness_rad:.2f} rad of bends in all")
    wires, findings = draw_wires(solution, config)
    for wire in wires:
        print(f"{wire.name}: cut {wire.cut_length_mm:.0f} mm, {len(wire.turns)} turns")
    for finding in findings:
        print(f"{finding.level}: {finding.where}: {finding.message}")


if __name__ == "__main__":
    main()
