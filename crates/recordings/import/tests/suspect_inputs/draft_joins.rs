//! Tests of drafts of folders whose tables are joined.

use super::drafts::{filled, with_pictures};
use super::{draft, imported, lab, line};

/// Pictures at 30 Hz, beside a table of forces that grow by 10 N per second, with `rate` rows per second.
fn beside_forces(rate: u32) -> tempfile::TempDir {
    let rows = (0..12).map(|row| format!("{:.6},{row}.png\n", f64::from(row) / 30.0));
    let camera = format!("t,file\n{}", rows.collect::<String>());
    let rows = (0..=rate / 2).map(|row| {
        let time = f64::from(row) / f64::from(rate);
        format!("{time:.3},{:.3},ball\n", 10.0 * time)
    });
    let forces = format!("t,fz,object\n{}", rows.collect::<String>());
    let names: Vec<String> = (0..12).map(|row| format!("{row}.png")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    with_pictures(&[("camera.csv", &camera), ("ft.csv", &forces)], &names)
}

#[test]
fn a_join_of_two_rates_states_both_and_interpolates_the_slower_table() {
    let slow = beside_forces(5);
    let text = draft(slow.path());
    let pick = line(&text, "pick = ");
    assert!(
        pick.starts_with("pick = \"linear\"   # 5 Hz against 30 Hz of the main table: "),
        "{text}"
    );
    // Texts are not interpolated between rows.
    assert!(!text.contains("object = "), "{text}");
    let forces = imported(slow.path(), &filled(&text), "Fz");
    assert_eq!(forces.len(), 12, "{text}");
    for (row, force) in (0..).zip(forces) {
        let expected = f64::from(row) / 3.0;
        assert!((force - expected).abs() < 1e-4, "{force} for {expected}");
    }
    let text = draft(beside_forces(200).path());
    let pick = line(&text, "pick = ");
    assert!(
        pick.starts_with("pick = \"nearest\"   # 200 Hz against 30 Hz of the main table: "),
        "{text}"
    );
    assert!(text.contains("object = \"ft.object\""), "{text}");
}

#[test]
fn a_table_without_a_used_column_is_named_and_not_joined() {
    let files = [
        ("labels.csv", "id,Fz\na,1.5\nb,2.5\nc,0.5\nd,3.5\n"),
        ("log.csv", "id,force_z\na,1.5\nb,2.5\nc,0.5\n"),
    ];
    let text = draft(lab(&files).path());
    assert!(!text.contains("[[join]]"), "{text}");
    assert!(
        text.contains(
            "# Not joined, because no line below uses a column of these tables: \"log.csv\""
        ),
        "{text}"
    );
}

#[test]
fn a_join_of_single_presses_takes_no_row_of_another_press_and_offers_that_of_a_slow_stream() {
    let rows =
        (0..200).map(|row| format!("{:.3},{:.3}\n", f64::from(row) * 0.05, f64::from(row % 7)));
    let forces = format!("t_s,Fz_N\n{}", rows.collect::<String>());
    let rows = (0..5).map(|row| format!("{:.3},{row}.5\n", 0.5 + f64::from(row) * 2.0));
    let robot = format!("t_s,Pz_mm\n{}", rows.collect::<String>());
    let folder = lab(&[("ft.csv", &forces), ("robot.csv", &robot)]);
    let text = draft(folder.path());
    assert!(text.contains("table = \"ft.csv\""), "{text}");
    let pick = line(&text, "pick = ");
    assert!(
        pick.starts_with("pick = \"nearest\"") && pick.ends_with("only rows at a press are kept"),
        "{text}"
    );
    // A tenth of 2 s, or the time between two rows of the main table.
    let tolerance = line(&text, "tolerance_ms = ");
    assert!(
        tolerance.starts_with("tolerance_ms = 50.000   # at most a tenth"),
        "{text}"
    );
    // Only the lab knows that such rows are a slow stream.
    assert!(
        text.contains("# or, if this table is a slow stream and not one row per press: pick = \"linear\" and tolerance_ms = 4000.000"),
        "{text}"
    );
}
