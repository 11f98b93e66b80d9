//! Tests of certificates of the instruments: missing, expired, for another serial number, and for a smaller range.

use taceva_check::{CheckReport, Severity};

use super::codes;
use super::lab::{SENSOR, imported};
use super::streams::{message, says_nothing};

/// Unix time of 10:00 UTC on 2026-11-29, s. `EXPIRED_S` is the same hour on 2027-05-13.
const VALID_S: u64 = 1_795_946_400;
const EXPIRED_S: u64 = 1_810_202_400;

const CERTIFICATE: &str = r#"[force.certificate]
number = "D-K-1"
laboratory = "a laboratory"
issued = 2026-05-12
valid_until = 2027-05-12
serial = "42"
k = 2.0
U = { Fz = "3.0 mN" }
range = { Fz = ["0.05 N", "50 N"] }
"#;

/// Report on `forces`, one each second from `begun_s` on, imported by a map with the certificates `instruments`.
fn checked(forces: &[f64], begun_s: u64, instruments: &str) -> CheckReport {
    let rows = (begun_s..).zip(forces);
    let rows = rows.map(|(time, force)| format!("{time},{force}\n"));
    let table = format!("t,Fz\n{}", rows.collect::<String>());
    let map = format!(
        "map_version = 2\ntable = \"t.csv\"\n[columns]\nFz = {{ from = \"Fz\", unit = \"N\" }}\n[time]\ncolumn = \"t\"\nunit = \"s\"\nclock = \"unix\"\n{instruments}{SENSOR}"
    );
    let codes = ["TAC028", "TAC029"];
    imported(&[("t.csv", table.into_bytes())], &map, &codes)
}

#[test]
fn a_valid_certificate_over_the_whole_range_has_nothing_to_note() {
    let report = checked(&[0.5, 1.5], VALID_S, CERTIFICATE);
    assert!(codes(&report).is_empty(), "{:#?}", report.findings);
    // The last day counts.
    let report = checked(&[0.5], EXPIRED_S - 86_400, CERTIFICATE);
    assert!(codes(&report).is_empty(), "{:#?}", report.findings);
}

#[test]
fn an_import_that_names_no_instrument_has_nothing_to_note() {
    let report = checked(&[0.5, 1.5], VALID_S, "");
    assert!(codes(&report).is_empty(), "{:#?}", report.findings);
}

#[test]
fn instruments_without_certificate_are_noted_where_labels_were_measured() {
    let instruments = "[force]\ndriver = \"ati/netft\"\n[robot]\ndriver = \"lab/arm\"\n";
    let report = checked(&[0.5, 1.5], VALID_S, instruments);
    assert_eq!(codes(&report), [("TAC028", Severity::Note)]);
    assert_eq!(
        message(&report, "TAC028"),
        "no certificate of the force transducer and the robot: the labels are not traceable"
    );
}

#[test]
fn a_certificate_that_had_expired_on_the_day_of_the_recording_is_warned_of() {
    let report = checked(&[0.5, 1.5], EXPIRED_S, CERTIFICATE);
    assert_eq!(codes(&report), [("TAC028", Severity::Warning)]);
    assert_eq!(
        message(&report, "TAC028"),
        "the certificate D-K-1 of the force transducer was valid until 2027-05-12, but the measurement was made on 2027-05-13"
    );
}

#[test]
fn a_certificate_that_was_issued_after_the_recording_is_warned_of() {
    let later = CERTIFICATE.replace("issued = 2026-05-12", "issued = 2026-11-30");
    let report = checked(&[0.5, 1.5], VALID_S, &later);
    assert_eq!(codes(&report), [("TAC028", Severity::Warning)]);
    assert_eq!(
        message(&report, "TAC028"),
        "the certificate D-K-1 of the force transducer was issued on 2026-11-30, but the measurement was made on 2026-11-29"
    );
    let same_day = CERTIFICATE.replace("issued = 2026-05-12", "issued = 2026-11-29");
    let report = checked(&[0.5, 1.5], VALID_S, &same_day);
    assert!(codes(&report).is_empty(), "{:#?}", report.findings);
}

#[test]
fn a_certificate_of_another_serial_number_is_an_error() {
    let instruments = format!("[force]\nserial = \"43\"\n{CERTIFICATE}");
    let report = checked(&[0.5, 1.5], VALID_S, &instruments);
    assert_eq!(codes(&report), [("TAC028", Severity::Error)]);
    assert_eq!(
        message(&report, "TAC028"),
        "the certificate D-K-1 of the force transducer is for serial number 42, but the driver read 43"
    );
}

#[test]
fn labels_outside_the_certificates_range_are_counted_by_channel() {
    let report = checked(&[0.0, 0.5, 1.5, 60.0], VALID_S, CERTIFICATE);
    assert_eq!(codes(&report), [("TAC029", Severity::Warning)]);
    assert_eq!(
        message(&report, "TAC029"),
        "2 of 4 labels of Fz (50.0 %) are outside 0.05 N to 50 N, the range of the certificate D-K-1: 1 below, 1 above"
    );
    // Samples at rest alone are no reason to warn.
    let report = checked(&[0.0, 0.5], VALID_S, CERTIFICATE);
    assert_eq!(codes(&report), [("TAC029", Severity::Note)]);
    says_nothing(&checked(&[0.5], VALID_S, CERTIFICATE), "TAC029");
}

#[test]
fn a_label_below_a_range_of_both_signs_is_a_warning() {
    let signed = CERTIFICATE.replace("\"0.05 N\"", "\"-50 N\"");
    let report = checked(&[0.0, -60.0], VALID_S, &signed);
    assert_eq!(codes(&report), [("TAC029", Severity::Warning)]);
    says_nothing(&checked(&[0.0, -40.0], VALID_S, &signed), "TAC029");
    // Noise at rest alone is no reason to warn.
    let unsigned = CERTIFICATE.replace("\"0.05 N\"", "\"0 N\"");
    let report = checked(&[-0.01, 0.5], VALID_S, &unsigned);
    assert_eq!(codes(&report), [("TAC029", Severity::Note)]);
}

#[test]
fn a_certificate_of_the_sensor_bounds_no_labels() {
    let of_sensor = CERTIFICATE.replace("[force.", "[sensor.");
    let report = checked(&[0.0, 60.0], VALID_S, &of_sensor);
    assert!(codes(&report).is_empty(), "{:#?}", report.findings);
}

#[test]
fn pages_on_rigs_and_imports_name_both_findings() {
    for page in [
        include_str!("../../../../../docs/rig.md"),
        include_str!("../../../../../docs/your-recording.md"),
    ] {
        for code in ["TAC028", "TAC029"] {
            assert!(page.contains(code), "{code}");
        }
    }
}
