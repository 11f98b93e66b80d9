//! LaTeX as papers are set: with `pdflatex`, where it is installed.

use std::fs;
use std::process::Command;

/// What a table needs around it; the paper is wide enough for every one.
const HEAD: &str = "\\documentclass{article}\n\\usepackage{booktabs}\n\
                    \\pdfpagewidth=60cm\n\\textwidth=55cm\n\\begin{document}\n";

/// Fails unless `pdflatex` makes a page of `table` without an error; says so and goes on where there is none.
pub(crate) fn assert_compiles(name: &str, table: &str) {
    let folder = tempfile::tempdir().expect("a folder");
    let text = format!("{HEAD}{table}\\end{{document}}\n");
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
        }
        Ok(ran) => panic!("{name}: {}\n{table}", String::from_utf8_lossy(&ran.stdout)),
        Err(error) => print_skip(name, &error),
    }
}

#[expect(clippy::print_stderr, reason = "a skipped test says why")]
fn print_skip(name: &str, error: &std::io::Error) {
    eprintln!("skipped: {name} is not compiled, pdflatex: {error}");
}
