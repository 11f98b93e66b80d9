//! What a shard has kept, as a file: written by one lab, joined by another, with the scores of one unsharded run.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::{
    Channel, Channels, Field, FieldSet, Footprint, Nanometre, Newton, Outline, Unit,
};
use taceva_metrics::{Evaluator, MetricPlan, SensorFacts, Settings, State, catalogue};

use crate::error::StudyError;
use crate::provenance::Provenance;
use crate::report::EvaluationReport;
use crate::subject::Subject;

/// The schema of a state file.
pub const STATE_SCHEMA: &str = "taceva.state/1";

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
    states: Vec<State>,
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
    ) -> Result<StateFile, StudyError> {
        Ok(StateFile {
            schema: STATE_SCHEMA.to_owned(),
            subject: subject.clone(),
            plan: WrittenPlan::of(evaluator.plan()),
            provenance: provenance.clone(),
            states: evaluator.states()?,
        })
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`StudyError::State`] for what is no state file, or one of a newer schema.
    pub fn read(path: &Path) -> Result<StateFile, StudyError> {
        let wrong = |problem: String| StudyError::State {
            path: path.to_owned(),
            problem,
        };
        let text = read_capped(path).map_err(|error| wrong(error.to_string()))?;
        let head: Head = serde_json::from_str(&text)
            .map_err(|error| wrong(format!("no state of an evaluation: {error}")))?;
        if head.schema != STATE_SCHEMA {
            return Err(wrong(format!(
                "its schema is `{}`, expected `{STATE_SCHEMA}`",
                head.schema
            )));
        }
        serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))
    }

    /// Writes the file's content, one line.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        serde_json::to_writer(&mut *out, self)?;
        writeln!(out)
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
    let first = StateFile::read(first_path)?;
    let mut evaluator = Evaluator::new(&first.plan.to_plan(first_path)?);
    let mut provenance = first.provenance.clone();
    let mut subject = first.subject.clone();
    let mut take = |path: &Path, file: &StateFile| -> Result<(), StudyError> {
        let wrong = |problem: String| StudyError::State {
            path: path.to_owned(),
            problem,
        };
        if file.plan != first.plan {
            let problem = "it was made with another plan: metrics, channels, sensor facts and settings must be equal";
            return Err(wrong(format!(
                "{problem} to those of {}",
                first_path.display()
            )));
        }
        let states = evaluator.merge_states(&file.states);
        states.map_err(|error| wrong(error.to_string()))
    };
    take(first_path, &first)?;
    for path in rest {
        let file = StateFile::read(path)?;
        take(path, &file)?;
        subject = subject.joined(&file.subject);
        provenance = provenance.joined(&file.provenance);
    }
    provenance
        .notes
        .push(format!("{} states joined", paths.len()));
    let state = StateFile::of(&mut evaluator, &subject, &provenance)?;
    let evaluation = evaluator.finish()?;
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
        }
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
