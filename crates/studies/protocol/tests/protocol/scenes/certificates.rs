//! Tests of certificates in a rig file, and of every kind of invalid certificate.

use taceva_core::{Certificate, Coverage};
use taceva_protocol::RigFile;

const HEAD: &str = r#"rig_version = 1
[force]
driver = "lab/box"
axes = ["x", "-y", "-z"]
[force.certificate]
number = "D-K-1"
laboratory = "a laboratory"
issued = 2026-05-12
valid_until = "2027-05-12"
serial = "M3813B-0042"
"#;

const REST: &str = r#"k = 2.0
U = { Fx = "2.0 mN", Fz = "3.0 mN" }
U_relative = { Fz = 0.001 }
range = { Fz = ["0.05 N", "50 N"] }
correlation = [["Fx", "Fz", 0], ["Fx", "Fy", "unknown"]]
temperature = "23 ± 2 C"
"#;

fn certificate(text: &str) -> Certificate {
    let rig = RigFile::parse("lab.toml", text).expect("a rig");
    let force = rig.force.expect("a transducer");
    force.certificate.expect("a certificate")
}

/// Error message for a complete certificate in which `from` is replaced by `to`.
fn refused(from: &str, to: &str) -> String {
    let text = format!("{HEAD}{REST}");
    assert!(text.contains(from), "{from}");
    let error = RigFile::parse("lab.toml", &text.replacen(from, to, 1)).expect_err("wrong");
    let message = error.to_string();
    assert!(message.starts_with("lab.toml, line "), "{message}");
    message
}

#[test]
fn a_certificate_is_read_with_dates_in_quotes_or_without_and_amounts_in_stored_units() {
    let certificate = certificate(&format!("{HEAD}{REST}"));
    assert_eq!(certificate.issued.to_string(), "2026-05-12");
    let until = certificate.valid_until.map(|until| until.to_string());
    assert_eq!(until.as_deref(), Some("2027-05-12"));
    assert_eq!(certificate.coverage, Coverage::Factor(2.0));
    assert_eq!(certificate.expanded["Fx"].to_string(), "0.002 N");
    assert!(certificate.covers("Fz", 50.0) && !certificate.covers("Fz", 0.04));
    let correlation = certificate.correlation.iter();
    let coefficients: Vec<Option<f64>> = correlation.map(|of| of.coefficient).collect();
    assert_eq!(coefficients, [Some(0.0), None]);
}

#[test]
fn a_coverage_is_a_probability_with_degrees_of_freedom_too() {
    let text = format!("{HEAD}{REST}").replace("k = 2.0", "p = 0.95\ndof = 9");
    let coverage = Coverage::Probability {
        p: 0.95,
        dof: Some(9.0),
    };
    assert_eq!(certificate(&text).coverage, coverage);
}

#[test]
fn an_uncertainty_without_k_and_p_is_refused_and_so_are_both() {
    let message = refused("k = 2.0\n", "");
    assert!(
        message.contains("`U` is stated without its coverage"),
        "{message}"
    );
    let message = refused("k = 2.0", "k = 2.0\np = 0.95");
    assert!(message.contains("`k` is stated with `p`"), "{message}");
}

#[test]
fn a_unit_that_is_unknown_or_of_another_quantity_is_refused_by_its_channel() {
    let message = refused("Fz = \"3.0 mN\"", "Fz = \"3.0 furlong\"");
    assert!(
        message.contains("`U.Fz` is `3.0 furlong`, expected a known unit: unknown unit `furlong`"),
        "{message}"
    );
    let message = refused("Fz = \"3.0 mN\"", "Fz = \"3.0 um\"");
    assert!(
        message.contains("[force.certificate]: `U.Fz` is `0.003 mm`, expected an amount in N"),
        "{message}"
    );
}

#[test]
fn an_uncertainty_that_is_negative_or_no_number_is_refused() {
    let message = refused("Fz = \"3.0 mN\"", "Fz = \"-3.0 mN\"");
    assert!(
        message.contains("`U.Fz` is `-0.003 N`, expected 0 or more"),
        "{message}"
    );
    let message = refused("Fz = \"3.0 mN\"", "Fz = \"nan mN\"");
    assert!(
        message.contains("`U.Fz` is `nan mN`, expected a finite number"),
        "{message}"
    );
    let message = refused("Fz = 0.001", "Fz = nan");
    assert!(
        message.contains("`U_relative.Fz` is `NaN`, expected 0 or more"),
        "{message}"
    );
}

#[test]
fn a_day_that_the_calendar_lacks_and_one_after_the_last_are_refused() {
    let message = refused("\"2027-05-12\"", "\"2027-02-29\"");
    assert!(
        message.contains("`valid_until` is `2027-02-29`, expected a day such as 2026-05-12"),
        "{message}"
    );
    let message = refused("issued = 2026-05-12", "issued = 2026-05-12T10:00:00");
    assert!(
        message.contains("`issued` is `2026-05-12T10:00:00`"),
        "{message}"
    );
    let message = refused("\"2027-05-12\"", "\"2026-05-11\"");
    assert!(
        message.contains("expected a day not before `issued`"),
        "{message}"
    );
}

#[test]
fn a_channel_that_the_instrument_does_not_measure_is_refused() {
    let message = refused("U_relative = { Fz", "U_relative = { Fq");
    assert!(message.contains("`U_relative.Fq` is `Fq`"), "{message}");
    let message = refused("range = { Fz", "range = { Pz");
    assert!(
        message.contains("a channel of the force transducer"),
        "{message}"
    );
}

#[test]
fn an_unknown_key_and_a_missing_one_are_refused_by_their_names() {
    let message = refused("temperature", "temprature");
    assert!(
        message.contains("`temprature`: unknown key") && message.contains("temperature"),
        "{message}"
    );
    let message = refused("serial = \"M3813B-0042\"\n", "");
    assert!(
        message.ends_with("[force.certificate]: the key `serial` is missing"),
        "{message}"
    );
}

#[test]
fn all_missing_keys_are_named_at_once() {
    let text = HEAD.replace("number = \"D-K-1\"\n", "");
    let text = text.replace("issued = 2026-05-12\n", "");
    let error = RigFile::parse("lab.toml", &text).expect_err("incomplete");
    let message = error.to_string();
    assert!(
        message.ends_with("the keys `number`, `issued`, `k`, `U` are missing"),
        "{message}"
    );
}

#[test]
fn a_wrong_value_is_named_by_its_line_its_key_and_the_expectation() {
    for (from, to, expected) in [
        (
            "k = 2.0",
            "k = \"two\"",
            "lab.toml, line 11: [force.certificate]: `k` is `\"two\"`, expected a number such as 2.0",
        ),
        (
            "laboratory = \"a laboratory\"",
            "laboratory = 7",
            "lab.toml, line 7: [force.certificate]: `laboratory` is `7`, expected a string in quotes",
        ),
        (
            "\"2027-05-12\"",
            "\"2027-02-29\"",
            "lab.toml, line 9: [force.certificate]: `valid_until` is `2027-02-29`, expected a day such as 2026-05-12",
        ),
        (
            "Fz = 0.001",
            "Fz = 1.0",
            "lab.toml, line 13: [force.certificate]: `U_relative.Fz` is `1`, expected 0 or more",
        ),
        (
            "[\"0.05 N\", \"50 N\"]",
            "\"50 N\"",
            "lab.toml, line 14: [force.certificate]: `range` is `",
        ),
    ] {
        let message = refused(from, to);
        assert!(message.starts_with(expected), "{message}");
    }
}
