"""Real drawings with known centre lines, where the corpus is at hand."""

from __future__ import annotations

import warnings

import pytest

from tests.bench.drawing import CORPUS, SIZE_MM, evaluator, graph, pictures
from wrapit.config import TracingConfig
from wrapit.drawing.stage import trace

if not (CORPUS / "evaluate.py").exists():
    pytest.skip("the corpus of drawings is not here; set WRAPIT_CORPUS", allow_module_level=True)

CHOSEN = (
    "lucide_anchor",
    "openmoji_bee",
    "openmoji_bee@scan",
    "tabler_cat",
    "tabler_gemini",
    "tabler_gemini@blur",
)


@pytest.mark.parametrize("name", CHOSEN)
def test_a_real_drawing_comes_out_right(name):
    ((_, path, truth, _),) = (picture for picture in pictures() if picture[1].stem == name)
    drawing, _ = trace(path, TracingConfig(), SIZE_MM)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        scores = evaluator().evaluate(graph(drawing), truth)
    assert scores["topology_matched"]
    assert scores["mean_distance_sw"] < 0.03
    assert scores["tangent_error_deg_median"] < 0.8
