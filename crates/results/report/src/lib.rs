#![doc = include_str!("../README.md")]

mod accept;
mod bench;
mod budget;
mod budget_source;
pub mod catalogue;
mod choose;
mod compare;
mod contributions;
mod curve;
mod depth_zero;
mod devices;
mod escape;
mod faults;
mod figure;
mod figures;
mod gauge;
mod html;
mod light;
mod markup;
mod names;
mod number;
mod paper;
mod reference;
mod residuals;
mod results;
mod scores;
mod short_digests;
mod site;
mod spread;
mod table;
mod tables_page;
mod task_comparison;
mod task_result;
mod tasks;
mod tasks_page;
mod tie;
mod training;
mod variables;
mod wrap;

pub use accept::{
    ACCEPTANCE_SCHEMA, AcceptError, Acceptance, Limit, LimitCheck, LimitsError, LimitsFile,
    ProcessRisk, accept, add_process_risks, limits_template,
};
pub use budget::{BudgetReport, BudgetTemplate};
pub use choose::{
    Bound, CHOICE_SCHEMA, Candidate, Choice, Dropped, Evidence, Need, NeedError, Property, Step,
    choose, choose_results,
};
pub use compare::{
    Answer, COMPARISON_SCHEMA, CompareRequest, Comparison, Decision, OVERVIEW_LINES,
    OVERVIEW_WIDTH, RequestError, compare, ties,
};
pub use curve::{CURVE_SCHEMA, CalibrationCurve, CurveAxis, CurveFigure, CurveRequest};
pub use depth_zero::depth_zero_figure;
pub use devices::device_table;
pub use escape::{latex as escape_latex, markdown as escape_markdown, terminal as escape_terminal};
pub use faults::{FaultResult, main_channels};
pub use figure::{DARK, Figure, FigureStyle, LIGHT, SERIES, STYLE};
pub use figures::{
    Race, RacePoint, StudyFigures, figures, figures_for, model_bench, race, study_figures, undrawn,
};
pub use gauge::{ChannelGauge, GaugeColumns, GaugeStudies};
pub use html::{Pick, Picture, ReportPage, Triple, fault_page, picks, report};
pub use names::names;
pub use number::{FormattedValue, spaced, with_interval};
pub use paper::{PaperForm, paper_form};
pub use reference::reference_certificate;
pub use residuals::residual_components;
pub use results::{
    BENCH_SCHEMA, BenchMachine, BenchRecording, ChannelError, Fact, Made, ModelBench, ModelRow,
    Statement, Study,
};
pub use scores::{ScoreCell, ScoreRow, ScoreTable};
pub use short_digests::short_digests;
pub use site::{SitePage, site};
pub use table::{
    Align, Cell, Column, Direction, Estimate, Layout, Row, Table, Words, latex_number, latex_symbol,
};
pub use tables_page::{PagePart, PageSection, TablesPage};
pub use task_comparison::{TASK_COMPARISON_SCHEMA, TaskAnswer, TaskComparison};
pub use task_result::TaskResult;
pub use tasks::{task_numbers, task_table};
pub use tasks_page::task_page;
