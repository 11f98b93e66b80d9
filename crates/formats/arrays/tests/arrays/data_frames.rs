//! Tests of pandas data frames in the fixed format (`tests/data/pandas/make.py`). Blocks of columns become separate arrays.

use taceva_arrays::{ArrayFile, ArrayFormat, ArrayValues};

use crate::digest::at;

fn opened(name: &str) -> ArrayFile {
    ArrayFile::open(&at(name), ArrayFormat::Hdf5).expect("opens")
}

fn values(file: &ArrayFile, name: &str) -> ArrayValues {
    let rows = file.find(name).expect(name).rows();
    file.read(name, 0..rows).expect(name).values
}

fn counted(from: impl Fn(f64) -> f64) -> ArrayValues {
    ArrayValues::F64((0..24).map(|k| from(f64::from(k))).collect())
}

#[test]
fn blocks_of_a_data_frame_are_columns_by_their_names() {
    let file = opened("pandas/mixed.h5");
    let mut names = file.names();
    names.sort_unstable();
    let expected = ["Fx", "Fy32", "Fz", "index", "k", "obj", "ok", "t"];
    assert_eq!(names, expected.map(|name| format!("/run/{name}")));
    assert_eq!(values(&file, "/run/Fz"), counted(|k| k * 0.25));
    assert_eq!(values(&file, "/run/Fx"), counted(|k| k * -0.5));
    let objects = (0..24).map(|k| ["cube", "ball"][k % 2].to_owned());
    assert_eq!(
        values(&file, "/run/obj"),
        ArrayValues::Text(objects.collect())
    );
    let times = (0..24).map(|k| 1_700_000_000_000_000_000 + k * 33_000_000);
    assert_eq!(values(&file, "/run/t"), ArrayValues::I64(times.collect()));
    assert_eq!(
        file.attribute("/run/t", "value_type").as_deref(),
        Some("datetime64[ns]")
    );
    // Rows in the middle of a block equal the same rows of a whole reading.
    let middle = file.read("/run/obj", 5..7).expect("read");
    assert_eq!(
        (middle.shape, middle.values),
        (
            vec![2],
            ArrayValues::Text(vec!["ball".into(), "cube".into()])
        )
    );
    let middle = file.read("/run/Fx", 3..5).expect("read");
    assert_eq!(middle.values, ArrayValues::F64(vec![-1.5, -2.0]));
}

#[test]
fn data_frames_in_groups_and_with_numbered_columns_are_columns_too() {
    let file = opened("pandas/two.h5");
    assert_eq!(
        file.names(),
        ["/lab/day1/index", "/lab/day1/Fx", "/lab/day1/Fz"]
    );
    assert_eq!(values(&file, "/lab/day1/Fz"), counted(|k| k * 0.25));
    let file = opened("pandas/numbered.h5");
    assert_eq!(values(&file, "/f/2"), counted(|k| k * 3.0 + 2.0));
    let file = opened("pandas/timed.h5");
    assert_eq!(
        file.attribute("/run/index", "kind").as_deref(),
        Some("datetime64[us]")
    );
}

#[test]
fn data_frames_that_are_cut_or_have_levels_are_refused_with_the_way_out() {
    for (name, group, words) in [
        (
            "pandas/cut.h5",
            "/run",
            ["block 1 of 2 is not", "to_parquet"],
        ),
        ("pandas/levels.h5", "/f", ["several levels", "\"_\".join"]),
    ] {
        let file = opened(name);
        assert_eq!(file.names(), [""; 0], "{name}");
        let [(refused, reason)] = file.unread_arrays().try_into().expect("one");
        assert_eq!(refused, group);
        let asked = file
            .read(&format!("{group}/Fz"), 0..1)
            .expect_err("refused");
        for word in words {
            assert!(reason.contains(word), "{reason}");
            assert!(asked.to_string().contains(word), "{asked}");
        }
    }
}
