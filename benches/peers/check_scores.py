"""Compares our scores with scikit-learn's on our own predictions.

usage: python3 benches/peers/check_scores.py DATASET MODEL

`taceva predict` writes the predictions and the truth, scikit-learn scores them, and MAE and R² of `taceva score` and of
`taceva evaluate` must agree to 1e-12 relative. Exit code 1 if one does not. An R² within 0.1 of zero is compared through
1 - R² = SSE/SST, which is what both compute: near zero the subtraction leaves few of the peer's rounded digits.
"""
import pathlib
import sys
import tempfile

from common import evaluation, need, run

TOLERANCE = 1e-12


def main(dataset, model):
    need("pandas", "sklearn")
    import pandas
    from sklearn.metrics import mean_absolute_error, r2_score

    with tempfile.TemporaryDirectory() as folder:
        truth_csv, pred_csv = pathlib.Path(folder, "truth.csv"), pathlib.Path(folder, "pred.csv")
        run("predict", dataset, "--no-cache", "--with", model, "--out", pred_csv, "--truth-out", truth_csv, "--quiet")
        scored = evaluation("score", "--truth", truth_csv, "--pred", pred_csv)["metrics"]
        evaluated = evaluation("evaluate", dataset, "--no-cache", "--with", model)["metrics"]
        truth = pandas.read_csv(truth_csv, dtype={"sample": str, "point_id": str})
        pred = pandas.read_csv(pred_csv, dtype={"sample": str})

    assert list(truth["sample"]) == list(pred["sample"]), "the two tables hold the same samples"
    channels = [name for name in pred.columns if name in scored["mae"]]
    assert channels, "there is something to compare"
    worst = 0.0
    for channel in channels:
        both = truth[channel].notna() & pred[channel].notna()
        y, yhat = truth[channel][both], pred[channel][both]
        for metric, theirs in (("mae", mean_absolute_error(y, yhat)), ("r2", r2_score(y, yhat))):
            for source, ours in (("score", scored), ("evaluate", evaluated)):
                value = ours[metric][channel]["value"]
                near_zero = metric == "r2" and abs(theirs) < 0.1
                difference = abs(value - theirs) / (abs(1 - theirs) if near_zero else max(abs(theirs), 1e-300))
                worst = max(worst, difference)
                verdict = "ok" if difference <= TOLERANCE else "DIFFERS"
                print(f"{metric:4} {channel:12} {source:8} ours {value!r:24} scikit-learn {float(theirs)!r:24} {difference:.1e} {verdict}")
    print(f"{len(channels)} channels, {len(y)} samples, worst relative difference {worst:.1e}")
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
