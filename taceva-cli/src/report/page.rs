//! Pages of finished evaluations, each in one file.

use std::collections::BTreeSet;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use taceva_core::shown;

use anyhow::Context as _;
use taceva_dataset::Dataset;
use taceva_report::{
    FaultResult, Figure, FigureStyle, Layout, Picture, ReportPage, ScoreTable, Study, Triple,
    device_table, figures_for, paper_form, picks, study_figures, undrawn,
};
use taceva_results::{EvaluationReport, not_measured};

use crate::args::Format;
use crate::context::Context;
use crate::output;

use super::thumbnail::{MEDIA_TYPE, thumbnail};
use super::triple::triple;

/// File name of the page in a report.
pub(crate) const PAGE: &str = "report.html";
/// Name of the folder of figures in a report.
const FIGURES: &str = "figures";

/// Name of the folder of tables and figures in the form of the TacEva study.
const LIKE_TACEVA: &str = "like-taceva";

/// Data for a page.
pub(crate) struct Page {
    title: String,
    studies: Vec<Study>,
    pictures: Vec<Picture>,
    triples: Vec<Triple>,
}

impl Page {
    /// Creates a page of `reports`. Adds pictures of the worst and best predicted samples if the recordings have frames.
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

    /// Adds the results of tests with faults, one for each study in order.
    pub(crate) fn with_faults(mut self, faults: Vec<Option<FaultResult>>) -> Page {
        for (study, faults) in self.studies.iter_mut().zip(faults) {
            study.faults = faults;
        }
        self
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

    /// Writes the page, all figures and all tables into `folder`. Returns the path of the page.
    pub(crate) fn write_files(
        &self,
        folder: &Path,
        style: &FigureStyle,
        context: &Context,
    ) -> anyhow::Result<PathBuf> {
        let page = folder.join(PAGE);
        output::write(Some(&page), |out| self.write(out))?;
        self.write_figures(&folder.join(FIGURES), style, context)?;
        self.write_scores(folder)?;
        Ok(page)
    }

    /// Writes every figure into `folder`, as standalone SVG and as PDF, and reports figures without values and letters that no font has.
    pub(crate) fn write_figures(
        &self,
        folder: &Path,
        style: &FigureStyle,
        context: &Context,
    ) -> anyhow::Result<()> {
        let figures = figures_for(&self.studies, style);
        write_figures(&figures, folder, context)?;
        let undrawn = undrawn(&self.studies, &figures);
        if !undrawn.is_empty() {
            let names: Vec<&str> = undrawn.iter().map(|(name, _)| name.as_str()).collect();
            let names = names.join(", ");
            context.say(format_args!(
                "figures without data are not written: {names} (-v prints the reasons)"
            ));
        }
        for (name, reason) in undrawn {
            context.say_more(format_args!("figure {name} is not drawn: {reason}"));
        }
        Ok(())
    }

    /// Writes the tables and figures of the TacEva study with its printed numbers next to the computed numbers, into a folder in `folder`.
    pub(crate) fn write_like_taceva(
        &self,
        folder: &Path,
        style: &FigureStyle,
        context: &Context,
    ) -> anyhow::Result<()> {
        let form = paper_form(&self.studies);
        let figures = study_figures(&self.studies, style);
        for (name, reason) in form.absent.iter().chain(&figures.absent) {
            context.say(format_args!("{name} of the study is absent: {reason}"));
        }
        if form.tables.is_empty() && figures.drawn.is_empty() {
            context.say(format_args!(
                "nothing is written in the form of the TacEva study, because these results have none of its scores; the scene of `taceva run paper` requests all"
            ));
            return Ok(());
        }
        let folder = folder.join(LIKE_TACEVA);
        fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", shown(&folder)))?;
        for (name, text) in [
            ("tables.tex", form.latex()),
            ("tables.md", form.markdown()),
            ("figures.md", form.markdown_of(&figures)),
        ] {
            output::write(Some(&folder.join(name)), |out| {
                out.write_all(text.as_bytes())
            })?;
        }
        write_figures(&figures.drawn, &folder, context)?;
        context.say(format_args!(
            "tables and figures of the study are in {}",
            shown(&folder)
        ));
        Ok(())
    }

    /// Writes the scores side by side into `folder`: all of them for programs, and a selection for pages and papers.
    pub(crate) fn write_scores(&self, folder: &Path) -> anyhow::Result<()> {
        let table = ScoreTable::of(&self.studies);
        let headlines = table.headlines();
        let sources = self.studies.iter().map(|study| study.source.as_str());
        let note = not_measured(sources).map_or_else(String::new, |words| format!(" {words}"));
        let caption = format!("{}: scores with 95 % intervals.{note}", self.title);
        let mut main = Vec::new();
        super::main_scores(&table, Format::Tex, None, &mut main)?;
        for (name, text) in [
            ("scores.csv", table.every_number().csv().into_bytes()),
            (
                "scores.md",
                format!("{caption}\n\n{}", headlines.for_pages().markdown()).into_bytes(),
            ),
            (
                "scores.tex",
                headlines
                    .for_papers(&caption)
                    .latex(Layout::Float)
                    .into_bytes(),
            ),
            ("scores-main.tex", main),
        ] {
            let path = folder.join(name);
            output::write(Some(&path), |out| out.write_all(&text))?;
        }
        self.write_devices(folder)
    }

    /// Writes the devices of measured recordings into `folder`, if a recording states a device.
    fn write_devices(&self, folder: &Path) -> anyhow::Result<()> {
        let Some(table) = device_table(&self.studies) else {
            return Ok(());
        };
        for (name, text) in [
            ("devices.csv", table.csv()),
            ("devices.md", table.markdown()),
            ("devices.tex", table.latex(Layout::Float)),
        ] {
            let path = folder.join(name);
            output::write(Some(&path), |out| out.write_all(text.as_bytes()))?;
        }
        Ok(())
    }

    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let report = ReportPage {
            title: &self.title,
            studies: &self.studies,
            pictures: &self.pictures,
            triples: &self.triples,
        };
        out.write_all(taceva_report::report(&report).as_bytes())
    }
}

/// Writes `figures` into `folder`, each as standalone SVG and as PDF, and reports letters that no font has.
pub(crate) fn write_figures(
    figures: &[Figure],
    folder: &Path,
    context: &Context,
) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", shown(folder)))?;
    let mut without_glyph = BTreeSet::new();
    for figure in figures {
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

/// Converts a finished evaluation to a study, with its samples.
pub(crate) fn study(report: &EvaluationReport) -> anyhow::Result<Study> {
    // Parsed like a file, so that a page shows the same data as other programs read.
    let mut studies = Study::read(&taceva_results::sealed(report)?)?;
    let mut study = studies.pop().context("one evaluation is one study")?;
    study.samples.clone_from(&report.samples);
    Ok(study)
}
