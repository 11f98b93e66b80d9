//! Commands of passages, run, and what they print, compared.

use std::env;
use std::io;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::TempDir;

use super::passage::Passage;

/// Runs the commands of one document.
#[derive(Debug)]
pub struct Runner {
    root: PathBuf,
    /// Searched before all others.
    programs: PathBuf,
    out: TempDir,
}

/// A passage that is not what its command prints.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// The first line that differs as it stands there; none if there are fewer lines.
    pub stands: Option<String>,
    /// The same line as the command prints it.
    pub printed: Option<String>,
}

/// Why a command gave no passage.
#[derive(Debug)]
pub enum RunnerError {
    /// It cannot be run.
    Io(io::Error),
    /// It failed, and said this.
    Failed(String),
}

impl std::fmt::Display for RunnerError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            RunnerError::Io(error) => write!(f, "cannot be run: {error}"),
            RunnerError::Failed(said) => write!(f, "failed: {said}"),
        }
    }
}

impl std::error::Error for RunnerError {}

impl From<io::Error> for RunnerError {
    fn from(error: io::Error) -> RunnerError {
        RunnerError::Io(error)
    }
}

impl Runner {
    /// Runs commands in `root`, with the programs in the folder `programs` and its `examples` before all others.
    ///
    /// # Errors
    /// If no folder for what commands write can be made.
    pub fn new(root: &Path, programs: &Path) -> io::Result<Runner> {
        Ok(Runner {
            root: root.to_owned(),
            programs: programs.to_owned(),
            out: tempfile::tempdir()?,
        })
    }

    /// What `command` prints; the folder `$OUT` is written as nothing.
    ///
    /// # Errors
    /// [`RunnerError`] if it cannot be run or fails.
    pub fn run(&self, command: &str) -> Result<String, RunnerError> {
        let path = env::var_os("PATH").unwrap_or_default();
        let ours = [self.programs.clone(), self.programs.join("examples")];
        let folders = ours.into_iter().chain(env::split_paths(&path));
        let path = env::join_paths(folders).map_err(io::Error::other)?;
        let done = Command::new("bash")
            .args(["-c", &format!("set -eu -o pipefail\n{command}")])
            .current_dir(&self.root)
            .env("PATH", path)
            .env("OUT", self.out.path())
            // Nothing of an earlier run, and no width of a terminal.
            .env("XDG_CACHE_HOME", self.out.path().join("cache"))
            .env_remove("COLUMNS")
            .output()?;
        if !done.status.success() {
            let said = String::from_utf8_lossy(&done.stderr);
            let last: Vec<&str> = said.lines().rev().take(3).collect();
            let last: Vec<&str> = last.into_iter().rev().collect();
            return Err(RunnerError::Failed(last.join(" / ")));
        }
        let printed = String::from_utf8_lossy(&done.stdout);
        let folder = self.out.path().display().to_string();
        Ok(printed
            .replace(&format!("{folder}/"), "")
            .replace(&folder, "."))
    }

    /// How `passage` of `text` differs from what its command prints.
    ///
    /// # Errors
    /// As [`run`](Runner::run).
    pub fn compare(
        &self,
        passage: &Passage,
        text: &str,
    ) -> Result<Option<Difference>, RunnerError> {
        let fresh = passage.renewed(text, &self.run(&passage.command)?);
        Ok(difference(passage.content(text), &fresh))
    }
}

/// The first line in which two passages differ.
fn difference(stands: &str, printed: &str) -> Option<Difference> {
    let (mut stands, mut printed) = (stands.trim().lines(), printed.trim().lines());
    loop {
        match (stands.next(), printed.next()) {
            (None, None) => return None,
            (left, right) if left.map(str::trim_end) == right.map(str::trim_end) => {}
            (left, right) => {
                return Some(Difference {
                    stands: left.map(str::to_owned),
                    printed: right.map(str::to_owned),
                });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn passage(text: &str) -> Passage {
        Passage::all(text).expect("marks").remove(0)
    }

    #[test]
    fn a_passage_that_its_command_still_prints_does_not_differ_and_another_does() {
        let folder = tempfile::tempdir().expect("a folder");
        let runner = Runner::new(folder.path(), folder.path()).expect("a runner");
        let text = "<!-- from: echo one; echo 2.5 -->\n```\none\n2.5\n```\n<!-- end -->\n";
        assert_eq!(runner.compare(&passage(text), text).expect("it runs"), None);
        let other = text.replace("2.5\n```", "2.6\n```");
        let difference = runner.compare(&passage(&other), &other).expect("it runs");
        let difference = difference.expect("2.6 is not 2.5");
        assert_eq!(difference.stands.as_deref(), Some("2.6"));
        assert_eq!(difference.printed.as_deref(), Some("2.5"));
        let shorter = text.replace("2.5\n```", "```");
        assert!(
            runner
                .compare(&passage(&shorter), &shorter)
                .expect("it runs")
                .is_some()
        );
    }

    #[test]
    fn commands_of_a_document_share_a_folder_whose_name_no_passage_shows() {
        let folder = tempfile::tempdir().expect("a folder");
        let runner = Runner::new(folder.path(), folder.path()).expect("a runner");
        runner.run("echo 7 > $OUT/seven").expect("it runs");
        assert_eq!(
            runner
                .run("cat $OUT/seven; echo $OUT/seven")
                .expect("it runs"),
            "7\nseven\n"
        );
    }

    #[test]
    fn a_command_that_fails_gives_its_last_words_and_no_passage() {
        let folder = tempfile::tempdir().expect("a folder");
        let runner = Runner::new(folder.path(), folder.path()).expect("a runner");
        let error = runner
            .run("echo half; echo no such thing >&2; false")
            .expect_err("it fails");
        assert_eq!(error.to_string(), "failed: no such thing");
    }
}
