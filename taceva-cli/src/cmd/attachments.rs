//! Additional files of an evaluation.

use std::path::Path;

use taceva_report::FigureStyle;
use taceva_results::EvaluationReport;

use super::Context;
use crate::args::ScoringArgs;
use crate::output;
use crate::report::page::Page;

/// Additional files that the arguments request.
pub(super) struct Attachments<'a> {
    page: Option<&'a Path>,
    figures: Option<&'a Path>,
    style: FigureStyle,
    samples: Option<&'a Path>,
}

impl<'a> Attachments<'a> {
    pub(super) fn of(args: &'a ScoringArgs) -> Attachments<'a> {
        Attachments {
            page: args.page.path.as_deref(),
            figures: args.figures.as_deref(),
            style: args.figure.style(),
            samples: args.samples_out.as_deref(),
        }
    }

    pub(super) fn is_any(&self) -> bool {
        self.page.is_some() || self.figures.is_some() || self.samples.is_some()
    }

    pub(super) fn write(&self, report: &EvaluationReport, context: &Context) -> anyhow::Result<()> {
        if self.page.is_some() || self.figures.is_some() {
            let title = format!("{}: how well it measures", report.subject.sensor);
            let page = Page::of(&title, std::slice::from_ref(report))?;
            if let Some(path) = self.page {
                output::write(Some(path), |out| page.write(out))?;
            }
            if let Some(folder) = self.figures {
                page.write_figures(folder, &self.style, context)?;
            }
        }
        if let (Some(path), Some(samples)) = (self.samples, &report.samples) {
            output::write(Some(path), |out| samples.write(out))?;
        }
        Ok(())
    }
}

/// Adds the digest of the table of samples to a report, so that later commands can find and check the table.
pub(super) fn note_samples(report: &mut EvaluationReport) -> anyhow::Result<()> {
    if let Some(samples) = &report.samples {
        let mut table = Vec::new();
        samples.write(&mut table)?;
        report.provenance.samples_table = Some(taceva_files::seal::digest_of_bytes(&table));
    }
    Ok(())
}
