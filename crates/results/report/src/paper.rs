//! Results in the form in which the TacEva study printed its own: its tables with the printed numbers beside ours.

mod beside;
mod contradictions;
mod tables;

use crate::results::Study;
use crate::scores::ScoreTable;
use crate::table::{Layout, Table};

/// The tables of a run in the form of the TacEva study.
///
/// # Units
/// As the study prints them: mm, N, mm/N, MP, Hz; robustness to lighting in percent.
///
/// ```
/// use taceva_report::paper_form;
/// let form = paper_form(&[]);
/// assert!(form.tables.is_empty() && form.absent.len() == 5);
/// ```
#[derive(Clone, Debug, Default)]
pub struct PaperForm {
    /// The tables that hold any value, each with its name: `table-2`.
    pub tables: Vec<(String, Table)>,
    /// The tables that no result has a value for, each with its reason.
    pub absent: Vec<(String, String)>,
    /// Places in which the study contradicts itself.
    pub contradictions: Vec<String>,
}

/// The tables I to V of the study, of the sensors in `studies`: those that it measured first, in its order.
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
    form.contradictions = match form.tables.is_empty() {
        true => Vec::new(),
        false => contradictions::all(),
    };
    form
}

/// The sensors that the study measured, in the order of its tables.
const SENSORS: [&str; 4] = ["ViTacTip", "MagicTac", "GelSight", "GelSightWM"];

/// The studies, those of sensors of the paper first.
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
    /// Every table and every contradiction as one text of LaTeX.
    pub fn latex(&self) -> String {
        let tables = self
            .tables
            .iter()
            .map(|(_, table)| table.latex(Layout::Float));
        let mut out: String = tables.collect::<Vec<_>>().join("\n");
        for said in &self.contradictions {
            out += &format!("\n% {}\n", said.replace(['\n', '\r'], " "));
        }
        out
    }

    /// The same as Markdown.
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
