//! Runs the commands of passages and compares their output.

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
    /// Folder that is searched first for programs.
    programs: PathBuf,
    out: TempDir,
}

/// Difference between a passage and the output of its command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// First differing line of the passage; `None` if it has fewer lines.
    pub stands: Option<String>,
    /// Line of the output at the same place; `None` if the output has fewer lines.
    pub printed: Option<String>,
}

/// Reason for a command without output.
#[derive(Debug)]
pub enum RunnerError {
    /// The command cannot be run.
    Io(io::Error),
    /// The command failed, with this message.
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
    /// Prepares to run commands in the folder `root`. The path begins with the folder `programs` and the folder `examples` within it.
    ///
    /// # Errors
    /// If no output folder can be created.
    pub fn new(root: &Path, programs: &Path) -> io::Result<Runner> {
        Ok(Runner {
            root: root.to_owned(),
            programs: programs.to_owned(),
            out: tempfile::tempdir()?,
        })
    }

    /// Output of `command`, without the path of the folder `$OUT`.
    ///
    /// # Errors
    /// [`RunnerError`] if the command cannot be run or fails.
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
            // No cache of an earlier run, and no terminal width.
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

    /// Difference between `passage` of `text` and the output of its command.
    ///
    /// # Errors
    /// Errors of [`run`](Runner::run).
    pub fn compare(
        &self,
        passage: &Passage,
        text: &str,
    ) -> Result<Option<Difference>, RunnerError> {
        let fresh = passage.renewed(text, &self.run(&passage.command)?);
        Ok(difference(passage.content(text), &fresh))
    }
}

/// First differing line of two passages.
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
