//! Tests of a transducer whose zero drifts while pictures without contact are unchanged.

use taceva_check::CheckReport;

use super::lab::{PICTURES, SENSOR, column, imported, pictures};
use super::streams::{message, says_nothing};

const STEPPED: &str = include_str!("../cases/10-zero-stepped/labels.csv");

fn map(columns: &str, time: &str) -> String {
    format!(
        "map_version = 2\ntable = \"labels.csv\"\n{PICTURES}[columns]\n{columns}\n{time}\n{SENSOR}"
    )
}

const TIMED: &str = "[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n";
const FZ: &str = "Fz = { from = \"fz\", unit = \"N\" }";

#[test]
fn a_transducer_that_was_zeroed_anew_half_way_is_a_step_of_untouched_pictures() {
    let times = column(STEPPED, "t");
    let forces = column(STEPPED, "fz");
    let presses: Vec<f64> = forces
        .iter()
        .zip(&times)
        .map(|(force, time)| if *time > 30.0 { force - 1.5 } else { *force })
        .collect();
    let files = [
        ("labels.csv", STEPPED.as_bytes().to_vec()),
        ("f.npy", pictures(&presses)),
    ];
    let report = imported(&files, &map(FZ, TIMED), &["TAC035"]);
    let said = message(&report, "TAC035");
    let start = "Fz of 30 similar pictures without contact steps from -0.002 N to 1.502 N at ";
    assert!(said.starts_with(start), "{said}");
}

/// Force of sample `number`; three of four samples are pressed.
fn press(number: u32) -> f64 {
    match number % 4 {
        0 => 0.0,
        _ => 0.4 + 0.1 * f64::from(number * 37 % 23),
    }
}

/// Report on 200 samples whose labels of `name` are the force of the press plus `zero`.
fn with_zero(name: &str, time: bool, zero: impl Fn(u32) -> f64) -> CheckReport {
    let header = if time { "t,fz" } else { "fz" };
    let mut table = format!("{header}\n");
    for number in 0..200 {
        let noise = 0.002 * f64::from(number * 7919 % 11);
        let force = press(number) + zero(number) + noise;
        match time {
            true => table += &format!("{},{force:.4}\n", 0.3 * f64::from(number)),
            false => table += &format!("{force:.4}\n"),
        }
    }
    let columns = format!("{name} = {{ from = \"fz\", unit = \"N\" }}");
    // The load is the normal force; a shear alone is seen beside it.
    let columns = match name {
        "Fz" => columns,
        _ => format!("{columns}\nFz = {{ from = \"load\", unit = \"N\" }}"),
    };
    if name != "Fz" {
        let mut lines = table.lines();
        let header = format!("{},load", lines.next().expect("a header"));
        let rows = lines
            .zip(0..)
            .map(|(line, number)| format!("{line},{:.4}", press(number)));
        table = std::iter::once(header)
            .chain(rows)
            .collect::<Vec<_>>()
            .join("\n");
    }
    let presses: Vec<f64> = (0..200).map(press).collect();
    let files = [
        ("labels.csv", table.into_bytes()),
        ("f.npy", pictures(&presses)),
    ];
    let time = if time {
        TIMED
    } else {
        "[time]\nclock = \"unknown\"\n"
    };
    imported(&files, &map(&columns, time), &["TAC035"])
}

#[test]
fn a_zero_that_creeps_is_a_drift_and_one_that_stays_is_none() {
    let report = with_zero("Fz", true, |number| 0.004 * f64::from(number));
    let said = message(&report, "TAC035");
    assert!(said.contains("drifts by 0.7"), "{said}");
    says_nothing(&with_zero("Fz", true, |_| 0.0), "TAC035");
    says_nothing(&with_zero("Fz", true, |_| 0.1), "TAC035");
}

#[test]
fn a_zero_of_rows_without_times_steps_at_a_row() {
    let step = |number: u32| if number < 120 { 0.0 } else { -0.6 };
    let report = with_zero("Fz", false, step);
    let said = message(&report, "TAC035");
    assert!(said.contains("at row 121: the zero has moved"), "{said}");
}

#[test]
fn a_zero_that_steps_in_a_press_is_seen_at_the_next_picture_without_contact() {
    // Sample 122 is the second of three in one press.
    let step = |number: u32| if number < 122 { 0.0 } else { -0.6 };
    let report = with_zero("Fz", false, step);
    let said = message(&report, "TAC035");
    assert!(said.contains("at row 125: the zero has moved"), "{said}");
}

#[test]
fn a_shear_force_that_is_zeroed_anew_steps_beside_a_sound_normal_force() {
    let step = |number: u32| if number < 60 { 0.0 } else { 0.35 };
    let report = with_zero("Fx", true, step);
    let said = message(&report, "TAC035");
    assert!(said.starts_with("Fx of 50 similar pictures"), "{said}");
    assert!(!said.contains("Fz"), "{said}");
}

#[test]
fn light_contacts_that_a_depth_shows_are_no_untouched_pictures() {
    // Presses, and from the middle on light contacts between them, which pictures hardly show.
    let is_light = |number: u32| number >= 100 && number.is_multiple_of(2);
    let row = |number: u32| {
        let [force, depth] = match is_light(number) {
            true => [0.46, 0.2],
            false => [press(number), 0.25 * press(number)],
        };
        let noise = 0.002 * f64::from(number * 7919 % 11);
        format!(
            "{},{:.4},{depth:.4}\n",
            0.3 * f64::from(number),
            force + noise
        )
    };
    let table = format!("t,fz,z\n{}", (0..200).map(row).collect::<String>());
    let presses = (0..200).map(|number| match is_light(number) {
        true => 0.02,
        false => press(number),
    });
    let files = [
        ("labels.csv", table.into_bytes()),
        ("f.npy", pictures(&presses.collect::<Vec<f64>>())),
    ];
    let depth = format!("{FZ}\nPz = {{ from = \"z\", unit = \"mm\" }}");
    says_nothing(
        &imported(&files, &map(&depth, TIMED), &["TAC035"]),
        "TAC035",
    );
    // Without a label of depth nobody knows.
    let report = imported(&files, &map(FZ, TIMED), &["TAC035"]);
    let said = message(&report, "TAC035");
    assert!(
        said.contains("similar pictures without contact steps from"),
        "{said}"
    );
}
