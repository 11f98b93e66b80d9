//! One-file pages: open from disk, need no network, and let nothing but their own style and script act.

mod base64;
mod document;
mod figures;
mod fold;
mod glance;
mod glossary;
mod left_out;
mod methods;
mod picks;
mod pictures;
mod place;
mod provenance;
mod published;
mod seeds;
mod studied;
mod summary;
mod tables;
mod themes;
mod triple;

pub use document::Document;
pub(crate) use figures::one as figure;
pub(crate) use fold::{counted, fold};
pub(crate) use glossary::{folded_glossary, glossary, metric_link, score_link};
pub use picks::{Pick, picks};
pub use pictures::Picture;
pub(crate) use summary::{QUESTIONS, badge, lead};
pub use triple::Triple;
pub(crate) use triple::cards as triples;

use crate::escape::html;
use crate::figures::figures as all_figures;
use crate::results::Study;
use crate::scores::ScoreTable;

/// What a report shows.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// What stands above it: the name of the scene or the recording.
    pub title: &'a str,
    /// The results.
    pub studies: &'a [Study],
    /// Pictures of samples, as [`picks`] asked for them; may be empty.
    pub pictures: &'a [Picture],
    /// What each sensor sees, untouched and pressed; may be empty.
    pub triples: &'a [Triple],
}

/// The report as one HTML file.
///
/// It opens from disk, asks for nothing from outside, and its content security policy allows nothing but its own style and script, whose
/// digests it names. The same results give the same bytes.
pub fn report(report: &Report<'_>) -> String {
    let studies = report.studies;
    let mut document = Document::new(report.title);
    if studies.is_empty() {
        document.section(
            "summary",
            "Summary",
            "<p>There is no sensor in these results.</p>",
        );
        return document.finish();
    }
    let table = ScoreTable::of(studies);
    let figures = all_figures(studies);
    document.lead(badge(studies));
    let summary = format!(
        "<p class=\"studied\">{}</p>\n{}{}",
        html(&studied::studied(studies)),
        triples(studies, report.triples),
        summary::section(studies, &table)
    );
    document.section("summary", "Summary", &summary);
    if let Some(section) = glance::section(&table, &figures) {
        document.section("glance", "At a glance", &section);
    }
    document.section(
        "themes",
        "Scores and figures",
        &themes::section(&table, &figures),
    );
    if let Some((count, section)) = published::section(studies) {
        let holds = fold::counted(count, "number");
        let title = "Scores beside published ones of the same sensor";
        let section = fold("published-all", title, &holds, &section);
        document.section("published", "Published", &section);
    }
    if let Some((count, section)) = seeds::section(studies) {
        let holds = fold::counted(count, "score");
        let title = "Scores over the seeds of the training";
        let section = fold("seeds-all", title, &holds, &section);
        document.section("seeds", "Seeds", &section);
    }
    if let Some((count, section)) = pictures::section(report) {
        let holds = fold::counted(count, "sample");
        let section = fold(
            "samples-all",
            "The samples predicted worst and best",
            &holds,
            &section,
        );
        document.section("samples", "Samples", &section);
    }
    document.section("methods", "Methods", &methods::section(studies, &table));
    document.section("details", "Details", &details(studies, &table));
    document.finish()
}

/// What only some readers look for: what metrics mean, what was left out, and where all comes from.
fn details(studies: &[Study], table: &ScoreTable) -> String {
    let named = table.rows.iter().map(|row| row.metric.as_str());
    let (count, left_out) = left_out::section(studies);
    [
        folded_glossary(named),
        fold(
            "left-out",
            "Skipped scores and remarks",
            &fold::counted(count, "entry").replace("entrys", "entries"),
            &left_out,
        ),
        fold(
            "provenance",
            "Provenance",
            "digests, settings, seeds, and methods of intervals",
            &provenance::section(studies, table),
        ),
    ]
    .concat()
}
