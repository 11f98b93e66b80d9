//! One-file pages of finished evaluations.

use std::io::{self, Write};

use anyhow::Context as _;
use taceva_dataset::Dataset;
use taceva_report::{Picture, Report, Samples, Study, picks};
use taceva_study::EvaluationReport;

use super::thumbnail::{MEDIA_TYPE, thumbnail};

/// What a page shows, collected.
pub(crate) struct Page {
    title: String,
    studies: Vec<Study>,
    pictures: Vec<Picture>,
}

impl Page {
    /// A page of `reports`, with pictures of the samples that are predicted worst and best where the recordings have frames.
    pub(crate) fn of(title: &str, reports: &[EvaluationReport]) -> anyhow::Result<Page> {
        let studies = reports.iter().map(study).collect::<anyhow::Result<_>>()?;
        let mut page = Page {
            title: title.to_owned(),
            studies,
            pictures: Vec::new(),
        };
        for (at, report) in reports.iter().enumerate() {
            page.take_pictures(at, report)?;
        }
        Ok(page)
    }

    fn take_pictures(&mut self, at: usize, report: &EvaluationReport) -> anyhow::Result<()> {
        let samples = report.samples.as_ref();
        let Some(path) = samples.and_then(taceva_study::Samples::recording) else {
            return Ok(());
        };
        let dataset = Dataset::open(path)?;
        let ids = dataset.table().samples();
        for pick in picks(&self.studies[at]) {
            let row = ids.iter().position(|id| *id == pick.id);
            let frame = row.map(|row| dataset.frame(row)).transpose()?.flatten();
            if let Some(frame) = frame {
                self.pictures.push(Picture {
                    study: at,
                    id: pick.id,
                    media_type: MEDIA_TYPE,
                    bytes: thumbnail(&frame)?,
                });
            }
        }
        Ok(())
    }

    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let report = Report {
            title: &self.title,
            studies: &self.studies,
            pictures: &self.pictures,
        };
        out.write_all(taceva_report::report(&report).as_bytes())
    }
}

/// A finished evaluation as its JSON says it, with its samples.
pub(crate) fn study(report: &EvaluationReport) -> anyhow::Result<Study> {
    let text = serde_json::to_string(report)?;
    let mut studies = Study::read(&text)?;
    let mut study = studies.pop().context("one evaluation is one study")?;
    if let Some(samples) = &report.samples {
        let mut table = Vec::new();
        samples.write(&mut table)?;
        study.samples = Some(Samples::read(&String::from_utf8(table)?)?);
    }
    Ok(study)
}
