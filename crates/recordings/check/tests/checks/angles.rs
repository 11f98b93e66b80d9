//! Tests of angles that jump.

use taceva_check::CheckReport;

use super::lab::{SENSOR, imported};
use super::streams::{message, says_nothing};

const CAMERA: &str = include_str!("../cases/08-rotation-vector-sign-flip/cam.csv");
const ROBOT: &str = include_str!("../cases/08-rotation-vector-sign-flip/robot.csv");

const JOINED: &str = "[time]\nclock = \"monotonic\"\ncolumn = \"t\"\nunit = \"s\"\n[[join]]\nname = \"rob\"\ntable = \"robot.csv\"\n\
     time = { column = \"t\", unit = \"s\" }\npick = \"nearest\"\ntolerance_ms = 100\nlag_ms = 0\nunmatched = \"drop\"\n";

fn of_robot(above: &str) -> CheckReport {
    let columns = ["x", "y", "z"]
        .map(|axis| format!("R{axis} = {{ from = \"rob.r{axis}\", unit = \"rad\" }}\n"));
    let map = format!(
        "map_version = 2\ntable = \"cam.csv\"\n{above}[columns]\n{}{JOINED}{SENSOR}",
        columns.concat()
    );
    let files = [("cam.csv", CAMERA), ("robot.csv", ROBOT)];
    let files = files.map(|(name, text)| (name, text.as_bytes().to_vec()));
    imported(&files, &map, &["TAC042"])
}

#[test]
fn a_rotation_vector_that_changes_its_sign_jumps_by_332_6_degrees_unless_it_is_declared() {
    let report = of_robot("");
    let said = message(&report, "TAC042");
    assert!(
        said.starts_with("Rx jumps by more than half a turn"),
        "{said}"
    );
    assert!(said.contains("(largest jump 332.6 degrees)"), "{said}");
    // Ry goes from -68.9 to 68.9 degrees, which is less than half a turn.
    assert_eq!(report.findings.len(), 1);
    says_nothing(&of_robot("rotation = [\"Rx\", \"Ry\", \"Rz\"]\n"), "TAC042");
}

#[test]
fn an_angle_that_begins_again_jumps_unless_its_period_is_declared_and_turns_within_half_a_turn_do_not()
 {
    let of = |cells: &str, unit: &str, more: &str| {
        let table = format!("a\n{cells}\n").into_bytes();
        let map = format!(
            "map_version = 2\ntable = \"t.csv\"\n[columns]\nyaw = {{ from = \"a\", unit = \"{unit}\"{more} }}\n[time]\nclock = \"unknown\"\n{SENSOR}"
        );
        imported(&[("t.csv", table)], &map, &["TAC042"])
    };
    let degrees = of("170\n179\n-179\n-160", "deg", "");
    assert!(message(&degrees, "TAC042").contains("358.0 degrees), first in row 3"));
    assert!(message(&of("0.1\n6.2\n0.3", "rad", ""), "TAC042").contains("between 2 of 2"));
    says_nothing(&of("170\n179\n-179", "deg", ", period = 360"), "TAC042");
    says_nothing(&of("-90\n89\n-90", "deg", ""), "TAC042");
    says_nothing(&of("-400\n400", "mm", ""), "TAC042");
}
