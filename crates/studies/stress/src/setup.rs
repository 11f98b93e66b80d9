//! Choice of samples and faults, checked before any picture is read.

use taceva_core::{Frame, counted, shown};
use taceva_dataset::Dataset;
use taceva_evaluate::{DataPart, EvaluateError, Plan, Target, subject_of};
use taceva_models::{MarkerTracker, Model};
use taceva_results::not_measured;

use crate::fault::{Fault, Scope};
use crate::faults::{LIST, select};
use crate::foreign::PictureFault;
use crate::pass::compares;
use crate::report::SkippedFault;
use crate::samples::{Unseen, shares};
use crate::scale::PICTURES;
use crate::severity::By;
use crate::stress::{Stress, draw_seeds};

/// Minimum number of markers for their loss. Fewer spots would fit into any grid.
const LEAST_MARKERS: usize = 9;

/// Choice of faults and samples.
#[derive(Clone, Debug)]
pub struct StressRequest {
    /// Names of faults, or of their list.
    pub faults: Vec<String>,
    /// Severities from 1 to 5, ascending.
    pub severities: Vec<u8>,
    /// Quantity that sets severity.
    pub by: By,
    /// Seed of all faults.
    pub seed: u64,
    /// Draws of the places of dead pixels, scratches, tears and dust, at least 1.
    pub draws: u32,
    /// Part to score; `None` for the samples that the model has not seen.
    pub part: Option<DataPart>,
    /// True to leave out the severities of a fault of pictures above the first at which no channel has skill. Each severity then decodes the scored pictures.
    pub stops_at_no_skill: bool,
}

impl Default for StressRequest {
    fn default() -> StressRequest {
        StressRequest {
            faults: vec![LIST.to_owned()],
            severities: (1..=5).collect(),
            by: By::default(),
            seed: 0,
            draws: 1,
            part: None,
            stops_at_no_skill: false,
        }
    }
}

impl StressRequest {
    /// The wanted faults, if severities and draws are valid. With `has_others` none has to be named.
    fn checked(&self, has_others: bool) -> Result<Vec<&'static Fault>, EvaluateError> {
        let refused = |words: &str| Err(EvaluateError::Request(words.to_owned()));
        let chosen = match self.faults.is_empty() && has_others {
            true => Vec::new(),
            false => select(&self.faults)?,
        };
        let severities = &self.severities;
        if severities.is_empty()
            || !severities.iter().all(|of| (1..=5).contains(of))
            || !severities.is_sorted_by(|one, next| one < next)
        {
            return refused("severities: expected numbers from 1 to 5, ascending");
        }
        if self.draws == 0 {
            return refused("draws: found 0, expected at least 1");
        }
        Ok(chosen)
    }
}

/// Samples and faults of a test, checked before any picture is read.
pub(crate) struct Setup {
    pub(crate) samples: Unseen,
    /// Faults of pictures.
    pub(crate) faults: Vec<&'static Fault>,
    /// Faults of labels.
    pub(crate) of_labels: Vec<&'static Fault>,
    pub(crate) skipped: Vec<SkippedFault>,
}

impl Setup {
    pub(crate) fn new(
        dataset: &Dataset,
        model: &Model,
        request: &StressRequest,
        has_others: bool,
    ) -> Result<Setup, EvaluateError> {
        require_testable(dataset, model)?;
        let chosen = request.checked(has_others)?;
        let samples = Unseen::of(dataset, model, request.part)?;
        Ok(Setup::with(dataset, model, samples, chosen))
    }

    /// Setup for the samples of `target`, which the caller knows to be unseen.
    pub(crate) fn of_target(
        dataset: &Dataset,
        model: &Model,
        target: Target,
        request: &StressRequest,
        has_others: bool,
    ) -> Result<Setup, EvaluateError> {
        let chosen = request.checked(has_others)?;
        let samples = Unseen::of_target(dataset, model, target)?;
        Ok(Setup::with(dataset, model, samples, chosen))
    }

    fn with(
        dataset: &Dataset,
        model: &Model,
        samples: Unseen,
        chosen: Vec<&'static Fault>,
    ) -> Setup {
        let is_timed = shares(dataset, &samples.rows).is_some();
        let lacks = |fault: &'static Fault| -> Option<&'static str> {
            let is_alone = samples.rows.len() == 1;
            if is_alone && Stress::new(fault, 0.0, 0).repeats() {
                return Some("the only scored picture has no previous picture");
            }
            if fault.grows() && !is_timed {
                return Some(
                    "expected the times `t_s` of all samples, with a first and a last one",
                );
            }
            (fault.label_change()?.lacks)(dataset, model, &samples.rows)
        };
        let (mut faults, mut skipped) = (Vec::new(), Vec::new());
        for fault in chosen {
            match lacks(fault) {
                None => faults.push(fault),
                Some(reason) => skipped.push(SkippedFault::new(fault, reason)),
            }
        }
        let (of_labels, faults) = faults.into_iter().partition(|fault| fault.is_of_labels());
        Setup {
            samples,
            faults,
            of_labels,
            skipped,
        }
    }

    /// Markers of the untouched picture, if a fault needs them. Without markers, that fault is skipped.
    pub(crate) fn markers(&mut self, untouched: Option<&Frame>) -> Option<MarkerTracker> {
        let position = self.faults.iter().position(|fault| fault.is_of_markers())?;
        let reason = match untouched.map(MarkerTracker::new) {
            Some(Ok(tracker)) if tracker.markers().len() >= LEAST_MARKERS => return Some(tracker),
            Some(_) => "the untouched picture shows no grid of markers",
            None => "the recording has no untouched picture",
        };
        let fault = self.faults.remove(position);
        self.skipped.push(SkippedFault::new(fault, reason));
        None
    }
}

impl SkippedFault {
    fn new(fault: &Fault, reason: &str) -> SkippedFault {
        SkippedFault {
            fault: fault.id.to_owned(),
            reason: reason.to_owned(),
        }
    }
}

/// Rejects a recording without pictures, and one whose samples the model has all seen: no request can test them.
fn require_testable(dataset: &Dataset, model: &Model) -> Result<(), EvaluateError> {
    let refused = |words: &str| {
        let path = shown(dataset.path());
        Err(EvaluateError::Request(format!("{path}: {words}")))
    };
    if !dataset.recordings().is_empty() {
        return Ok(());
    }
    if dataset.views().is_empty() && dataset.header().frames.is_none() {
        return refused("the recording has no pictures, expected a recording with pictures");
    }
    match taceva_evaluate::Divided::by_model(dataset, model)? {
        Some(divided) if divided.rows(DataPart::Test).is_empty() => refused(
            "the model was fitted on every sample of this recording, so its errors without a fault are too small; stress it on another recording",
        ),
        _ => Ok(()),
    }
}

/// Steps of [`stress_beside`](crate::stress_beside) with the faults of plugins `foreign`. Reads no picture.
///
/// # Errors
/// [`EvaluateError`] if the request is not valid, or the model does not suit the recording.
pub fn stress_plan(
    dataset: &Dataset,
    model: &Model,
    request: &StressRequest,
    foreign: &[&dyn PictureFault],
) -> Result<Plan, EvaluateError> {
    let setup = Setup::new(dataset, model, request, !foreign.is_empty())?;
    let mut plan = Plan::default();
    let rows = counted(dataset.table().rows(), "row");
    plan.step("read", format!("{rows} of {}", shown(dataset.path())));
    let scored = setup.samples.rows.len();
    plan.step(
        "decode",
        format!(
            "{} of the part `{}`, each once {}; before that, at most {} for the change by contact",
            counted(scored, "frame"),
            setup.samples.target.part.name(),
            match request.stops_at_no_skill {
                true => "for each severity until no skill is left",
                false => "for all faults",
            },
            counted(PICTURES.min(scored) + 1, "frame")
        ),
    );
    let draws = |fault: &Fault| draw_seeds(fault, request.seed, request.draws).len();
    let cells: usize = setup.faults.iter().map(|fault| draws(fault)).sum();
    let cells = (cells + foreign.len() + setup.of_labels.len()) * request.severities.len();
    for fault in setup.faults.iter().chain(&setup.of_labels) {
        plan.step("fault", format!("{}: {}", fault.id, fault.title));
    }
    for fault in foreign {
        let (name, key) = (fault.name(), fault.key());
        plan.step(
            "fault",
            format!("{name}: a fault of the plugin {key}; each frame is decoded once more"),
        );
    }
    for skipped in &setup.skipped {
        plan.step("skip", format!("{}: {}", skipped.fault, skipped.reason));
    }
    let fresh = setup.faults.iter();
    let fresh = fresh.filter(|fault| compares(model) && fault.scope != Scope::Each);
    let fresh: usize = fresh.map(|fault| draws(fault)).sum();
    let of_plugins = if compares(model) { foreign.len() } else { 0 };
    let fresh = (fresh + of_plugins) * request.severities.len();
    plan.step(
        "predict",
        format!(
            "{} without a fault and in {}; also with {} taken after the fault as reference",
            counted(scored, "sample"),
            counted(cells, "cell"),
            counted(fresh, "untouched picture")
        ),
    );
    plan.step("score", "mae, skill");
    let subject = subject_of(dataset);
    if let Some(words) = not_measured([subject.source.as_str()]) {
        plan.step("note", words);
    }
    Ok(plan)
}
