//! List of skipped tests: one line per skip, in a file of the target folder, because test runners hide the output.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};

use crate::Need;

/// Name of the list in the target folder.
pub const LIST: &str = "skipped-tests.tsv";

/// Adds a line to the list: need, reason, test program and test, with tabs between them.
///
/// # Panics
/// If the file cannot be written, so that every skip is noticed.
pub(crate) fn record(need: Need, reason: &str) {
    let program = std::env::current_exe().expect("a test knows where it is");
    let thread = std::thread::current();
    let line = line(need, reason, &program, thread.name().unwrap_or_default());
    let list = list(&program);
    // A single append, so that lines of several tests do not mix.
    OpenOptions::new()
        .create(true)
        .append(true)
        .open(&list)
        .and_then(|mut file| file.write_all(line.as_bytes()))
        .unwrap_or_else(|error| panic!("cannot write {}: {error}", list.display()));
}

/// Environment variable with the path of the list. `.ci/test` sets the variable and reads the list.
const LIST_VARIABLE: &str = "TACEVA_SKIPPED";

/// Path of the list: from the environment, or beside the build output.
fn list(program: &Path) -> PathBuf {
    match std::env::var_os(LIST_VARIABLE) {
        Some(list) => list.into(),
        None => beside_what_was_built(program),
    }
}

/// Path in the build's target folder, found by cargo's tag file. Without such a folder, for example after a restore from an archive, the path is
/// beside the program.
fn beside_what_was_built(program: &Path) -> PathBuf {
    let above = program.ancestors().skip(1);
    let target = above
        .clone()
        .find(|folder| folder.join("CACHEDIR.TAG").is_file());
    let folder = target.or(above.clone().next());
    folder.unwrap_or(Path::new(".")).join(LIST)
}

fn line(need: Need, reason: &str, program: &Path, test: &str) -> String {
    let name = program.file_stem().unwrap_or_default().to_string_lossy();
    // Cargo appends a hash to the name of a test program.
    let name = name.rsplit_once('-').map_or(&*name, |(name, _)| name);
    let [reason, name, test] = [reason, name, test].map(plain);
    format!("{need}\t{reason}\t{name}\t{test}\n")
}

/// `text` without line breaks and tabs.
fn plain(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_skip_is_one_line_with_four_columns_whatever_its_reason_holds() {
        let program = Path::new("/t/debug/deps/power_cut-0a1b2c");
        let line = line(Need::Strace, "not\tthere:\nno such file", program, "a_cut");
        assert_eq!(line, "strace\tnot there: no such file\tpower_cut\ta_cut\n");
    }

    #[test]
    fn the_list_lies_in_the_folder_that_cargo_marks_or_else_beside_the_program() {
        let target = std::env::temp_dir().join(format!("taceva-needs-{}", std::process::id()));
        let program = target.join("debug/deps/power_cut-0a1b2c");
        std::fs::create_dir_all(target.join("debug/deps")).expect("a folder");
        let unmarked = beside_what_was_built(&program);
        assert_eq!(unmarked, target.join("debug/deps").join(LIST));
        std::fs::write(target.join("CACHEDIR.TAG"), "").expect("a file");
        assert_eq!(beside_what_was_built(&program), target.join(LIST));
        std::fs::remove_dir_all(&target).expect("our own folder");
    }
}
