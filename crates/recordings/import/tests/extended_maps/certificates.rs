//! Tests of certificates in a map, and of rows added with the same certificate, another certificate or none.

use std::num::NonZeroUsize;
use std::path::Path;

use super::{NO_TIME, lab, planned};
use taceva_core::{Instrument, SilentProgress};
use taceva_dataset::{Dataset, Header};
use taceva_import::Addition;

const COLUMNS: &str = "table = \"labels.csv\"\n[columns]\nFz = { from = \"Fz\", unit = \"N\" }\n";

const CERTIFICATE: &str = r#"[force]
driver = "ati/netft"
serial = "M3813B-0042"
[force.certificate]
number = "D-K-1"
laboratory = "a laboratory"
issued = 2026-05-12
serial = "M3813B-0042"
k = 2.0
U = { Fz = "3.0 mN" }
range = { Fz = ["0.05 N", "50 N"] }
"#;

fn certified() -> String {
    format!("{COLUMNS}{NO_TIME}{CERTIFICATE}")
}

fn import(folder: &Path, map: &str) -> Header {
    let target = folder.join("dataset");
    let plan = planned(folder, map).expect("planned");
    plan.run(&target, NonZeroUsize::MIN, &SilentProgress)
        .expect("imported");
    Dataset::open(&target).expect("opens").header().clone()
}

/// Header of a dataset that was imported with the map `first`, after a row was added with the map `second`.
fn extended(first: &str, second: &str, new_certificate: bool) -> Result<Header, String> {
    let [one, two] = ["1\n2\n", "3\n"].map(|rows| lab(&[("labels.csv", &format!("Fz\n{rows}"))]));
    import(one.path(), first);
    let target = one.path().join("dataset");
    let addition = Addition::new("2026-11-26", "second").with_new_certificate(new_certificate);
    let plan = planned(two.path(), second)?;
    plan.extend(&target, &addition, NonZeroUsize::MIN, &SilentProgress)
        .map_err(|error| error.to_string())?;
    Ok(Dataset::open(&target).expect("opens").header().clone())
}

fn numbers(header: &Header) -> Vec<Option<&str>> {
    let of = header.traceability.iter();
    let certificates = of.map(|of| of.certificate.as_ref());
    certificates
        .map(|certificate| certificate.map(|certificate| certificate.number.as_str()))
        .collect()
}

#[test]
fn an_error_in_a_certificate_of_a_map_names_the_line_of_its_key() {
    let folder = lab(&[("labels.csv", "Fz\n1\n")]);
    let wrong = certified().replace("k = 2.0", "k = \"two\"");
    let before = wrong.split("k = \"two\"").next().unwrap_or_default();
    // After the line of the version.
    let line = before.matches('\n').count() + 2;
    let problem = planned(folder.path(), &wrong).err().unwrap_or_default();
    for part in [
        format!("line {line}"),
        "[force.certificate]: `k` is `\"two\"`, expected a number".to_owned(),
    ] {
        assert!(problem.contains(&part), "{problem}");
    }
    let missing = certified().replace("serial = \"M3813B-0042\"\nk = 2.0\n", "k = 2.0\n");
    let missing = missing.replace("number = \"D-K-1\"\n", "");
    let problem = planned(folder.path(), &missing).err().unwrap_or_default();
    assert!(
        problem.contains("the keys `number`, `serial` are missing"),
        "{problem}"
    );
}

#[test]
fn a_dataset_keeps_the_certificates_of_its_map() {
    let folder = lab(&[("labels.csv", "Fz\n1\n")]);
    let header = import(folder.path(), &certified());
    let [force] = header.traceability.as_slice() else {
        panic!("{:?}", header.traceability);
    };
    assert_eq!(force.instrument, Instrument::Force);
    assert_eq!(force.driver.as_deref(), Some("ati/netft"));
    assert!(force.other_serial().is_none());
    let certificate = force.certificate.as_ref().expect("a certificate");
    assert_eq!(certificate.expanded["Fz"].to_string(), "0.003 N");
    let plain = format!("{COLUMNS}{NO_TIME}");
    let folder = lab(&[("labels.csv", "Fz\n1\n")]);
    assert!(import(folder.path(), &plain).traceability.is_empty());
}

#[test]
fn a_certificate_of_another_instrument_is_refused_with_the_line_of_the_map() {
    let folder = lab(&[("labels.csv", "Fz\n1\n")]);
    let wrong = certified().replace("[force", "[robot");
    let problem = planned(folder.path(), &wrong).expect_err("a channel of forces");
    assert!(
        problem.contains("line ") && problem.contains("[robot.certificate]: `U.Fz` is `Fz`"),
        "{problem}"
    );
    let wrong = certified().replace("k = 2.0\n", "");
    let problem = planned(folder.path(), &wrong).expect_err("no coverage");
    assert!(
        problem.contains("`U` is stated without its coverage"),
        "{problem}"
    );
}

#[test]
fn rows_under_the_same_certificate_are_added_and_it_is_named_once() {
    let header = extended(&certified(), &certified(), false).expect("added");
    assert_eq!(numbers(&header), [Some("D-K-1")]);
}

#[test]
fn rows_under_another_certificate_are_refused_with_the_option_that_adds_them() {
    let other = certified().replace("D-K-1", "D-K-2");
    let problem = extended(&certified(), &other, false).expect_err("refused");
    assert!(
        problem.contains(
            "`force.certificate` is `D-K-1` in the dataset and `D-K-2` in the map; add these rows with `--new-certificate`"
        ),
        "{problem}"
    );
    let header = extended(&certified(), &other, true).expect("added");
    assert_eq!(numbers(&header), [Some("D-K-1"), Some("D-K-2")]);
}

#[test]
fn rows_under_a_changed_certificate_of_the_same_number_are_refused_with_both_values() {
    let end = "although both certificates have the number `D-K-1`; add these rows with `--new-certificate`";
    for (before, after, words) in [
        (
            "\"3.0 mN\"",
            "\"4.0 mN\"",
            "`force.certificate.U.Fz` is `0.003 N` in the dataset and `0.004 N` in the map",
        ),
        (
            "k = 2.0\n",
            "k = 2.0\nvalid_until = 2027-05-12\n",
            "`force.certificate.valid_until` is absent in the dataset and `2027-05-12` in the map",
        ),
        (
            "range = { Fz = [\"0.05 N\", \"50 N\"] }\n",
            "",
            "`force.certificate.range` is `{\"Fz\":[\"0.05 N\",\"50 N\"]}` in the dataset and absent in the map",
        ),
    ] {
        let changed = certified().replace(before, after);
        let problem = extended(&certified(), &changed, false).expect_err("refused");
        assert!(problem.contains(&format!("{words}, {end}")), "{problem}");
        let header = extended(&certified(), &changed, true).expect("added");
        assert_eq!(numbers(&header), [Some("D-K-1"), Some("D-K-1")]);
    }
}

#[test]
fn rows_without_the_certificate_of_the_dataset_are_refused_and_named_if_they_are_added() {
    let none = format!("{COLUMNS}{NO_TIME}");
    let problem = extended(&certified(), &none, false).expect_err("refused");
    assert!(
        problem.contains("`D-K-1` in the dataset and absent in the map"),
        "{problem}"
    );
    let header = extended(&certified(), &none, true).expect("added");
    assert_eq!(numbers(&header), [Some("D-K-1"), None]);
    // The certificate of added rows does not cover those of before.
    let header = extended(&none, &certified(), true).expect("added");
    assert_eq!(numbers(&header), [Some("D-K-1"), None]);
}
