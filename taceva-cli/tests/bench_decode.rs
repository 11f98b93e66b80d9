//! Frames are decoded at fractions of their size, and a model is fitted at each.

mod schema;
mod support;

use support::Bench;

#[test]
fn decoding_is_raced_on_jpeg_frames_of_the_simulated_bench() {
    let bench = Bench::new();
    let race = bench.json("bench decode --quick --model ridge:size=12x12 --svg decode.svg");
    schema::check("bench-decode", &race);
    assert_eq!(race["subject"], "decode");
    assert_eq!(race["recording"]["source"], "simulated");
    let note = race["note"].as_str().expect("said");
    assert!(
        note.contains("rounded to 8 bits and encoded as JPEG"),
        "{note}"
    );
    let rows = race["rows"].as_array().expect("rows");
    let denominators = rows.iter().map(|row| row["denominator"].as_u64());
    assert_eq!(denominators.collect::<Vec<_>>(), [1, 2, 4, 8].map(Some));
    let width = |row: usize| rows[row]["width"].as_u64().expect("pixels");
    assert_eq!(width(1), width(0).div_ceil(2));
    assert_eq!(width(3), width(0).div_ceil(8));
    for row in rows {
        assert!(row["decode_s"].as_f64().is_some_and(|time| time > 0.0));
    }
    assert!(rows[0]["errors"][0]["change"].is_null());
    // Half as many pixels each way are still more than the features ask for.
    let half = &rows[1]["errors"][0];
    let change = half["change"].as_f64().expect("a number");
    let apart = half["mae"].as_f64().expect("a number")
        - rows[0]["errors"][0]["mae"].as_f64().expect("a number");
    assert!((change - apart).abs() < 1e-12, "{change} {apart}");
    let drawing = std::fs::read_to_string(bench.path("decode.svg")).expect("written");
    assert!(drawing.starts_with("<svg ") && drawing.contains("1/2"));
}

#[test]
fn a_dataset_of_png_is_refused_and_says_what_it_is() {
    let bench = Bench::new();
    bench.record("data", 64);
    bench.refused(
        "bench decode data",
        3,
        "a PNG or TIFF, which is decoded at its full size only",
    );
    bench.refused("bench decode data --model rigde", 2, "did you mean `ridge`");
}
