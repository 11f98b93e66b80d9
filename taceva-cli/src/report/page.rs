//! One-file pages of finished evaluations.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use taceva_core::shown;

use anyhow::Context as _;
use taceva_dataset::Dataset;
use taceva_report::{Layout, Picture, Report, ScoreTable, Study, Triple, figures, picks};
use taceva_results::EvaluationReport;

use crate::context::Context;
use crate::output;

use super::thumbnail::{MEDIA_TYPE, thumbnail};
use super::triple::triple;

/// The contents of a page.
pub(crate) struct Page {
    title: String,
    studies: Vec<Study>,
    pictures: Vec<Picture>,
    triples: Vec<Triple>,
}

impl Page {
    /// A page of `reports`, with pictures of the worst and best predicted samples if the recordings have frames.
    pub(crate) fn of(title: &str, reports: &[EvaluationReport]) -> anyhow::Result<Page> {
        let studies = reports.iter().map(study).collect::<anyhow::Result<_>>()?;
        let mut page = Page {
            title: title.to_owned(),
            studies,
            pictures: Vec::new(),
            triples: Vec::new(),
        };
        for (at, report) in reports.iter().enumerate() {
            page.take_pictures(at, report)?;
        }
        Ok(page)
    }

    fn take_pictures(&mut self, at: usize, report: &EvaluationReport) -> anyhow::Result<()> {
        let samples = report.samples.as_ref();
        let Some(paths) = samples
            .map(taceva_results::Samples::recordings)
            .filter(|paths| !paths.is_empty())
        else {
            return Ok(());
        };
        let recordings: Result<Vec<Dataset>, _> =
            paths.iter().map(|path| Dataset::open(path)).collect();
        let dataset = Dataset::joined(recordings?)?;
        let dataset = match &report.provenance.view {
            Some(view) => dataset.seen(view)?,
            None => dataset,
        };
        // If a sample has several pictures and no view was chosen, none is shown.
        if dataset.require_view().is_err() {
            return Ok(());
        }
        self.triples.extend(triple(&dataset, at)?);
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

    /// Writes every figure into `folder`, as standalone SVG and as PDF, and reports characters that no font has.
    pub(crate) fn write_figures(&self, folder: &Path, context: &Context) -> anyhow::Result<()> {
        fs::create_dir_all(folder).with_context(|| format!("cannot make {}", shown(folder)))?;
        let mut without_glyph = BTreeSet::new();
        for figure in figures(&self.studies) {
            let path = folder.join(format!("{}.svg", figure.id));
            output::write(Some(&path), |out| out.write_all(figure.svg().as_bytes()))?;
            let path = path.with_extension("pdf");
            output::write(Some(&path), |out| out.write_all(&figure.pdf()))?;
            without_glyph.extend(figure.letters_without_glyph());
        }
        if !without_glyph.is_empty() {
            let letters = without_glyph.into_iter();
            let letters = letters.map(|letter| format!("{letter} (U+{:04X})", u32::from(letter)));
            context.say(format_args!(
                "the fonts of PDF figures lack {}: each is drawn as a box with its code point; the SVG figures show the letters",
                letters.collect::<Vec<_>>().join(", ")
            ));
        }
        Ok(())
    }

    /// Writes the scores side by side into `folder`: all of them for programs, and a selection for pages and papers.
    pub(crate) fn write_scores(&self, folder: &Path) -> anyhow::Result<()> {
        let table = ScoreTable::of(&self.studies);
        let headlines = table.headlines();
        let simulated = self.studies.iter().filter(|study| study.is_simulated());
        let note = match simulated.count() {
            0 => "",
            _ => " Nothing here was measured where samples are simulated.",
        };
        let caption = format!("{}: scores with 95 % intervals.{note}", self.title);
        let main_caption = format!("{}: main scores.{note}", self.title);
        for (name, text) in [
            ("scores.csv", table.every_number().csv()),
            (
                "scores.md",
                format!("{caption}\n\n{}", headlines.for_pages().markdown()),
            ),
            (
                "scores.tex",
                headlines.for_papers(&caption).latex(Layout::Float),
            ),
            (
                "scores-main.tex",
                table.for_column(&main_caption).latex(Layout::Column),
            ),
        ] {
            let path = folder.join(name);
            output::write(Some(&path), |out| out.write_all(text.as_bytes()))?;
        }
        Ok(())
    }

    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let report = Report {
            title: &self.title,
            studies: &self.studies,
            pictures: &self.pictures,
            triples: &self.triples,
        };
        out.write_all(taceva_report::report(&report).as_bytes())
    }
}

/// A finished evaluation parsed from its JSON, with its samples.
pub(crate) fn study(report: &EvaluationReport) -> anyhow::Result<Study> {
    // Parsed as from a file, so that a page shows what others read.
    let mut studies = Study::read(&taceva_results::sealed(report)?)?;
    let mut study = studies.pop().context("one evaluation is one study")?;
    study.samples.clone_from(&report.samples);
    Ok(study)
}
