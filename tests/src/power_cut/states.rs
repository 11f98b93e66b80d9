//! Every possible state after a power cut.

use std::ops::Range;
use std::path::Path;

use super::remains::Choices;
use super::seen::Seen;
use super::trace::Trace;
use super::tree::{Tree, write_tree};

/// State after one power cut.
#[derive(Debug)]
pub struct State<'a> {
    /// Number of operations before the cut.
    pub cut: usize,
    /// Lines that the program had printed before the cut.
    pub printed: &'a [String],
    /// Content of the folder after the restart.
    pub tree: &'a Tree,
}

impl State<'_> {
    /// Writes the state to the folder at `path`, which must be empty.
    ///
    /// # Errors
    /// Errors of writing.
    pub fn write_to(&self, path: &Path) -> std::io::Result<()> {
        write_tree(self.tree, path)
    }

    /// The bytes of a file; `None` for a missing file.
    pub fn file(&self, path: &str) -> Option<&[u8]> {
        Some(self.tree.get(path)?.as_ref()?.as_slice())
    }

    /// Highest number among the printed lines `ACK n`; 0 without one.
    pub fn acknowledged(&self) -> usize {
        self.printed
            .iter()
            .filter_map(|line| line.strip_prefix("ACK ")?.parse().ok())
            .max()
            .unwrap_or(0)
    }
}

/// Results of checking all states.
#[derive(Debug, Default)]
pub struct Counted {
    /// Number of power cuts.
    pub cuts: usize,
    /// Number of distinct states; a state shared by two cuts counts once.
    pub states: usize,
    /// Number of cuts with more combinations than were tried.
    pub capped: usize,
    /// Number of states for which the check failed.
    pub violations: usize,
    /// First violation: operation and cause.
    pub first: Option<String>,
}

impl Counted {
    /// Sum of the results of two searches. Keeps the first violation.
    #[must_use]
    pub fn and(self, other: Counted) -> Counted {
        Counted {
            cuts: self.cuts + other.cuts,
            states: self.states + other.states,
            capped: self.capped + other.capped,
            violations: self.violations + other.violations,
            first: self.first.or(other.first),
        }
    }
}

impl std::fmt::Display for Counted {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Counted {
            cuts,
            states,
            capped,
            violations,
            first,
        } = self;
        write!(f, "{cuts} cuts, {states} states, {violations} violations")?;
        if *capped > 0 {
            write!(f, ", {capped} cuts not in full")?;
        }
        match first {
            Some(first) => write!(f, "; first: {first}"),
            None => Ok(()),
        }
    }
}

impl Trace {
    /// Calls `check` with every state that a power cut could leave, at each number of operations in `cuts`. An error of `check` means a broken
    /// promise.
    pub fn each_state(
        &self,
        cuts: Range<usize>,
        mut check: impl FnMut(&State<'_>) -> Result<(), String>,
    ) -> Counted {
        let mut disk = self.after(cuts.start);
        let mut seen = Seen::default();
        let mut counted = Counted::default();
        for cut in cuts {
            counted.cuts += 1;
            let choices = Choices::of(&disk, cut);
            counted.capped += usize::from(choices.is_capped());
            choices.each(|picked| {
                let Some(tree) = seen.new_tree(&disk, picked) else {
                    return;
                };
                counted.states += 1;
                let state = State {
                    cut,
                    printed: disk.printed(),
                    tree: &tree,
                };
                if let Err(problem) = check(&state) {
                    counted.violations += 1;
                    counted.first.get_or_insert_with(|| {
                        let last = cut.checked_sub(1).map(|last| short(&self.operations[last]));
                        format!(
                            "after operation {cut} ({}): {problem}",
                            last.unwrap_or_default()
                        )
                    });
                }
            });
            if let Some(operation) = self.operations.get(cut) {
                disk.apply(operation);
            }
        }
        counted
    }
}

/// Short text that identifies an operation in the trace.
fn short(operation: &super::Operation) -> String {
    let text = format!("{operation:?}");
    text.chars().take(120).collect()
}
