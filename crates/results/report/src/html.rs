//! HTML pages of one file, which browsers open from disk. A page makes no network requests and runs only its own style and script.

mod comparison;
mod data_address;
mod document;
mod faults;
mod figures;
mod glance;
mod groups;
mod left_out;
mod methods;
mod metrology;
mod picks;
mod pictures;
mod place;
mod provenance;
mod published;
mod seeds;
mod sensor_summary;
mod summary;
mod tables;
mod tasks;
mod themes;
mod triple;

pub(crate) use data_address::address as picture_address;
pub(crate) use document::Document;
pub use faults::fault_page;
pub(crate) use figures::{one as drawn, radars};
pub use picks::{Pick, picks};
pub use pictures::Picture;
pub(crate) use summary::{badge, lead};
pub use triple::Triple;
pub(crate) use triple::cards as triples;

use maud::{Markup, html};
use taceva_core::counted;

use crate::figures::figures as all_figures;
use crate::markup::{fold, folded_glossary};
use crate::results::Study;
use crate::scores::ScoreTable;
use crate::training;

/// Content of a report.
#[derive(Clone, Copy, Debug)]
pub struct ReportPage<'a> {
    /// Title of the page: name of the scene or of the recording.
    pub title: &'a str,
    /// Results of the report.
    pub studies: &'a [Study],
    /// Frames of the samples that [`picks`] selects; may be empty.
    pub pictures: &'a [Picture],
    /// Frames of each sensor, untouched and pressed; may be empty.
    pub triples: &'a [Triple],
}

/// Renders a report as one HTML file.
///
/// The page opens from disk without external requests. The content security policy of the page allows only its own style and script, by digest. Equal results
/// give equal bytes.
pub fn report(report: &ReportPage<'_>) -> String {
    let studies = report.studies;
    if studies.is_empty() {
        let mut document = Document::new(report.title, Markup::default());
        let nothing = html! { p { "There is no sensor in these results." } };
        document.section("summary", "Summary", nothing);
        return document.finish();
    }
    let table = ScoreTable::of(studies);
    let figures = all_figures(studies);
    let mut document = Document::new(report.title, badge(studies));
    let summary = html! {
        p.studied { (sensor_summary::studied(studies)) } "\n"
        @for words in [training::demonstration(studies), published::order(studies)].into_iter().flatten() {
            p.note { (words) } "\n"
        }
        (triples(studies, report.triples))
        (summary::section(studies, &table))
    };
    document.section("summary", "Summary", summary);
    if let Some(section) = glance::section(studies, &table, &figures) {
        document.section("glance", "At a glance", section);
    }
    let themes = themes::section(&table, &figures);
    document.section("themes", "Scores and figures", themes);
    if let Some((count, section)) = tasks::section(studies) {
        let title = "Scores of tasks, such as slip";
        let section = fold("tasks-all", title, &counted(count, "score"), &section);
        document.section("tasks", "Tasks", section);
    }
    if let Some(section) = metrology::section(studies) {
        document.section("metrology", "Metrology", section);
    }
    if let Some((count, section)) = published::section(studies) {
        let title = "Scores beside published ones of the same sensor";
        let section = fold("published-all", title, &counted(count, "number"), &section);
        document.section("published", "Published", section);
    }
    if let Some((count, section)) = groups::section(studies) {
        let title = "Errors of each group of the split";
        let section = fold("groups-all", title, &counted(count, "group"), &section);
        document.section("groups", "Groups", section);
    }
    if let Some((count, section)) = seeds::section(studies) {
        let title = "Scores over the seeds of the training";
        let section = fold("seeds-all", title, &counted(count, "score"), &section);
        document.section("seeds", "Seeds", section);
    }
    if let Some((count, section)) = pictures::section(report) {
        let title = "The samples predicted worst and best";
        let section = fold("samples-all", title, &counted(count, "sample"), &section);
        document.section("samples", "Samples", section);
    }
    if let Some(section) = faults::section(studies) {
        document.section("faults", "Faults", section);
    }
    document.section("methods", "Methods", methods::section(studies, &table));
    document.section("details", "Details", details(studies, &table));
    document.finish()
}

/// Section with meanings of metrics, skipped scores, and provenance.
fn details(studies: &[Study], table: &ScoreTable) -> Markup {
    let named = table.rows.iter().map(|row| row.metric.as_str());
    let (count, left_out) = left_out::section(studies);
    let entries = counted(count, "entry");
    let provenance = provenance::section(studies, table);
    let holds = "digests, settings, seeds, and methods of intervals";
    html! {
        (folded_glossary(named))
        (fold("left-out", "Skipped scores and remarks", &entries, &left_out))
        (fold("provenance", "Provenance", holds, &provenance))
    }
}
