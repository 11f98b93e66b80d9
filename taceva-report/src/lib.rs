#![doc = include_str!("../README.md")]

mod accept;
pub mod catalogue;
mod choose;
mod compare;
mod escape;
mod figure;
mod figures;
mod html;
mod json;
mod listing;
mod number;
mod results;
mod samples;
mod table;

pub use accept::{ACCEPTANCE_SCHEMA, Acceptance, Finding, Limit, LimitsError, LimitsFile, accept};
pub use choose::{
    Bound, CHOICE_SCHEMA, Candidate, Choice, Dropped, Need, NeedError, Property, Step, choose,
};
pub use compare::{Answer, COMPARISON_SCHEMA, CompareRequest, Comparison, compare};
pub use escape::{
    csv as escape_csv, html as escape_html, latex as escape_latex, markdown as escape_markdown,
    terminal as escape_terminal,
};
pub use figure::{DARK, Figure, LIGHT, SERIES, STYLE};
pub use figures::{Contender, Race, figures, names, race};
pub use html::{Document, Pick, Picture, Report, picks, report};
pub use listing::Listing;
pub use number::{Printed, spaced, with_interval};
pub use results::{
    EVALUATION_SCHEMA, Interval, RUN_SCHEMA, ResultsError, Score, Skip, Study, Value, Variant,
};
pub use samples::{SampleChannel, Samples, SamplesError};
pub use table::{ScoreCell, ScoreRow, ScoreTable, csv, latex, markdown};
