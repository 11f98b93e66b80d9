//! Certificates of recordings, reduced to one channel.

use taceva_core::{Instrument, Traceability};
use taceva_metrology::budget::{Certificate, Coverage, Freedom};

#[test]
fn a_certificate_of_a_recording_is_reduced_to_one_channel() {
    let day = |text: &str| text.parse().expect("a day");
    let amount = |text: &str| text.parse().expect("an amount");
    let coverage = taceva_core::Coverage::Probability {
        p: 0.95,
        dof: Some(9.0),
    };
    let issued = day("2026-05-12");
    let mut stated = taceva_core::Certificate::new("D-K-1", "a laboratory", issued, "42", coverage);
    stated.relative.insert("Fz".to_owned(), 0.001);
    stated.expanded.insert("Fx".to_owned(), amount("2 mN"));
    let ends = [amount("50 mN"), amount("50 N")];
    stated.range.insert("Fz".to_owned(), ends);
    let traced = Traceability::new(Instrument::Force);
    assert_eq!(Certificate::of(&traced, "Fz", None), None);
    let traced = traced.with_driver("ati/netft", Some("43".to_owned()));
    let traced = traced.with_certificate(stated).expect("accepted");
    let reduced = Certificate::of(&traced, "Fz", Some(day("2027-01-02"))).expect("stated");
    assert_eq!((reduced.absolute, reduced.relative), (0.0, 0.001));
    assert_eq!(reduced.range, Some([0.05, 50.0]));
    assert_eq!(reduced.instrument_serial.as_deref(), Some("43"));
    assert_eq!(reduced.recorded_on.as_deref(), Some("2027-01-02"));
    let freedom = Freedom::Finite(9.0);
    assert_eq!(reduced.coverage, Coverage::Probability { p: 0.95, freedom });
    assert_eq!(Certificate::of(&traced, "Tz", None), None);
}
