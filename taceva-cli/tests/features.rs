//! What a model sees is chosen by settings.

mod support;

use support::Bench;

#[test]
fn kinds_of_features_are_chosen_by_a_setting() {
    let bench = Bench::new();
    bench.record("data", 64);
    let found =
        bench.json("evaluate data --model ridge --set features=pixels+statistics --metrics mae");
    let model = &found["provenance"]["model"];
    assert_eq!(
        model["settings"]["features"], "8×8 gray pixels+statistics",
        "{model}"
    );
    bench.refused(
        "evaluate data --model ridge --set features=smells",
        2,
        "expected pixels, markers, gradients, statistics, or several joined by +",
    );
    // The recording is of a gel in gray, and nobody kept an untouched frame of it.
    for kind in ["markers", "gradients"] {
        bench.refused(
            &format!("evaluate data --model ridge --set features={kind}"),
            3,
            "needs a no-contact reference frame, and the recording names none",
        );
    }
}
