//! Exact sums, independent of the order of the readings.

use std::collections::BTreeSet;

use super::example::{Row, readings, settings, study_of};

fn hundredths(row: &Row) -> i64 {
    #[expect(clippy::cast_possible_truncation, reason = "the readings are whole")]
    let whole = row.value as i64;
    whole
}

#[test]
fn sums_of_squares_are_the_nearest_numbers_to_the_rationals() {
    // In hundredths the readings are integers, and so are all sums: N = 90, o = 3, p = 10, r = 3.
    let all = readings(100.0);
    let report = study_of(&all).analyse(&settings(|_| {})).expect("a report");
    let sum_of = |rows: &dyn Fn(&Row) -> bool| -> i64 {
        all.iter().filter(|row| rows(row)).map(hundredths).sum()
    };
    let parts: BTreeSet<&String> = all.iter().map(|row| &row.part).collect();
    let operators: BTreeSet<&String> = all.iter().map(|row| &row.operator).collect();
    let squares: i64 = all.iter().map(|row| hundredths(row).pow(2)).sum();
    let total = sum_of(&|_| true).pow(2);
    let (mut of_parts, mut of_operators, mut of_cells) = (0, 0, 0);
    for part in &parts {
        of_parts += sum_of(&|row| row.part == **part).pow(2);
        for operator in &operators {
            of_cells += sum_of(&|row| row.part == **part && row.operator == **operator).pow(2);
        }
    }
    for operator in &operators {
        of_operators += sum_of(&|row| row.operator == **operator).pow(2);
    }
    // Over the common divisor 90.
    let expected = [
        3 * of_operators - total,
        10 * of_parts - total,
        30 * of_cells - 3 * of_operators - 10 * of_parts + total,
        90 * squares - 30 * of_cells,
    ];
    for (row, above) in report.table.iter().zip(expected) {
        assert_eq!(
            row.ss.to_bits(),
            (above as f64 / 90.0).to_bits(),
            "{:?}",
            row.source
        );
        let mean = above as f64 / (90 * row.df) as f64;
        assert_eq!(
            row.ms.map(f64::to_bits),
            Some(mean.to_bits()),
            "{:?}",
            row.source
        );
    }
}

#[test]
fn the_order_of_readings_and_the_division_into_studies_change_no_bit() {
    let all = readings(1.0);
    let expected = study_of(&all).analyse(&settings(|_| {})).expect("a report");
    let mut turned = all.clone();
    turned.reverse();
    turned.rotate_left(31);
    let mut study = study_of(&turned[..40]);
    study.merge(&study_of(&turned[40..]));
    let found = study.analyse(&settings(|_| {})).expect("a report");
    assert_eq!(found, expected);
}
