//! Tests of reports that need several modules.

mod accept;
mod browser;
mod compare;
mod glossary;
mod golden;
mod hostile;
mod latex;
mod main_table;
mod nouns;
mod paper;
mod paper_form;
mod pdf;
mod pdf_file;
mod radars;
mod reports;
#[path = "../support/mod.rs"]
mod support;
mod task_comparison;
mod task_page;
mod values;
mod verdicts;
