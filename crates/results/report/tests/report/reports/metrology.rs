//! Tests of the uncertainty of a reading of each measured sensor.

use super::page;
use crate::support::{drawn, results, study};
use taceva_core::{Certificate, Coverage, Instrument, Traceability};
use taceva_report::Study;
use taceva_results::Samples;

/// A study whose samples count as measured.
fn recorded(sensor: &str) -> Study {
    Study {
        source: "recorded".to_owned(),
        ..drawn(sensor, 96, 1.0)
    }
}

/// Metrology section of the page of `studies`; empty without this section.
fn section(studies: &[Study]) -> String {
    let page = page(studies);
    let section = page.split("<section id=\"metrology\"").nth(1);
    let section = section.and_then(|rest| rest.split("</section>").next());
    section.unwrap_or_default().to_owned()
}

/// A force transducer with a certificate of Fz.
fn certified() -> Traceability {
    let issued = "2026-05-12".parse().expect("a day");
    let mut certificate =
        Certificate::new("D-K-1", "a laboratory", issued, "42", Coverage::Factor(2.0));
    let amount = "3 mN".parse().expect("an amount");
    certificate.expanded.insert("Fz".to_owned(), amount);
    let traced = Traceability::new(Instrument::Force).with_certificate(certificate);
    traced.expect("a certificate of forces")
}

#[test]
fn each_measured_sensor_has_a_budget_with_its_bars_and_uncovered_effects() {
    let section = section(&[recorded("one"), recorded("two")]);
    for part in [
        "<strong>one</strong>: Fz = ",
        "<strong>two</strong>: Fz = ",
        " N, U = ",
        "(k = ",
        "nu_eff ",
        "figure-contributions-1",
        "figure-contributions-2",
        "place to place",
        "one reading",
        "<li>hysteresis: unloading: not in this recording</li>",
        "<li>r_light: other light: measured, but no source of the budget names it</li>",
        "<li>certificate: reference: the recording has no certificate</li>",
        "<code>taceva budget --template RESULT.json &gt; budget.toml</code>",
    ] {
        assert!(section.contains(part), "no {part} in {section}");
    }
    assert!(!section.contains("NaN"), "{section}");
}

#[test]
fn a_certificate_of_the_recording_is_a_source() {
    let mut study = recorded("one");
    study.references = vec![certified()];
    let section = section(&[study]);
    assert!(section.contains("reference"), "{section}");
    assert!(!section.contains("<li>certificate: "), "{section}");
}

#[test]
fn a_certificate_of_some_recordings_or_one_of_several_is_no_source() {
    let mut other = certified();
    let of_other = other.certificate.as_mut().expect("a certificate");
    of_other.number = "D-K-2".to_owned();
    for (second, reason) in [
        (
            Traceability::new(Instrument::Force),
            "some of the recordings have no certificate",
        ),
        (other, "the recordings have several certificates"),
    ] {
        let mut study = recorded("one");
        study.references = vec![certified(), second];
        let section = section(&[study]);
        let line = format!("<li>certificate: reference: {reason}</li>");
        assert!(section.contains(&line), "{section}");
        assert!(
            section.contains("not traceable: the budget has no certificate of the reference"),
            "{section}"
        );
    }
}

#[test]
fn synthetic_and_published_numbers_have_no_budget_and_simulated_ones_say_so() {
    for source in ["synthetic", "published"] {
        let mut study = recorded("one");
        study.source = source.to_owned();
        assert_eq!(section(&[study]), "", "{source}");
    }
    let mut drawn = recorded("drawn");
    drawn.source = "synthetic".to_owned();
    let section = section(&[drawn, recorded("real")]);
    assert!(section.contains("<strong>real</strong>: Fz = "));
    assert!(!section.contains("<strong>drawn</strong>"), "{section}");
    let mut simulated = recorded("bench");
    simulated.source = "simulated".to_owned();
    let section = self::section(&[simulated]);
    assert!(
        section.contains("<strong>bench</strong> (simulated): Fz = "),
        "{section}"
    );
}

#[test]
fn a_budget_that_cannot_be_made_is_one_line_with_the_reason() {
    let mut without = recorded("one");
    without.samples = None;
    let section_without = section(&[without]);
    let reason = "<strong>one</strong>: no uncertainty budget (its samples are not known; ";
    assert!(section_without.contains(reason), "{section_without}");
    let mut alone = recorded("one");
    let table = "sample,point_id,Fz,Fz_predicted\n1,a,0.5,0.4\n2,b,0.7,0.8\n";
    alone.samples = Some(Samples::read(table).expect("samples"));
    let section_alone = section(&[alone]);
    let reason = "no uncertainty budget (Fz: 2 rows of 2 points, expected at least two points";
    assert!(section_alone.contains(reason), "{section_alone}");
}

#[test]
fn a_certificate_of_another_instrument_is_a_reason_without_a_line() {
    let mut study = recorded("one");
    let mut traced = certified();
    traced.serial = Some("43".to_owned());
    study.references = vec![traced];
    let section = section(&[study]);
    let reason = "no uncertainty budget (Fz: ";
    assert!(section.contains(reason), "{section}");
    assert!(section.contains("the instrument has `43`"), "{section}");
    assert!(!section.contains("line "), "{section}");
}

#[test]
fn a_name_with_markup_is_text_of_the_budget() {
    let section = section(&[recorded("<script>alert(1)</script>")]);
    assert!(section.contains("&lt;script&gt;alert(1)"), "{section}");
    assert!(!section.contains("<script"), "{section}");
}

#[test]
fn without_fz_the_first_force_is_the_measurand_else_the_first_channel() {
    let of = |channels: [&str; 2]| {
        let [one, other] = channels;
        let mut table =
            format!("sample,point_id,{one},{one}_predicted,{other},{other}_predicted\n");
        for (row, off) in [0.01, 0.03, -0.02, -0.01].into_iter().enumerate() {
            let off = 1.0 + off;
            table += &format!("{row},p{},{off},1,{off},1\n", row / 2);
        }
        let mut study = study(&results("one", 1.0));
        study.source = "recorded".to_owned();
        study.samples = Some(Samples::read(&table).expect("samples"));
        section(&[study])
    };
    let forces = of(["Px", "Fx"]);
    assert!(forces.contains("</strong>: Fx = "), "{forces}");
    let places = of(["Py", "Px"]);
    assert!(places.contains("</strong>: Py = "), "{places}");
    assert!(places.contains(" mm, U = "), "{places}");
}
