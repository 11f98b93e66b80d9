//! Tables whose samples are independent: each is a cluster, named by its key.

use super::Tables;

/// 40 rows with two distinct pairs of truth and prediction; `front` is the cell before each force.
fn table(header: &str, front: impl Fn(u32) -> String, error: f64) -> String {
    let row = |row: u32| {
        let force = f64::from(row % 2) + error * f64::from(1 + row % 2);
        format!("{}{force}\n", front(row))
    };
    let rows: String = (0..40).map(row).collect();
    format!("{header}\n{rows}")
}

/// Method of the interval of the error of Fz, or the reason why there is none.
fn interval(header: &str, front: impl Fn(u32) -> String) -> String {
    let [truth, prediction] = [0.0, 0.25].map(|error| table(header, &front, error));
    let mut tables = Tables::new(&truth, &prediction);
    tables.request.is_independent = true;
    let scored = tables.scored();
    let score = scored.report.score("mae", "Fz").expect("scored");
    format!("{:?}", score.interval)
}

#[test]
fn samples_of_equal_numbers_count_one_by_one_where_a_key_names_them() {
    let keyed = interval("sample,Fz", |row| format!("press {row},"));
    assert!(keyed.contains("G=40"), "{keyed}");
    // Without names, rows of equal numbers are one cluster, so that no order changes a score.
    let unnamed = interval("Fz", |_| String::new());
    assert!(!unnamed.contains("G="), "{unnamed}");
}
