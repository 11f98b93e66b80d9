//! What a shard has kept, as a file: written by one lab, joined by another, with the scores of one unsharded run.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use taceva_core::shown;

use serde::{Deserialize, Serialize};
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, Nanometre, Newton, Outline, Unit,
};
use taceva_metrics::{Evaluation, Evaluator, MetricPlan, SensorFacts, Settings, State, catalogue};
use taceva_seal::{Edit, Version};

use crate::bounded::Bounded;
use crate::error::StudyError;
use crate::provenance::Provenance;
use crate::report::EvaluationReport;
use crate::subject::Subject;
use crate::taken::{AllTaken, Taken};

/// The schema of a state file. A minor version only adds keys; since 1.1 a state is sealed and says which rows it took.
pub const STATE_SCHEMA: &str = "taceva.state/1.1";

/// The schema of states of before seals, which are read and marked.
const UNSEALED_SCHEMA: &str = "taceva.state/1";

/// The largest state file that is read: far above what 64 clusters of every family take.
const LARGEST: u64 = 1 << 30;

/// What some samples have left in the accumulators of a plan, with all that is needed to go on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StateFile {
    schema: String,
    subject: Subject,
    plan: WrittenPlan,
    provenance: Provenance,
    /// Predictions beyond the bounds of their model, where there are any bounds.
    #[serde(default, skip_serializing_if = "Bounded::is_empty")]
    bounded: Bounded,
    /// Whether the model was fitted on some of the samples.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    seen: bool,
    states: Vec<State>,
    #[serde(default)]
    taken: Vec<Taken>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    history: Vec<Edit>,
    #[serde(default, skip_serializing)]
    seal: Option<serde_json::Value>,
}

/// A state that was read, and the digest of what it says.
struct ReadState {
    file: StateFile,
    digest: String,
}

/// A plan as a file says it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenPlan {
    metrics: Vec<String>,
    channels: Vec<(String, Unit)>,
    fields: Vec<String>,
    seed: u64,
    footprint: Option<WrittenFootprint>,
    opaque: Option<bool>,
    reference_scene: String,
    frame_size: Option<[u32; 2]>,
    bins: u32,
    n_min: u64,
    ddof: u32,
    gate_n: f64,
    smoothing_window: u32,
    resolution_tolerance_nm: i64,
    /// What skill is measured by, by channel, where it is known and the same of all that was joined.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    constants: BTreeMap<String, f64>,
}

/// A footprint in whole nanometres: a radius, or half a width and half a height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenFootprint {
    radius_nm: Option<i64>,
    half_nm: Option<[i64; 2]>,
    depth_max_nm: Option<i64>,
}

impl StateFile {
    /// What `evaluator` has seen.
    ///
    /// # Errors
    /// [`StudyError::Scores`] for samples still collected that it cannot take.
    pub(crate) fn of(
        evaluator: &mut Evaluator,
        subject: &Subject,
        provenance: &Provenance,
        bounded: Bounded,
    ) -> Result<StateFile, StudyError> {
        Ok(StateFile {
            schema: STATE_SCHEMA.to_owned(),
            subject: subject.clone(),
            plan: WrittenPlan::of(evaluator.plan()),
            provenance: provenance.clone(),
            bounded,
            seen: provenance.is_of_seen_samples(),
            states: evaluator.states()?,
            taken: Vec::new(),
            history: Vec::new(),
            seal: None,
        })
    }

    /// The scores of `evaluator`, which has seen what is kept here: with the share of predictions beyond bounds, and told whether the
    /// model has seen the samples before.
    ///
    /// # Errors
    /// [`StudyError::Scores`] for samples still collected that it cannot take.
    pub(crate) fn finish(&self, evaluator: Evaluator) -> Result<Evaluation, StudyError> {
        let evaluation = evaluator.finish()?;
        let evaluation = evaluation.with_bounded_shares(&self.bounded.shares());
        Ok(match self.seen {
            true => evaluation.of_seen_samples(),
            false => evaluation,
        })
    }

    /// The same, having taken these rows.
    pub(crate) fn with_taken(self, taken: Vec<Taken>) -> StateFile {
        StateFile { taken, ..self }
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`StudyError::State`] for what is no state file, one of a newer schema, or one that was changed after it was sealed.
    pub fn read(path: &Path) -> Result<StateFile, StudyError> {
        StateFile::read_whole(path).map(|read| read.file)
    }

    fn read_whole(path: &Path) -> Result<ReadState, StudyError> {
        let wrong = |problem: String| StudyError::State {
            path: path.to_owned(),
            problem,
        };
        let text = read_capped(path).map_err(|error| wrong(error.to_string()))?;
        let head: Head = serde_json::from_str(&text)
            .map_err(|error| wrong(format!("no state of an evaluation: {error}")))?;
        let version = match head.schema.as_str() {
            STATE_SCHEMA => Version::Sealed,
            UNSEALED_SCHEMA => Version::BeforeSeals,
            schema => {
                return Err(wrong(format!(
                    "its schema is `{schema}`, expected `{STATE_SCHEMA}`"
                )));
            }
        };
        let opened =
            taceva_seal::json::check(&text, version).map_err(|error| wrong(error.to_string()))?;
        let mut file: StateFile =
            serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if !opened.is_sealed {
            file.provenance.unsealed.push(format!("state {name}"));
        }
        let edits = file
            .history
            .drain(..)
            .map(|edit| format!("state {name}, {edit}"));
        file.provenance.edits.extend(edits);
        file.seal = None;
        Ok(ReadState {
            file,
            digest: opened.digest,
        })
    }

    /// Writes the file's content, one line, sealed.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let text = serde_json::to_string(self)?;
        writeln!(
            out,
            "{}",
            taceva_seal::json::seal(&text).map_err(io::Error::other)?
        )
    }
}

/// The only key that is read before the schema is known.
#[derive(Deserialize)]
struct Head {
    schema: String,
}

/// The scores of several states together, and their joined state.
///
/// # Errors
/// [`StudyError::State`] naming the first file that does not belong with the first; [`StudyError::Request`] for no file.
pub fn merge(paths: &[PathBuf]) -> Result<(EvaluationReport, StateFile), StudyError> {
    let (first_path, rest) = paths
        .split_first()
        .ok_or_else(|| StudyError::Request("there is no state to join".to_owned()))?;
    let mut all_taken = AllTaken::default();
    let ReadState {
        file: first,
        digest,
    } = StateFile::read_whole(first_path)?;
    let mut take_rows = |path: &Path, digest: &str, taken: &[Taken]| {
        all_taken
            .add(path, digest, taken)
            .map_err(|problem| StudyError::State {
                path: path.to_owned(),
                problem,
            })
    };
    take_rows(first_path, &digest, &first.taken)?;
    let plan = first.plan.to_plan(first_path)?;
    let mut constants = first.plan.constants.clone();
    let mut evaluator = Evaluator::new(&plan);
    let mut provenance = first.provenance.clone();
    let mut bounded = first.bounded.clone();
    let mut is_seen = first.seen;
    let mut subject = first.subject.clone();
    let mut take = |path: &Path, file: &StateFile| -> Result<(), StudyError> {
        let wrong = |problem: String| StudyError::State {
            path: path.to_owned(),
            problem,
        };
        if !file.plan.merges_with(&first.plan) {
            let problem = "it was made with another plan: metrics, channels, sensor facts and settings must be equal";
            return Err(wrong(format!(
                "{problem} to those of {}",
                shown(first_path)
            )));
        }
        let states = evaluator.merge_states(&file.states);
        states.map_err(|error| wrong(error.to_string()))
    };
    take(first_path, &first)?;
    for path in rest {
        let ReadState { file, digest } = StateFile::read_whole(path)?;
        take_rows(path, &digest, &file.taken)?;
        take(path, &file)?;
        // Models that were taught otherwise have no common constant: skill is measured by the mean of truth there.
        constants.retain(|channel, constant| {
            let other = file.plan.constants.get(channel);
            other.is_some_and(|other| other.to_bits() == constant.to_bits())
        });
        is_seen |= file.seen;
        subject = subject.joined(&file.subject);
        provenance = provenance.joined(&file.provenance);
        bounded = bounded.joined(&file.bounded);
    }
    provenance
        .notes
        .push(format!("{} states joined", paths.len()));
    let mut finished = Evaluator::new(&plan.with_constants(constants)?);
    finished.merge(evaluator)?;
    let mut state = StateFile::of(&mut finished, &subject, &provenance, bounded)?
        .with_taken(all_taken.into_taken());
    state.seen = is_seen;
    let evaluation = state.finish(finished)?;
    Ok((
        EvaluationReport::new(subject, evaluation, provenance),
        state,
    ))
}

fn read_capped(path: &Path) -> io::Result<String> {
    let file = File::open(path)?;
    if !file.metadata()?.is_file() {
        return Err(io::Error::other("no regular file"));
    }
    let mut text = String::new();
    file.take(LARGEST + 1).read_to_string(&mut text)?;
    if text.len() as u64 > LARGEST {
        return Err(io::Error::other("larger than 1 GiB"));
    }
    Ok(text)
}

impl WrittenPlan {
    fn of(plan: &MetricPlan) -> WrittenPlan {
        let (facts, settings) = (plan.facts(), plan.settings());
        WrittenPlan {
            metrics: plan
                .wanted()
                .iter()
                .map(|metric| metric.id.to_owned())
                .collect(),
            channels: plan
                .channels()
                .iter()
                .map(|channel| (channel.name().to_owned(), channel.unit()))
                .collect(),
            fields: plan
                .available()
                .iter()
                .map(|field| field.name().to_owned())
                .collect(),
            seed: plan.seed(),
            footprint: facts.footprint.as_ref().map(WrittenFootprint::of),
            opaque: facts.opaque,
            reference_scene: facts.reference_scene.clone(),
            frame_size: facts.frame_size,
            bins: settings.bins,
            n_min: settings.n_min,
            ddof: settings.ddof,
            gate_n: settings.gate.0,
            smoothing_window: settings.smoothing_window,
            resolution_tolerance_nm: settings.resolution_tolerance.0,
            constants: plan.constants().clone(),
        }
    }

    /// Whether states of both plans join: what skill is measured by enters when scores are finished, and may differ.
    fn merges_with(&self, other: &WrittenPlan) -> bool {
        let without = |plan: &WrittenPlan| WrittenPlan {
            constants: BTreeMap::new(),
            ..plan.clone()
        };
        without(self) == without(other)
    }

    fn to_plan(&self, path: &Path) -> Result<MetricPlan, StudyError> {
        let wrong = |problem: String| StudyError::State {
            path: path.to_owned(),
            problem,
        };
        let metrics = catalogue::select(self.metrics.iter().map(String::as_str))?;
        let channels = self
            .channels
            .iter()
            .map(|(name, unit)| Channel::named(name, *unit))
            .collect::<Result<Vec<_>, _>>()
            .and_then(Channels::new)
            .map_err(|error| wrong(error.to_string()))?;
        let field = |name: &String| {
            let found = Field::ALL.into_iter().find(|field| field.name() == name);
            found.ok_or_else(|| wrong(format!("`{name}` is no field")))
        };
        let fields: FieldSet = self.fields.iter().map(field).collect::<Result<_, _>>()?;
        let footprint = self.footprint.as_ref().map(WrittenFootprint::to_core);
        let plan = MetricPlan::new(&metrics, channels, fields)
            .with_facts(SensorFacts {
                footprint: footprint.transpose().map_err(wrong)?,
                opaque: self.opaque,
                reference_scene: self.reference_scene.clone(),
                frame_size: self.frame_size,
            })
            .with_seed(self.seed)
            .with_constants(self.constants.clone())?
            .with_settings(Settings {
                bins: self.bins,
                n_min: self.n_min,
                ddof: self.ddof,
                gate: Newton(self.gate_n),
                smoothing_window: self.smoothing_window,
                resolution_tolerance: Nanometre(self.resolution_tolerance_nm),
            });
        Ok(plan?)
    }
}

impl WrittenFootprint {
    fn of(footprint: &Footprint) -> WrittenFootprint {
        let (radius_nm, half_nm) = match footprint.outline() {
            Outline::Disc { radius } => (Some(radius.0), None),
            _ => (None, Some(footprint.half_extent().map(|half| half.0))),
        };
        WrittenFootprint {
            radius_nm,
            half_nm,
            depth_max_nm: footprint.depth_max().map(|depth| depth.0),
        }
    }

    fn to_core(&self) -> Result<Footprint, String> {
        let millimetres = |length: i64| Nanometre(length).to_millimetres();
        let depth = self.depth_max_nm.map(millimetres);
        match (self.radius_nm, self.half_nm) {
            (Some(radius), None) => Footprint::disc(millimetres(radius), depth),
            (None, Some([x, y])) => Footprint::rectangle(millimetres(x), millimetres(y), depth),
            _ => return Err("a footprint has either `radius_nm` or `half_nm`".to_owned()),
        }
        .map_err(|error| error.to_string())
    }
}
