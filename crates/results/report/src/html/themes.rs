//! Scores and figures by theme, with each theme folded.

use maud::{Markup, html};
use taceva_core::counted;
use taceva_metrics::{Theme, catalogue};

use super::figures::{is_radar, one as figure};
use super::tables::table;
use crate::figure::Figure;
use crate::markup::fold;
use crate::scores::{ScoreRow, ScoreTable};

/// Section of the page: a theme of the catalogue, or the label distributions.
struct Section {
    id: &'static str,
    title: &'static str,
    theme: Option<Theme>,
    /// Prefixes of the ids of the figures in the section.
    figures: &'static [&'static str],
}

/// Sections in report order. Other themes follow them.
const SECTIONS: [Section; 6] = [
    Section {
        id: "asked",
        title: "Label distributions",
        theme: None,
        figures: &["labels"],
    },
    of_theme(
        Theme::Accuracy,
        &["predicted-", "bias", "tolerance", "crosstalk"],
    ),
    of_theme(Theme::Detail, &["resolution"]),
    of_theme(Theme::Surface, &["sensitivity"]),
    of_theme(
        Theme::Robustness,
        &[
            "distance",
            "depth",
            "lighting",
            "repeatability",
            "hysteresis",
            "units",
        ],
    ),
    of_theme(Theme::Camera, &[]),
];

const fn of_theme(theme: Theme, figures: &'static [&'static str]) -> Section {
    Section {
        id: theme.id(),
        title: theme.title(),
        theme: Some(theme),
        figures,
    }
}

/// All headline scores and all figures except radar charts, by theme, followed by all rows.
pub(super) fn section(table: &ScoreTable, figures: &[Figure]) -> Markup {
    let headlines = table.headlines();
    let (mut rows_left, mut figures_left): (Vec<&ScoreRow>, Vec<&Figure>) = (
        headlines.rows.iter().collect(),
        figures.iter().filter(|figure| !is_radar(figure)).collect(),
    );
    let mut folds = Vec::new();
    for section in &SECTIONS {
        let (rows, others) = rows_left
            .into_iter()
            .partition(|row| section.has_metric(row));
        let (drawn, others_drawn) = figures_left
            .into_iter()
            .partition(|drawn| section.has_figure(drawn));
        (rows_left, figures_left) = (others, others_drawn);
        folds.extend(one(
            section.id,
            section.title,
            &headlines.names,
            &rows,
            &drawn,
        ));
    }
    folds.extend(one(
        "other",
        "Other",
        &headlines.names,
        &rows_left,
        &figures_left,
    ));
    if table.rows.len() > headlines.rows.len() {
        let all: Vec<&ScoreRow> = table.rows.iter().collect();
        let holds = format!(
            "all {}: every channel and every variant",
            counted(all.len(), "row")
        );
        let all = self::table("all", "Every score", &table.names, &all);
        folds.push(fold("theme-all", "Every score", &holds, &all));
    }
    html! {
        p.note {
            "Below each value its 95 % interval and n. "
            @if table.names.len() > 1 {
                "Bold: shown to be better than every other " (table.noun) " that takes part in verdicts, at a level of 5 % after Holm's adjustment over the metric. "
            }
            "Columns sort. "
            "Point at a mark of a figure for its value and n, or step through its marks with the arrow keys."
        } "\n"
        p.screen { button.act type="button" data-unfold hidden { "Unfold everything" } } "\n"
        @if table.rows.is_empty() { p { "There is no score in these results." } }
        @if figures.is_empty() { p { "There is nothing to draw: no score has a map or a curve, and there are no samples." } }
        @for fold in &folds { (fold) }
    }
}

impl Section {
    fn has_metric(&self, row: &ScoreRow) -> bool {
        let id = row.metric.split('.').next().unwrap_or_default();
        let theme = catalogue::find(id).map(|metric| metric.theme);
        theme.is_some() && theme == self.theme
    }

    fn has_figure(&self, figure: &Figure) -> bool {
        let starts = self.figures.iter();
        starts.into_iter().any(|start| figure.id.starts_with(start))
    }
}

/// Folded section of a theme; `None` without rows and figures.
fn one(
    id: &str,
    title: &str,
    names: &[String],
    rows: &[&ScoreRow],
    figures: &[&Figure],
) -> Option<Markup> {
    let holds = [(rows.len(), "score"), (figures.len(), "figure")];
    let holds = holds.into_iter().filter(|(count, _)| *count > 0);
    let holds: Vec<String> = holds.map(|(count, what)| counted(count, what)).collect();
    let body = html! {
        (table(id, title, names, rows))
        @for drawn in figures { (figure(drawn)) }
    };
    (!holds.is_empty()).then(|| fold(&format!("theme-{id}"), title, &holds.join(", "), &body))
}
