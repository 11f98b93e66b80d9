use std::collections::BTreeMap;

use super::*;
use crate::unit::Amount;

fn certificate() -> Certificate {
    let issued = "2026-05-12".parse().expect("a day");
    let mut certificate = Certificate::new(
        "D-K-1",
        "a laboratory",
        issued,
        "M3813B-0042",
        Coverage::Factor(2.0),
    );
    certificate.valid_until = Some("2027-05-12".parse().expect("a day"));
    certificate.expanded = BTreeMap::from([("Fz".to_owned(), amount("3.0 mN"))]);
    certificate.range = BTreeMap::from([("Fz".to_owned(), [amount("0.05 N"), amount("50 N")])]);
    certificate
}

fn amount(text: &str) -> Amount {
    text.parse().expect("an amount")
}

/// Error message for a certificate of a force transducer after `change`.
fn refused(change: impl FnOnce(&mut Certificate)) -> String {
    let mut certificate = certificate();
    change(&mut certificate);
    let checked = certificate.check(Instrument::Force);
    checked.expect_err("refused").to_string()
}

#[test]
fn a_whole_certificate_of_the_instrument_is_accepted_and_covers_its_range_alone() {
    let certificate = certificate();
    assert_eq!(certificate.check(Instrument::Force), Ok(()));
    assert_eq!(certificate.check(Instrument::Sensor), Ok(()));
    assert!(certificate.covers("Fz", 50.0) && !certificate.covers("Fz", 50.1));
    assert!(!certificate.covers("Fz", 0.0) && !certificate.covers("Fz", f64::NAN));
    assert!(certificate.covers("Fx", 1e6));
}

#[test]
fn a_channel_of_another_instrument_is_refused_with_those_of_this_one() {
    let checked = certificate().check(Instrument::Robot);
    assert_eq!(
        checked.expect_err("refused").to_string(),
        "`U.Fz` is `Fz`, expected a channel of the robot: expected one of `Px`, `Py`, `Pz`, `Rx`, `Ry`, `Rz`, `tilt`"
    );
    let message = refused(|certificate| {
        certificate.range = BTreeMap::from([("Fzz".to_owned(), [amount("0 N"), amount("1 N")])]);
    });
    assert!(
        message.starts_with(
            "`range.Fzz` is `Fzz`, expected a channel of the force transducer: did you mean"
        ),
        "{message}"
    );
}

#[test]
fn an_uncertainty_in_a_unit_of_another_quantity_is_refused() {
    let message = refused(|certificate| {
        certificate.expanded = BTreeMap::from([("Fz".to_owned(), amount("2 mm"))]);
    });
    assert_eq!(
        message,
        "`U.Fz` is `2 mm`, expected an amount in N or a unit of the same quantity"
    );
}

#[test]
fn a_negative_uncertainty_and_one_that_is_no_number_are_refused() {
    let message = refused(|certificate| {
        certificate.expanded = BTreeMap::from([("Fz".to_owned(), amount("-2 mN"))]);
    });
    assert_eq!(message, "`U.Fz` is `-0.002 N`, expected 0 or more");
    for share in [-0.1, f64::NAN, f64::INFINITY] {
        let message = refused(|certificate| {
            certificate.relative.insert("Fz".to_owned(), share);
        });
        assert!(message.starts_with("`U_relative.Fz` is "), "{message}");
    }
}

#[test]
fn a_coverage_factor_without_its_decimal_point_is_refused() {
    for (k, found) in [(200.0, "200"), (0.2, "0.2"), (f64::NAN, "NaN")] {
        let message = refused(|certificate| certificate.coverage = Coverage::Factor(k));
        let expected =
            format!("`k` is `{found}`, expected a coverage factor from 1 to 20, such as 2");
        assert_eq!(message, expected);
    }
}

#[test]
fn a_channel_whose_uncertainties_are_all_zero_is_refused() {
    let zero = |certificate: &mut Certificate| {
        certificate.expanded = BTreeMap::from([("Fz".to_owned(), amount("0 N"))]);
    };
    let expected = "`U.Fz` is `0`, expected a number above 0 in `U` or `U_relative`";
    assert_eq!(refused(zero), expected);
    let message = refused(|certificate| {
        zero(certificate);
        certificate.relative.insert("Fz".to_owned(), 0.0);
    });
    assert_eq!(message, expected);
    let message = refused(|certificate| {
        certificate.expanded.clear();
        certificate.relative.insert("Fz".to_owned(), 0.0);
    });
    assert_eq!(
        message,
        "`U_relative.Fz` is `0`, expected a number above 0 in `U` or `U_relative`"
    );
    let mut share_alone = certificate();
    zero(&mut share_alone);
    share_alone.relative.insert("Fz".to_owned(), 0.001);
    assert_eq!(share_alone.check(Instrument::Force), Ok(()));
}

#[test]
fn a_relative_uncertainty_in_percent_is_refused() {
    let message = refused(|certificate| {
        certificate.relative.insert("Fz".to_owned(), 1.0);
    });
    assert_eq!(
        message,
        "`U_relative.Fz` is `1`, expected 0 or more and below 1, since 1 % is 0.01"
    );
}

#[test]
fn a_pair_of_channels_with_two_correlations_is_refused_in_either_order() {
    let stated = |first: &str, second: &str, coefficient| StatedCorrelation {
        between: [first.to_owned(), second.to_owned()],
        coefficient,
    };
    let once = stated("Fx", "Fy", Some(0.5));
    for twice in [stated("Fx", "Fy", None), stated("Fy", "Fx", Some(-0.5))] {
        let message = refused(|certificate| certificate.correlation = vec![once.clone(), twice]);
        assert!(
            message.ends_with("expected each pair of channels once"),
            "{message}"
        );
    }
    let mut others = certificate();
    others.correlation = vec![once, stated("Fx", "Fz", None), stated("Fz", "Fy", None)];
    assert_eq!(others.check(Instrument::Force), Ok(()));
}

#[test]
fn a_certificate_without_any_uncertainty_is_refused() {
    let message = refused(|certificate| certificate.expanded.clear());
    assert!(message.contains("states no uncertainty"), "{message}");
}

#[test]
fn a_coverage_that_is_no_factor_and_no_probability_is_refused() {
    for (coverage, start) in [
        (Coverage::Factor(0.0), "`k` is `0`"),
        (Coverage::Factor(f64::NAN), "`k` is `NaN`"),
        (Coverage::Probability { p: 1.0, dof: None }, "`p` is `1`"),
        (
            Coverage::Probability { p: 0.05, dof: None },
            "`p` is `0.05`, expected a probability from 0.68 to below 1, such as 0.95",
        ),
        (
            Coverage::Probability {
                p: 0.95,
                dof: Some(0.0),
            },
            "`dof` is `0`",
        ),
    ] {
        let message = refused(|certificate| certificate.coverage = coverage);
        assert!(message.starts_with(start), "{message}");
    }
}

#[test]
fn a_certificate_issued_after_its_last_day_is_refused() {
    let message = refused(|certificate| {
        certificate.valid_until = Some("2026-05-11".parse().expect("a day"));
    });
    assert_eq!(
        message,
        "`valid_until` is `2026-05-11`, expected a day not before `issued`, 2026-05-12"
    );
}

#[test]
fn empty_texts_and_a_digest_that_is_none_are_refused() {
    let message = refused(|certificate| certificate.serial = " ".to_owned());
    assert!(message.starts_with("`serial` is"), "{message}");
    let message = refused(|certificate| certificate.sha256 = Some("ab".to_owned()));
    assert!(
        message.ends_with("expected 64 hexadecimal digits"),
        "{message}"
    );
}

#[test]
fn a_range_backwards_and_a_correlation_beyond_one_are_refused() {
    let message = refused(|certificate| {
        certificate.range = BTreeMap::from([("Fz".to_owned(), [amount("5 N"), amount("1 N")])]);
    });
    assert!(
        message.starts_with("`range.Fz` is `5 N to 1 N`"),
        "{message}"
    );
    for (second, coefficient, end) in [
        ("Fy", 1.1, "a number from -1 to 1, or \"unknown\""),
        ("Fx", 0.5, "two different channels"),
    ] {
        let between = ["Fx".to_owned(), second.to_owned()];
        let stated = StatedCorrelation {
            between,
            coefficient: Some(coefficient),
        };
        let message = refused(|certificate| certificate.correlation.push(stated));
        assert!(message.ends_with(end), "{message}");
    }
}

#[test]
fn another_serial_number_and_an_expired_day_are_found() {
    let traced = Traceability::new(Instrument::Force).with_driver("ati/netft", None);
    let traced = traced.with_certificate(certificate()).expect("accepted");
    assert!(traced.other_serial().is_none());
    let same = traced
        .clone()
        .with_driver("ati/netft", Some("M3813B-0042".to_owned()));
    assert!(same.other_serial().is_none());
    let other = traced
        .clone()
        .with_driver("ati/netft", Some("M3813B-0043".to_owned()));
    assert!(
        other
            .other_serial()
            .is_some_and(|(_, read)| read == "M3813B-0043")
    );
    let day = |text: &str| text.parse().expect("a day");
    assert!(traced.expired_on(day("2027-05-12"), &[]).is_none());
    assert!(traced.expired_on(day("2027-05-13"), &[]).is_some());
}

#[test]
fn a_certificate_issued_after_the_first_day_of_the_labels_is_a_fault_unless_an_earlier_one_covers_it()
 {
    let day = |text: &str| text.parse().expect("a day");
    let days = day("2026-05-11")..=day("2026-05-13");
    let traced = Traceability::new(Instrument::Force).with_driver("ati/netft", None);
    let traced = traced.with_certificate(certificate()).expect("accepted");
    let all = [traced.clone()];
    let faults = traced.faults(Some(&days), &all);
    let [fault] = faults.as_slice() else {
        panic!("{faults:?}");
    };
    assert!(!fault.is_error());
    assert_eq!(
        fault.to_string(),
        "the certificate D-K-1 of the force transducer was issued on 2026-05-12, but the measurement was made on 2026-05-11"
    );
    let on_its_day = day("2026-05-12")..=day("2026-05-13");
    assert_eq!(traced.faults(Some(&on_its_day), &all), Vec::new());
    assert_eq!(traced.faults(None, &all), Vec::new());
    let mut before = traced.clone();
    before.certificate.as_mut().expect("its certificate").issued = day("2025-05-12");
    assert_eq!(
        traced.faults(Some(&days), &[before, traced.clone()]),
        Vec::new()
    );
}

#[test]
fn a_certificate_that_a_later_one_of_its_instrument_replaced_has_not_expired() {
    let traced = |instrument: Instrument, until: &str| {
        let mut traced = Traceability::new(instrument);
        let mut certificate = certificate();
        certificate.valid_until = Some(until.parse().expect("a day"));
        traced.certificate = Some(certificate);
        traced
    };
    let old = traced(Instrument::Force, "2027-05-12");
    let new = traced(Instrument::Force, "2028-05-12");
    let sensor = traced(Instrument::Sensor, "2028-05-12");
    let none = Traceability::new(Instrument::Force);
    let all = [old.clone(), new.clone()];
    let day = |text: &str| text.parse().expect("a day");
    assert!(old.expired_on(day("2027-06-01"), &all).is_none());
    assert!(new.expired_on(day("2028-06-01"), &all).is_some());
    let others = [old.clone(), sensor, none];
    assert!(old.expired_on(day("2027-06-01"), &others).is_some());
}

#[test]
fn a_certificate_covers_no_day_before_its_issue_or_after_its_last_day() {
    let day = |text: &str| text.parse().expect("a day");
    let traced = |issued: &str, until: &str| {
        let mut traced = Traceability::new(Instrument::Force);
        let mut certificate = certificate();
        certificate.issued = issued.parse().expect("a day");
        certificate.valid_until = Some(until.parse().expect("a day"));
        traced.certificate = Some(certificate);
        traced
    };
    let old = traced("2025-05-12", "2026-05-10");
    let new = traced("2026-05-20", "2027-05-20");
    let all = [old.clone(), new.clone()];
    // Between the last day of the old certificate and the issue of the new one.
    assert!(old.expired_on(day("2026-05-15"), &all).is_some());
    assert!(new.issued_after(day("2026-05-15"), &all).is_some());
    let days = day("2026-05-09")..=day("2026-05-21");
    for of in &all {
        assert_eq!(of.faults(Some(&days), &all), Vec::new());
    }
}
