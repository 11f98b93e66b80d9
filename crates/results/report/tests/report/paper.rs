//! LaTeX as papers are set: with `pdflatex`, where it is installed.

use std::fs;
use std::process::Command;

use taceva_needs::{Need, skip};

/// LaTeX preamble for a table, on paper wide enough for all tables.
const HEAD: &str = "\\documentclass{article}\n\\usepackage{booktabs}\n\
                    \\pdfpagewidth=60cm\n\\textwidth=55cm\n\\begin{document}\n";

/// Preamble of a two-column paper, with columns 252 pt wide.
const COLUMNS: &str = "\\documentclass[10pt,twocolumn]{article}\n\\usepackage{booktabs}\n\
                       \\textwidth=516pt\n\\columnsep=12pt\n\\oddsidemargin=-20pt\n\\begin{document}\n";

/// Fails unless `pdflatex` compiles `table` without an error. Skips the check without `pdflatex`.
pub(crate) fn assert_compiles(name: &str, table: &str) {
    compile(name, HEAD, table);
}

/// As [`assert_compiles`], in a column of a paper: nothing may stand over its edge.
#[allow(dead_code, reason = "another test program has no table for a column")]
pub(crate) fn assert_fits_a_column(name: &str, table: &str) {
    if let Some(log) = compile(name, COLUMNS, table) {
        assert!(!log.contains("Overfull"), "{name}: {log}");
    }
}

/// Log of `pdflatex` for `table` behind `head`; `None` if it is not installed.
fn compile(name: &str, head: &str, table: &str) -> Option<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let text = format!("{head}{table}\\end{{document}}\n");
    fs::write(folder.path().join("table.tex"), text).expect("written");
    let ran = Command::new("pdflatex")
        .args(["-interaction=nonstopmode", "-halt-on-error", "table.tex"])
        .current_dir(folder.path())
        .output();
    match ran {
        Ok(ran) if ran.status.success() => {
            let log = fs::read_to_string(folder.path().join("table.log")).unwrap_or_default();
            assert!(!log.contains("Missing character"), "{name}: {log}");
            assert!(folder.path().join("table.pdf").is_file(), "{name}");
            Some(log)
        }
        Ok(ran) => panic!("{name}: {}\n{table}", String::from_utf8_lossy(&ran.stdout)),
        Err(error) => {
            skip(Need::Latex, format!("pdflatex: {error}"));
            None
        }
    }
}
