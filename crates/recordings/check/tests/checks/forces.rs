//! Tests of forces that freeze, forces that are clipped at a limit, and forces stored in one byte.

use taceva_check::CheckReport;

use super::lab::{SENSOR, imported};
use super::streams::{message, says_nothing};
use super::{Recording, picture, readings};

/// Report on a recording with the normal forces `force`, after `change`.
fn with_forces(force: impl Fn(u32) -> f64, change: impl FnOnce(&mut Recording)) -> CheckReport {
    let mut recording = Recording::sound();
    for (number, sample) in (0..).zip(&mut recording.samples) {
        readings(sample, |channel, value| match channel {
            2 => Some(force(number)),
            _ => Some(value),
        });
    }
    change(&mut recording);
    recording.check("")
}

/// Different forces from 1 N to 2.99 N.
fn forces(number: u32) -> f64 {
    1.0 + 0.01 * f64::from(number * 37 % 200)
}

fn stuck(number: u32) -> f64 {
    if number < 100 { forces(number) } else { 1.255 }
}

#[test]
fn a_force_that_stands_still_in_half_of_the_samples_while_pictures_change_is_stuck() {
    let report = with_forces(stuck, |_| {});
    assert_eq!(
        message(&report, "TAC009"),
        "Fz is 1.255 N in 100 of 200 samples in succession, although their pictures differ; Fz changes elsewhere"
    );
    says_nothing(&with_forces(forces, |_| {}), "TAC009");
}

#[test]
fn a_force_that_is_held_stands_still_with_its_pictures_or_is_zero_is_not_stuck() {
    // Each press has one force.
    says_nothing(&with_forces(|number| forces(number / 20), |_| {}), "TAC009");
    let still = with_forces(stuck, |recording| {
        let frame = recording.samples[100].frame.clone();
        for sample in &mut recording.samples[100..] {
            sample.frame = frame.clone();
        }
    });
    says_nothing(&still, "TAC009");
    let at_rest = |number: u32| if number < 100 { forces(number) } else { 0.0 };
    says_nothing(&with_forces(at_rest, |_| {}), "TAC009");
}

#[test]
fn a_force_that_is_cut_in_a_third_of_the_samples_is_stuck_at_its_limit() {
    let report = with_forces(|number| forces(number).min(2.305), |_| {});
    assert_eq!(
        message(&report, "TAC009"),
        "Fz ends at 2.305 N in 69 of 200 samples, over 3 times as many as at any other value: Fz is clipped there"
    );
    let pulled = with_forces(|number| -forces(number).min(2.305), |_| {});
    assert!(message(&pulled, "TAC009").starts_with("Fz ends at -2.305 N in 69 of 200"));
    // Commanded levels, and the least force, which may be that at rest.
    let levels = |number: u32| f64::from(1 + number % 4);
    says_nothing(&with_forces(levels, |_| {}), "TAC009");
    says_nothing(
        &with_forces(|number| forces(number).max(1.505), |_| {}),
        "TAC009",
    );
}

/// Report on presses from 0 to 1.5 N and back, whose forces are changed by `read`, after `rest` samples at rest.
fn of_presses(rest: u32, read: impl Fn(f64) -> f64) -> CheckReport {
    let press = |number: u32| match number < rest {
        true => 0.0,
        false => 1.5 * (1.0 - (f64::from(number % 40) / 20.0 - 1.0).abs()),
    };
    with_forces(
        |number| read(press(number)),
        |recording| {
            for (number, sample) in (0..).zip(&mut recording.samples) {
                sample.frame = Some(picture(number, press(number)));
            }
        },
    )
}

#[test]
fn a_force_that_is_zero_below_a_threshold_differs_from_rest_by_its_pictures() {
    let below = |force: f64| if force < 0.6 { 0.0 } else { force };
    let report = of_presses(0, below);
    let found = message(&report, "TAC027");
    assert!(
        found.starts_with("Fz is exactly 0 in 80 samples, but "),
        "{found}"
    );
    // A force clipped at zero behind an offset, too.
    let clipped = |force: f64| (force - 0.7).max(0.0);
    message(&of_presses(0, clipped), "TAC027");
    // Rest, and the ends of presses.
    says_nothing(&of_presses(80, |force| force), "TAC027");
    says_nothing(&of_presses(0, |force| force), "TAC027");
}

/// Report on 120 forces with 0.1 N per count, in presses of 40 samples. The map names the presses if `by_press`.
fn in_counts(count: impl Fn(i32) -> i32, by_press: bool) -> CheckReport {
    let rows = (0..120).map(|row| format!("{},{}\n", row / 40, count(row)));
    let table = format!("press,counts\n{}", rows.collect::<String>());
    let ids = match by_press {
        true => "[ids]\npoint_id = \"press\"\n",
        false => "",
    };
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"counts\", unit = \"N\", scale = 0.1 }}\n{ids}[time]\nclock = \"unknown\"\n{SENSOR}"
    );
    imported(&[("t.csv", table.into_bytes())], &map, &["TAC045"])
}

#[test]
fn a_slow_force_that_begins_anew_above_one_byte_is_named_with_its_row() {
    let unsigned = in_counts(|row| 3 * row % 256, false);
    assert_eq!(
        message(&unsigned, "TAC045"),
        "Fz has at most 256 values, 0.100 N apart, but jumps by more than 200 such steps between 1 pair of neighbours, first in row 87: forces \
         beyond one byte may lack their upper byte"
    );
    let signed = in_counts(|row| (3 * row + 128) % 256 - 128, false);
    assert!(message(&signed, "TAC045").contains("first in row 44"));
}

#[test]
fn forces_of_two_bytes_fast_ones_and_those_of_other_presses_do_not_begin_anew() {
    says_nothing(&in_counts(|row| 3 * row, false), "TAC045");
    says_nothing(&in_counts(|row| 97 * row % 256, false), "TAC045");
    let ramps = |row: i32| {
        row % 40 * 6
            + match row / 40 {
                0 => 16,
                1 => 0,
                _ => 1,
            }
    };
    assert!(message(&in_counts(ramps, false), "TAC045").contains("1 pair"));
    says_nothing(&in_counts(ramps, true), "TAC045");
}

#[test]
fn a_sudden_release_and_a_repeated_staircase_do_not_begin_anew() {
    let still = |row: i32| {
        if row < 84 { 3 * row + row % 2 } else { 0 }
    };
    says_nothing(&in_counts(still, false), "TAC045");
    let noisy = |row: i32| if row < 84 { 3 * row } else { row % 2 };
    says_nothing(&in_counts(noisy, false), "TAC045");
    let staircase = |row: i32| row % 40 * 6 + row / 40;
    says_nothing(&in_counts(staircase, false), "TAC045");
    // A force that falls below zero begins anew, too.
    let falling = |row: i32| (300 - 3 * row).rem_euclid(256);
    message(&in_counts(falling, false), "TAC045");
}

/// Report on the tables `names` with 500 forces. In the last table, forces from row `far` (from 0) are far from the others.
fn with_far_forces(names: &[&str], far: u32) -> CheckReport {
    let table = |is_last: bool| {
        let force = |row: u32| match is_last && row >= far {
            true => 60.0 + 0.001 * f64::from(row),
            false => 0.01 * f64::from(row),
        };
        let rows = (0..500).map(|row| format!("{}\n", force(row)));
        format!("Fz\n{}", rows.collect::<String>()).into_bytes()
    };
    let last = names.last();
    let files = names.iter().map(|name| (*name, table(Some(name) == last)));
    let files: Vec<(&str, Vec<u8>)> = files.collect();
    let map = format!(
        "map_version = 2\ntable = \"*.csv\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\nclock = \"unknown\"\n{SENSOR}"
    );
    imported(&files, &map, &["TAC013"])
}

#[test]
fn far_labels_without_files_of_pictures_are_left_out_by_their_rows() {
    let line = |report: &CheckReport| {
        let found = message(report, "TAC013").split_once("; to leave ");
        found.expect("a line").1.to_owned()
    };
    assert_eq!(
        line(&with_far_forces(&["a.csv"], 498)),
        "them out, write under [drop] of the map: rows = [499, 500]"
    );
    assert_eq!(
        line(&with_far_forces(&["a.csv", "b.csv"], 499)),
        "them out, write under [drop] of the map: rows = [{ row = 500, table = \"b.csv\" }]"
    );
    // Of many, the first are in a line that a map takes.
    let many = line(&with_far_forces(&["a.csv"], 479));
    assert!(
        many.starts_with("the first 20 of them out") && many.ends_with(", 498, 499]"),
        "{many}"
    );
}
