//! One-file pages: open from disk, need no network, and let nothing but their own style and script act.

mod base64;
mod document;
mod figures;
mod left_out;
mod pictures;
mod provenance;
mod summary;
mod tables;

pub use document::Document;
pub(crate) use figures::one as figure;
pub use pictures::{Pick, Picture, picks};
pub(crate) use summary::lead;

use crate::figures::figures as all_figures;
use crate::results::Study;
use crate::table::ScoreTable;

/// What a report shows.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// What stands above it: the name of the scene or the recording.
    pub title: &'a str,
    /// The results.
    pub studies: &'a [Study],
    /// Pictures of samples, as [`picks`] asked for them; may be empty.
    pub pictures: &'a [Picture],
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
    document.lead(&summary::lead(studies));
    document.section("summary", "Summary", &summary::section(studies, &table));
    document.section("scores", "Scores", &tables::section(&table));
    document.section("figures", "Figures", &figures::section(&figures));
    if let Some(section) = pictures::section(report) {
        document.section("samples", "Worst and best samples", &section);
    }
    document.section(
        "left-out",
        "Left out, and to be minded",
        &left_out::section(studies),
    );
    document.section(
        "provenance",
        "Where it comes from",
        &provenance::section(studies, &table),
    );
    document.finish()
}
