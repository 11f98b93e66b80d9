//! Results in the layout of the TacEva study: its tables, with published numbers next to results of this program.

mod beside;
mod contradictions;
mod figures;
mod tables;

use crate::figures::StudyFigures;
use crate::results::Study;
use crate::scores::ScoreTable;
use crate::table::{Layout, Table};
use beside::SENSORS;

/// Tables of a run in the layout of the TacEva study.
///
/// # Units
/// Units of the study: mm, N, mm/N, megapixels (MP) and Hz; robustness to lighting in percent.
///
/// ```
/// use taceva_report::paper_form;
/// let form = paper_form(&[]);
/// assert!(form.tables.is_empty() && form.absent.len() == 5);
/// ```
#[derive(Clone, Debug, Default)]
pub struct PaperForm {
    /// Tables with at least one value, each with its name: `table-2`.
    pub tables: Vec<(String, Table)>,
    /// Tables without any value, each with the reason.
    pub absent: Vec<(String, String)>,
    /// Published values of figures, next to results of this program, each with the name of the figure: `figure-3c`.
    pub figures: Vec<(String, Table)>,
    /// Contradictions in the TacEva study, one sentence each.
    pub contradictions: Vec<String>,
}

/// Tables I to V of the TacEva study and the numbers of its figures, for `studies`. Sensors of the study come first, in the order of the study.
pub fn paper_form(studies: &[Study]) -> PaperForm {
    let ordered = in_order(studies);
    let scores = ScoreTable::of(&ordered);
    let mut form = PaperForm::default();
    for made in tables::all(&ordered, &scores) {
        let name = format!("table-{}", made.number);
        match made.table {
            Some(table) => form.tables.push((name, table)),
            None => form.absent.push((name, format!("needs {}", made.needs))),
        }
    }
    form.figures = figures::all(&ordered, &scores);
    form.contradictions = match form.tables.is_empty() {
        true => Vec::new(),
        false => contradictions::all(),
    };
    form
}

/// Studies, with the sensors of the TacEva study first.
fn in_order(studies: &[Study]) -> Vec<Study> {
    let place = |study: &Study| {
        let known = SENSORS.iter().position(|name| *name == study.sensor);
        known.unwrap_or(SENSORS.len())
    };
    let mut ordered = studies.to_vec();
    ordered.sort_by_key(place);
    ordered
}

impl PaperForm {
    /// All tables, including the tables of figures, and all contradictions as one LaTeX text. Each table fits a page of two columns.
    pub fn latex(&self) -> String {
        let tables = self
            .tables
            .iter()
            .chain(&self.figures)
            .map(|(_, table)| table.latex(Layout::Paper));
        let mut out: String = tables.collect::<Vec<_>>().join("\n");
        for said in &self.contradictions {
            out += &format!("\n% {}\n", said.replace(['\n', '\r'], " "));
        }
        out
    }

    /// Figures of the TacEva study as Markdown: drawn figures with caption and published numbers, other figures with the reason. Images are SVG
    /// files next to the text.
    pub fn markdown_of(&self, figures: &StudyFigures) -> String {
        let mut out = String::new();
        for figure in &figures.drawn {
            let [title, caption] =
                [&figure.title, &figure.caption].map(|text| crate::escape::markdown(text));
            out += &format!(
                "## {title}\n\n![{title}]({}.svg)\n\n{caption}\n\n",
                figure.id
            );
            let mut numbers = self.figures.iter();
            if let Some((_, table)) = numbers.find(|(name, _)| *name == figure.id) {
                let caption = crate::escape::markdown(&table.caption);
                out += &format!("**{caption}**\n\n{}\n", table.markdown());
            }
        }
        if !figures.drawn.is_empty() {
            out += &format!("{}\n", figures::UNPRINTED);
        }
        for (name, reason) in &figures.absent {
            out += &format!("\n{name} is absent: {reason}\n");
        }
        out
    }

    /// Tables and contradictions as Markdown.
    pub fn markdown(&self) -> String {
        let mut out = String::new();
        for (_, table) in &self.tables {
            let caption = crate::escape::markdown(&table.caption);
            out += &format!("**{caption}**\n\n{}\n", table.markdown());
        }
        if !self.contradictions.is_empty() {
            out += "Where the study contradicts itself:\n\n";
        }
        for said in &self.contradictions {
            out += &format!("- {}\n", crate::escape::markdown(said));
        }
        for (name, reason) in &self.absent {
            out += &format!("\n{name} is absent: {reason}\n");
        }
        out
    }
}
