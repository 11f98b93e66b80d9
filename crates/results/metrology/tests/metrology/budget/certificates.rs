//! Certificates of recordings, reduced to one channel.

use taceva_core::{Coverage, Instrument, Traceability};
use taceva_metrology::budget::{Certificate, Evidence};

use super::refusal;

#[test]
fn a_certificate_of_a_recording_is_reduced_to_one_channel() {
    let day = |text: &str| text.parse().expect("a day");
    let amount = |text: &str| text.parse().expect("an amount");
    let coverage = Coverage::Probability {
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
    assert_eq!(reduced.coverage, coverage);
    assert_eq!(Certificate::of(&traced, "Tz", None), None);
}

#[test]
fn a_probability_has_the_factor_of_its_distribution() {
    let u = |coverage| {
        let mut certificate = Certificate::new("D-K-1", "a laboratory", "42", coverage);
        certificate.absolute = 1.0;
        certificate.standard_uncertainty(0.0).expect("a factor")
    };
    let normal = Coverage::Probability { p: 0.95, dof: None };
    assert!((1.0 / u(normal) - 1.96).abs() < 1e-4);
    assert_eq!(u(Coverage::Factor(2.0)).to_bits(), 0.5_f64.to_bits());
}

#[test]
fn a_file_with_two_certificates_of_a_channel_gives_none_of_them() {
    let table = |number: &str| {
        format!(
            "[[traceability]]\ninstrument = \"force\"\n[traceability.certificate]\nnumber = \"{number}\"\nlaboratory = \"L\"\n\
             issued = 2026-05-12\nserial = \"42\"\nk = 2.0\nU = {{ Fz = \"3.0 mN\" }}\n"
        )
    };
    let one = Certificate::read(&table("D-K-1"), "Fz", None).expect("one");
    assert_eq!(one.number, "D-K-1");
    let both = [table("D-K-1"), table("D-K-2")].concat();
    let message = Certificate::read(&both, "Fz", None).expect_err("two");
    assert_eq!(
        message.to_string(),
        "`certificate`: two certificates of a reference state Fz, D-K-1 and D-K-2; name a file with one certificate"
    );
}

#[test]
fn a_certificate_that_depends_on_the_reading_needs_it_beside_an_expression() {
    let text = "budget_version = 1\nmeasurand = \"Fz\"\nexpression = \"2 * cell\"\n[[source]]\nname = \"cell\"\nfrom = \"certificate\"\n";
    let mut certificate = Certificate::new("D-K-1", "L", "42", Coverage::Factor(2.0));
    certificate.relative = 0.001;
    let evidence = Evidence::default().with_certificate(certificate);
    let message = refusal(text, &evidence);
    assert!(
        message.starts_with("line 6, `from`: the certificate depends on the reading"),
        "{message}"
    );
}
