//! Tests of the texts in the card of a Hugging Face export.

use std::fs;

use taceva_core::{
    Certificate, Channel, Channels, Clock, Coverage, Instrument, Readings, Sample, Traceability,
};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_import::ExportForm;

use super::drawn::exported;

#[test]
fn texts_of_the_card_are_no_markup() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("set");
    let issued = "2026-05-12".parse().expect("a day");
    let mut certificate = Certificate::new(
        "K_1*",
        "<b>[lab](x)",
        issued,
        "42\n# 43",
        Coverage::Factor(2.0),
    );
    let amount = "3 mN".parse().expect("an amount");
    certificate.expanded.insert("Fz".to_owned(), amount);
    let traced = Traceability::new(Instrument::Force).with_certificate(certificate);
    let sensor = SensorFacts::new("gel *7* | <i>");
    let facts = RecordingFacts::new(Source::Synthetic, Clock::Unknown, sensor)
        .with_traceability(vec![traced.expect("a certificate of forces")]);
    let channels = Channels::new([Channel::FZ]).expect("distinct");
    let mut recorder = Recorder::create(&path, &RecordingSpec::new(facts, channels)).expect("new");
    let sample = Sample::new("1").with_truth(Readings::from_values([0.5]));
    recorder.append(&sample).expect("recorded");
    recorder.close().expect("closed");
    let dataset = Dataset::open(&path).expect("a dataset");
    let (target, _) = exported(&dataset, ExportForm::HuggingFace);
    let card = fs::read_to_string(target.join("README.md")).expect("a card");
    assert!(card.starts_with("# gel \\*7\\* \\| &lt;i>\n"), "{card}");
    let line =
        "- force: certificate K\\_1\\* of &lt;b>\\[lab\\](x), 2026-05-12, serial 42\\\\n\\# 43\n";
    assert!(card.contains(line), "{card}");
}
