//! Compiles LaTeX as in papers, with `pdflatex` and `lualatex` if installed.

use std::fs;
use std::process::Command;

use taceva_needs::{Need, skip};

/// LaTeX preamble for a table, on paper wide enough for all tables.
const HEAD: &str = "\\documentclass{article}\n\\usepackage{booktabs}\n\
                    \\pdfpagewidth=60cm\n\\textwidth=55cm\n\\begin{document}\n";

/// Preamble of a two-column paper, with columns 252 pt wide.
const COLUMNS: &str = "\\documentclass[10pt,twocolumn]{article}\n\\usepackage{booktabs}\n\
                       \\textwidth=516pt\n\\columnsep=12pt\n\\oddsidemargin=-20pt\n\\begin{document}\n";

/// Preamble of an IEEE journal, whose columns are also 252 pt wide, in a narrower font.
#[allow(dead_code, reason = "another test program has no table for a column")]
const JOURNAL: &str =
    "\\documentclass[journal]{IEEEtran}\n\\usepackage{booktabs}\n\\begin{document}\n";

/// Fails unless `pdflatex` compiles `table` without an error. Skips the check without `pdflatex`.
pub(crate) fn assert_compiles(name: &str, table: &str) {
    compile("pdflatex", name, HEAD, table);
}

/// As [`assert_compiles`], in a column of `article` and of `IEEEtran`; nothing may exceed its width.
#[allow(dead_code, reason = "another test program has no table for a column")]
pub(crate) fn assert_fits_a_column(name: &str, table: &str) {
    for head in [COLUMNS, JOURNAL] {
        fits("pdflatex", name, head, table);
    }
}

/// As [`assert_fits_a_column`], with LuaLaTeX in a column of `IEEEtran`.
#[allow(dead_code, reason = "another test program has no table for a column")]
pub(crate) fn assert_fits_by_lualatex(name: &str, table: &str) {
    fits("lualatex", name, JOURNAL, table);
}

#[allow(dead_code, reason = "another test program has no table for a column")]
fn fits(engine: &str, name: &str, head: &str, table: &str) {
    if head == JOURNAL && !has_journal() {
        skip(Need::Latex, "IEEEtran.cls is not installed");
        return;
    }
    if let Some(log) = compile(engine, name, head, table) {
        assert!(
            !log.contains("Overfull"),
            "{engine}, {name}: {log}\n{table}"
        );
    }
}

#[allow(dead_code, reason = "another test program has no table for a column")]
fn has_journal() -> bool {
    let found = Command::new("kpsewhich").arg("IEEEtran.cls").output();
    found.is_ok_and(|found| found.status.success())
}

/// Log of `engine` for `table` after `head`; `None` if the engine is not installed.
fn compile(engine: &str, name: &str, head: &str, table: &str) -> Option<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let text = format!("{head}{table}\\end{{document}}\n");
    fs::write(folder.path().join("table.tex"), text).expect("written");
    let ran = Command::new(engine)
        .args(["-interaction=nonstopmode", "-halt-on-error", "table.tex"])
        .current_dir(folder.path())
        .output();
    match ran {
        Ok(ran) if ran.status.success() => {
            let log = fs::read(folder.path().join("table.log")).unwrap_or_default();
            let log = String::from_utf8_lossy(&log).into_owned();
            assert!(!log.contains("Missing character"), "{name}: {log}");
            assert!(folder.path().join("table.pdf").is_file(), "{name}");
            Some(log)
        }
        Ok(ran) => panic!(
            "{engine}, {name}: {}\n{table}",
            String::from_utf8_lossy(&ran.stdout)
        ),
        Err(error) => {
            skip(Need::Latex, format!("{engine}: {error}"));
            None
        }
    }
}
