//! Properties of the sensor derived from a recording, and reasons for missing properties.

use super::*;

#[test]
fn a_recording_states_its_frame_rate_and_its_field_of_view() {
    let corner = |x: f64, y: f64, force: f64| pair(&[x, y, force], &[0.0; 3]);
    let digest = |digest: &str, sample: Sample| sample.with_frame_digest(digest.to_owned());
    let samples = [
        digest("p", timed(10.0, corner(-2.0, -1.0, 0.5))),
        digest("p", timed(10.5, corner(2.0, -1.0, 0.5))),
        digest("q", timed(11.0, corner(2.0, 1.0, 0.02))),
        digest("r", timed(11.5, corner(-2.0, 1.0, 0.5))),
        digest("s", timed(12.5, corner(9.0, 9.0, 0.019))),
    ];
    let evaluation = evaluate("intrinsic", &["Px", "Py", "Fz"], &samples);
    let value = |label| scalar(&evaluation, "intrinsic", label);
    assert_eq!(value("frame_rate").to_bits(), 2.0_f64.to_bits());
    assert_eq!(value("jitter").to_bits(), 0.0_f64.to_bits());
    assert_eq!((value("dropped"), value("duplicated")), (0.25, 0.25));
    assert_eq!(value("field_of_view").to_bits(), 8.0_f64.to_bits());
    assert_eq!(
        said(&evaluation, "intrinsic", "resolution"),
        "the sensor's `frame_size` is not declared"
    );
    let interval = score(&evaluation, "intrinsic", "frame_rate").interval;
    assert!(
        matches!(interval, Interval::Undefined(reason) if reason.to_string() == "no interval is defined")
    );
}

#[test]
fn without_times_or_with_equal_ones_there_is_no_rate() {
    let sample = || pair(&[0.0, 0.0, 0.0], &[0.0; 3]);
    let said = |samples: &[Sample], label| {
        said(
            &evaluate("intrinsic", &["Px", "Py", "Fz"], samples),
            "intrinsic",
            label,
        )
    };
    assert_eq!(said(&[sample(), sample()], "frame_rate"), "no time stamps");
    assert_eq!(
        said(&[timed(1.0, sample())], "frame_rate"),
        "fewer than 2 samples"
    );
    let equal = [timed(1.0, sample()), timed(1.0, sample())];
    assert_eq!(said(&equal, "frame_rate"), "equal time stamps");
    assert_eq!(
        said(&equal, "duplicated"),
        "no successive digests of frames"
    );
    assert_eq!(
        said(&equal, "field_of_view"),
        "no sample in contact has a place"
    );
}
