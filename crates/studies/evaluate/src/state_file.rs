//! Files with the sums behind the scores of a shard. Laboratories can exchange and merge such files. The scores equal those of one run over all
//! samples.

mod plan;

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::shown;
use taceva_files::seal::Edit;
use taceva_metrics::{Evaluation, Evaluator, State};

use crate::bounded_share::Bounded;
use crate::error::EvaluateError;
use crate::provenance;
use crate::row_ledger::Taken;
use plan::WrittenPlan;
use taceva_results::{Provenance, Subject};

/// Schema of a state file.
pub const STATE_SCHEMA: &str = "taceva.state/1.0";

/// Size limit of a state file, in bytes. It far exceeds the size of 64 clusters of every family.
const LARGEST: u64 = 1 << 30;

/// Accumulators of a plan after some samples, with everything needed to continue.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateFile {
    schema: String,
    pub(crate) subject: Subject,
    pub(crate) plan: WrittenPlan,
    pub(crate) provenance: Provenance,
    /// Counts of predictions beyond the label bounds of their model, if there are bounds.
    #[serde(default, skip_serializing_if = "Bounded::is_empty")]
    pub(crate) bounded: Bounded,
    /// True if the model was fitted on some of the samples.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) seen: bool,
    /// True if the training part has neighbours that resemble tested samples.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(crate) neighbours: bool,
    pub(crate) states: Vec<State>,
    #[serde(default)]
    pub(crate) taken: Vec<Taken>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    history: Vec<Edit>,
    #[serde(default, skip_serializing)]
    seal: Option<serde_json::Value>,
}

/// A state, the path from which it was read, and the digest of its content.
#[derive(Clone, Debug)]
pub struct ReadState {
    pub(crate) path: PathBuf,
    pub(crate) file: StateFile,
    pub(crate) digest: String,
}

impl StateFile {
    /// State of `evaluator`. The rows that it has counted are not recorded yet.
    ///
    /// # Errors
    /// [`EvaluateError::Scores`] for collected samples that the evaluator rejects.
    pub fn of(
        evaluator: &mut Evaluator,
        subject: &Subject,
        provenance: &Provenance,
        bounded: Bounded,
    ) -> Result<StateFile, EvaluateError> {
        Ok(StateFile {
            schema: STATE_SCHEMA.to_owned(),
            subject: subject.clone(),
            plan: WrittenPlan::of(evaluator.plan()),
            provenance: provenance.clone(),
            bounded,
            seen: provenance::is_of_seen_samples(provenance),
            neighbours: false,
            states: evaluator.states()?,
            taken: Vec::new(),
            history: Vec::new(),
            seal: None,
        })
    }

    /// Scores of `evaluator`, which has accumulated the samples of this state, with the shares of predictions beyond bounds. The scores are marked if
    /// the model was fitted on the samples.
    ///
    /// # Errors
    /// [`EvaluateError::Scores`] for collected samples that the evaluator rejects.
    pub(crate) fn finish(&self, evaluator: Evaluator) -> Result<Evaluation, EvaluateError> {
        let evaluation = evaluator.finish()?;
        let evaluation = evaluation.with_bounded_shares(&self.bounded.shares());
        let evaluation = match self.seen {
            true => evaluation.of_seen_samples(),
            false => evaluation,
        };
        Ok(match self.neighbours {
            true => evaluation.of_neighbours_in_training(),
            false => evaluation,
        })
    }

    /// Returns the state with `taken` as its counted rows.
    pub(crate) fn with_taken(self, taken: Vec<Taken>) -> StateFile {
        StateFile { taken, ..self }
    }

    /// Returns the state. `is_seen` marks a model that was fitted on some of the samples.
    pub(crate) fn with_seen(self, is_seen: bool) -> StateFile {
        StateFile {
            seen: self.seen || is_seen,
            ..self
        }
    }

    /// Returns the state. `are_learnt` marks a model whose training part has neighbours that resemble the samples.
    pub(crate) fn with_neighbours(self, are_learnt: bool) -> StateFile {
        StateFile {
            neighbours: self.neighbours || are_learnt,
            ..self
        }
    }

    /// True if the state counts all rows of its inputs, as opposed to some shards.
    pub fn is_whole(&self) -> bool {
        !self.taken.iter().any(Taken::is_of_shard)
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`EvaluateError::State`] for a file that is not a state file, has a newer schema, or was edited after it was sealed.
    pub fn read(path: &Path) -> Result<StateFile, EvaluateError> {
        ReadState::read(path).map(|read| read.file)
    }

    /// Writes the state as sealed JSON in one line.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let text = serde_json::to_string(self)?;
        writeln!(
            out,
            "{}",
            taceva_files::seal::json::seal(&text).map_err(io::Error::other)?
        )
    }
}

impl ReadState {
    /// Reads the state at `path`.
    ///
    /// # Errors
    /// Errors of [`StateFile::read`].
    pub fn read(path: &Path) -> Result<ReadState, EvaluateError> {
        let wrong = |problem: String| EvaluateError::State {
            path: path.to_owned(),
            problem,
        };
        let text = read_capped(path).map_err(|error| wrong(error.to_string()))?;
        let head: Head = serde_json::from_str(&text)
            .map_err(|error| wrong(format!("not a state file of an evaluation: {error}")))?;
        if head.schema != STATE_SCHEMA {
            return Err(wrong(format!(
                "its schema is `{}`, expected `{STATE_SCHEMA}`; write the state again by the same command with this version",
                shown(&head.schema)
            )));
        }
        let opened =
            taceva_files::seal::json::check(&text).map_err(|error| wrong(error.to_string()))?;
        let mut file: StateFile =
            serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let edits = file
            .history
            .drain(..)
            .map(|edit| format!("state {name}, {edit}"));
        file.provenance.edits.extend(edits);
        file.seal = None;
        Ok(ReadState {
            path: path.to_owned(),
            file,
            digest: opened.digest,
        })
    }
}

/// Beginning of the file, which contains only the schema and is read before the rest.
#[derive(Deserialize)]
pub(crate) struct Head {
    pub(crate) schema: String,
}

/// Text of the state file at `path`, which is a regular file of at most 1 GiB.
pub(crate) fn read_capped(path: &Path) -> io::Result<String> {
    let file = File::open(path)?;
    if !file.metadata()?.is_file() {
        return Err(io::Error::other("not a regular file"));
    }
    let mut text = String::new();
    file.take(LARGEST + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LARGEST {
        return Err(io::Error::other("larger than 1 GiB, expected a state file"));
    }
    Ok(text)
}
