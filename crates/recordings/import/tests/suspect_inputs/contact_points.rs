//! Tests of drafts for recordings whose contact points are identified only by coordinates.

use super::drafts::{drafted, filled, wave, waves};
use super::{lab, line, planned};

/// Coordinates of the place of `row`: eight places in turn.
fn place(row: usize) -> String {
    format!("{}.5,{}.25", row % 4, row % 8 / 4)
}

/// Table of `count` presses at the places of [`place`].
fn presses(count: usize) -> String {
    let rows = (0..count).map(|row| format!("{},{}\n", place(row), wave(row)));
    format!("x_mm,y_mm,Fz_N\n{}", rows.collect::<String>())
}

#[test]
fn coordinates_that_repeat_exactly_are_drafted_as_the_contact_point() {
    let draft = drafted("x_mm,y_mm,Fz_N", |row| {
        format!("{},{}", place(row), wave(row))
    });
    let said = line(&draft, "point_id = ");
    assert!(
        said.starts_with(
            "point_id = [\"x_mm\", \"y_mm\"]   # a guess: 40 rows have 8 places that repeat exactly"
        ),
        "{draft}"
    );
    let folder = lab(&[("labels.csv", &presses(40))]);
    let plan = planned(folder.path(), &filled(&draft)).expect("an import");
    let summary = plan.summary().to_string();
    assert!(
        summary.contains("\npoints   8 contact points\n"),
        "{summary}"
    );
    let folder = lab(&[("labels.csv", &presses(300))]);
    let draft = super::draft(folder.path());
    let said = line(&draft, "point_id = ");
    assert!(
        said.contains("# a guess: the first 200 rows have 8 places"),
        "{draft}"
    );
}

#[test]
fn coordinates_that_rarely_repeat_or_have_a_column_of_points_beside_them_name_no_contact_point() {
    let moving = drafted("x_mm,y_mm,Fz_N", |row| waves(row, 3));
    assert!(!moving.contains("point_id"), "{moving}");
    let still = drafted("x_mm,y_mm,Fz_N", |row| format!("1.5,2.5,{}", wave(row)));
    assert!(!still.contains("point_id"), "{still}");
    let rests = drafted("x_mm,y_mm,Fz_N", |row| match row < 25 {
        true => format!("1.5,2.5,{}", wave(row)),
        false => waves(row, 3),
    });
    assert!(!rests.contains("point_id"), "{rests}");
    let several = "left_x_mm,left_y_mm,right_x_mm,right_y_mm,Fz_N";
    let several = drafted(several, |row| {
        format!("{},{},{}", place(row), place(row + 1), wave(row))
    });
    assert!(!several.contains("point_id"), "{several}");
    let named = drafted("x_mm,y_mm,Fz_N,location", |row| {
        let at = row % 8;
        format!("{at}.5,{at}.25,{},p{at}", wave(row))
    });
    assert!(
        line(&named, "# point_id = ").contains("\"location\""),
        "{named}"
    );
    assert!(!named.contains("\npoint_id"), "{named}");
}
