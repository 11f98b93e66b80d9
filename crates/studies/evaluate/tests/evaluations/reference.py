"""Computes the scikit-learn scores in `taxels.rs` for the synthetic recording of `taxel_drawing.rs`.

Run it with scikit-learn and numpy; it prints the R² of each model on the last fifth, fitted on the first four fifths.
"""

import numpy
import sklearn
from sklearn.linear_model import Ridge
from sklearn.metrics import r2_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

ROWS, REST = 10_800, 40


def draws():
    state = 1
    while True:
        state = (state * 6_364_136_223_846_793_005 + 1_442_695_040_888_963_407) % 2**64
        yield (state >> 32) / 2_147_483_648.0 - 1.0


def recording():
    draw = draws()
    forces, signals = [], []
    for row in range(ROWS):
        drawn = 5.0 + 5.0 * next(draw)
        force = 0.0 if row < REST else drawn
        values = []
        for place in range(15):
            line = (place + 1.0) * force
            bend = (7.0 - place) * force * force / 16.0
            noise = 2.0 * next(draw)
            values.append(300.0 + line + bend + noise)
        forces.append(force)
        signals.append(values)
    # Stored in single precision, computed in double precision.
    return numpy.array(forces), numpy.array(signals, dtype=numpy.float32).astype(float)


forces, signals = recording()
learnt = ROWS * 4 // 5
print("numpy", numpy.__version__, "scikit-learn", sklearn.__version__)
for strength in [1e-3, 1.0]:
    # For standardised features, the mean eigenvalue of the Gram matrix is the number of samples.
    model = make_pipeline(StandardScaler(), Ridge(alpha=strength * learnt, solver="cholesky"))
    model.fit(signals[:learnt], forces[:learnt])
    least, greatest = forces[:learnt].min(), forces[:learnt].max()
    beyond = (greatest - least) / 4
    predicted = model.predict(signals[learnt:]).clip(least - beyond, greatest + beyond)
    print(f"ridge strength={strength}: {r2_score(forces[learnt:], predicted)!r}")
