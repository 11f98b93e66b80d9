"""How well does a vision-based tactile sensor measure?

Exact metrics with intervals over arrays, recordings on disk, and models, with the same results as the command ``taceva``.

>>> import numpy as np
>>> import taceva
>>> truth = np.array([0.25, 0.50, 1.00])
>>> result = taceva.score(truth, truth + 0.125, channels=["Fz"], independent=True)
>>> result["mae", "Fz"].value
0.125
"""

from taceva import bundle, tasks
from taceva._bar import progress
from taceva._compare import Comparison, compare
from taceva._dataset import Dataset, Rows, Samples, open
from taceva._evaluate import evaluate
from taceva._figure import Figure
from taceva._function_score import score_function
from taceva._inventory import FoundPlugin, metrics, models, plugins
from taceva._metrics import SIX, TactileMetrics, score, score_tables
from taceva._metrology import Budget, CalibrationCurve, GaugeStudy, budget, curve, gauge
from taceva._monitor import Alarm, Monitor
from taceva._onnx import OnnxModel, onnx
from taceva._record import from_arrays, import_recording
from taceva._report import report
from taceva._result import Interval, Result, Score, load
from taceva._taceva import DatasetError, ModelError
from taceva._taceva import version as _version

__version__: str = _version()

__all__ = [
    "SIX",
    "Alarm",
    "Budget",
    "CalibrationCurve",
    "Comparison",
    "Dataset",
    "DatasetError",
    "Figure",
    "FoundPlugin",
    "GaugeStudy",
    "Interval",
    "ModelError",
    "Monitor",
    "OnnxModel",
    "Result",
    "Rows",
    "Samples",
    "Score",
    "TactileMetrics",
    "budget",
    "bundle",
    "compare",
    "curve",
    "evaluate",
    "from_arrays",
    "gauge",
    "import_recording",
    "load",
    "metrics",
    "models",
    "onnx",
    "open",
    "plugins",
    "progress",
    "report",
    "score",
    "score_function",
    "score_tables",
    "tasks",
]
