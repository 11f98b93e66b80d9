//! Choice of samples and faults, checked before any picture is read.

use taceva_core::{Frame, counted, shown, suggestion};
use taceva_dataset::{Dataset, Leds};
use taceva_evaluate::{DataPart, EvaluateError, Plan, Target, subject_of};
use taceva_models::{MarkerTracker, Model};
use taceva_results::not_measured;

use crate::fault::{Fault, Scope};
use crate::faults::{LIST, TAXEL_LIST, select};
use crate::foreign::PictureFault;
use crate::pass::compares;
use crate::report::SkippedFault;
use crate::samples::{Unseen, reads_signals, shares};
use crate::scale::PICTURES;
use crate::severity::By;
use crate::stress::{Stress, draw_seeds};
use crate::taxel_scale::TaxelScale;
use crate::times::is_stream;

/// Reason to skip a fault of pictures for a model of signals.
const OF_PICTURES: &str = "the model reads signals, and the fault changes pictures";
/// Reason to skip a fault whose strength is relative to the change of signals by contact.
const NO_CONTACT: &str = "the change by contact is unknown: expected rows without contact or labels of Fz or Pz, and samples of contact whose signals differ";
/// Minimum number of markers for a fault of markers. Fewer bright spots could lie on a grid by chance.
const LEAST_MARKERS: usize = 9;

/// Metrics of a cell, which is one fault at one severity. Every cell has the first two, `mae` and `skill`. All are computed from sums over samples,
/// so a sample may have several draws.
const METRICS: [&str; 8] = [
    "mae",
    "skill",
    "rmse",
    "bias",
    "r2",
    "smape",
    "smape_gated",
    "mae_euclid",
];

/// Choice of faults and samples.
#[derive(Clone, Debug)]
pub struct StressRequest {
    /// Names of faults or of lists of faults.
    pub faults: Vec<String>,
    /// Severities from 1 to 5, ascending.
    pub severities: Vec<u8>,
    /// Quantity that sets the severity of faults of pictures: the stimulus or the parameter.
    pub by: By,
    /// Seed of all faults.
    pub seed: u64,
    /// Number of random draws of the positions of dead pixels, scratches, tears, dust and taxels, at least 1.
    pub draws: u32,
    /// Part to score; `None` for the samples that the model has not seen.
    pub part: Option<DataPart>,
    /// True to stop a fault of pictures or signals after the first severity at which no channel has skill. The pictures are then decoded once for
    /// each severity.
    pub stops_at_no_skill: bool,
    /// Names of metrics in addition to the mean absolute error and the skill.
    pub metrics: Vec<String>,
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
            metrics: Vec::new(),
        }
    }
}

/// Name of the default list of faults for `model`.
pub fn usual_list(model: &Model) -> &'static str {
    match reads_signals(model) {
        true => TAXEL_LIST,
        false => LIST,
    }
}

impl StressRequest {
    /// Returns the requested faults. Rejects invalid severities, draws and metrics. Without `has_others`, also rejects an empty list of faults.
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
        let mut metrics = self.metrics.iter().map(String::as_str);
        if let Some(unknown) = metrics.find(|name| !METRICS.contains(name)) {
            return refused(&format!(
                "metric `{}`: not computed for faults, {}",
                shown(unknown),
                suggestion(unknown, &METRICS)
            ));
        }
        Ok(chosen)
    }
}

/// Samples and faults of a stress test, checked before any picture is read.
pub(crate) struct Setup {
    pub(crate) samples: Unseen,
    /// Faults of pictures.
    pub(crate) faults: Vec<&'static Fault>,
    /// Faults of labels.
    pub(crate) of_labels: Vec<&'static Fault>,
    /// Faults of taxels.
    pub(crate) of_taxels: Vec<&'static Fault>,
    /// Faults that remove rows (samples).
    pub(crate) of_rows: Vec<&'static Fault>,
    pub(crate) skipped: Vec<SkippedFault>,
    /// Sides of the LEDs of the sensor.
    pub(crate) leds: Leds,
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
        Setup::with(dataset, model, samples, chosen)
    }

    /// Creates the setup for the samples of `target`. The caller knows that the model has not seen them.
    pub(crate) fn of_target(
        dataset: &Dataset,
        model: &Model,
        target: Target,
        request: &StressRequest,
        has_others: bool,
    ) -> Result<Setup, EvaluateError> {
        let chosen = request.checked(has_others)?;
        let samples = Unseen::of_target(dataset, model, target)?;
        Setup::with(dataset, model, samples, chosen)
    }

    fn with(
        dataset: &Dataset,
        model: &Model,
        samples: Unseen,
        chosen: Vec<&'static Fault>,
    ) -> Result<Setup, EvaluateError> {
        let is_timed = shares(dataset, &samples.rows).is_some();
        let is_stream = chosen.iter().any(|fault| fault.is_of_rows()) && is_stream(dataset)?;
        let leds = dataset.header().sensor.leds;
        let frames = dataset.header().frames.as_ref();
        let is_gray = frames.is_some_and(|frames| frames.info.format.samples() == 1);
        let lacks = |fault: &'static Fault| -> Option<&'static str> {
            if fault.is_of_pictures() && reads_signals(model) {
                return Some(OF_PICTURES);
            }
            if fault.is_of_taxels() && !reads_signals(model) {
                return Some(match dataset.header().signals {
                    Some(_) => "the model reads pictures, and the fault changes signals",
                    None => "the recording has no signals of taxels",
                });
            }
            if fault.is_of_rows() && !is_stream {
                return Some(
                    "no metric of time: expected the times `t_s` of a stream, at most 1 s apart",
                );
            }
            if fault.is_of_leds() && !leds.is_unknown() && is_gray {
                return Some("`leds` in [sensor] names colours, and the pictures are gray");
            }
            let is_alone = samples.rows.len() == 1;
            if is_alone && Stress::new(fault, 0.0, 0).repeats() {
                return Some("the only scored picture has no previous picture");
            }
            if fault.needs_times() && !is_timed {
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
        let of_kind = |is_wanted: fn(&Fault) -> bool| -> Vec<&'static Fault> {
            let own = faults.iter().copied();
            own.filter(|fault| is_wanted(fault)).collect()
        };
        Ok(Setup {
            of_labels: of_kind(Fault::is_of_labels),
            of_taxels: of_kind(Fault::is_of_taxels),
            of_rows: of_kind(Fault::is_of_rows),
            faults: of_kind(Fault::is_of_pictures),
            samples,
            skipped,
            leds,
        })
    }

    /// All tested faults: faults of pictures, labels, taxels and rows.
    pub(crate) fn all(&self) -> Vec<&'static Fault> {
        let kinds = [
            &self.faults,
            &self.of_labels,
            &self.of_taxels,
            &self.of_rows,
        ];
        kinds.into_iter().flatten().copied().collect()
    }

    /// Measures the change of signals by contact; `None` for a model of pictures. If it is unknown, the faults that need it are skipped.
    pub(crate) fn taxels(
        &mut self,
        dataset: &Dataset,
        model: &Model,
    ) -> Result<Option<TaxelScale>, EvaluateError> {
        if !reads_signals(model) {
            return Ok(None);
        }
        let scale = TaxelScale::of(dataset, &self.samples.rows)?;
        if scale.as_ref().is_none_or(|scale| scale.contact.is_none()) {
            let all = std::mem::take(&mut self.of_taxels).into_iter();
            let (unknown, others): (Vec<&'static Fault>, Vec<&'static Fault>) =
                all.partition(|fault| fault.needs_times());
            self.of_taxels = others;
            let skipped = unknown.into_iter();
            self.skipped
                .extend(skipped.map(|fault| SkippedFault::new(fault, NO_CONTACT)));
        }
        Ok(scale)
    }

    /// Finds the markers of the untouched picture, if a fault of markers is tested. Without markers, the fault is skipped.
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

    /// Entry of the report for a plugin fault that is skipped, because a model of signals reads no pictures.
    pub(crate) fn unseen(fault: &dyn PictureFault) -> SkippedFault {
        SkippedFault {
            fault: fault.name().to_owned(),
            reason: OF_PICTURES.to_owned(),
        }
    }
}

/// Rejects a recording without pictures for a model of pictures. Also rejects a recording whose samples the model has all seen.
fn require_testable(dataset: &Dataset, model: &Model) -> Result<(), EvaluateError> {
    let refused = |words: &str| {
        let path = shown(dataset.path());
        Err(EvaluateError::Request(format!("{path}: {words}")))
    };
    if !dataset.recordings().is_empty() {
        return Ok(());
    }
    let has_pictures = !dataset.views().is_empty() || dataset.header().frames.is_some();
    if !has_pictures && !reads_signals(model) {
        return refused("the recording has no pictures, expected a recording with pictures");
    }
    match taceva_evaluate::Divided::by_model(dataset, model)? {
        Some(divided) if divided.rows(DataPart::Test).is_empty() => refused(
            "the model was fitted on every sample of this recording, so its errors without a fault are too small; stress it on another recording",
        ),
        _ => Ok(()),
    }
}

/// Plans the steps of [`stress_beside`](crate::stress_beside), including the plugin faults `foreign`. Reads no picture.
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
    let is_of_signals = reads_signals(model);
    let part = setup.samples.target.part.name();
    match is_of_signals {
        true => plan.step(
            "read",
            format!("the signals of {} of the part `{part}`", counted(scored, "sample")),
        ),
        false => plan.step(
            "decode",
            format!(
                "{} of the part `{part}`, each once {}; before that, at most {} for the change by contact",
                counted(scored, "frame"),
                match request.stops_at_no_skill {
                    true => "for each severity until no skill is left",
                    false => "for all faults",
                },
                counted(PICTURES.min(scored) + 1, "frame")
            ),
        ),
    }
    let seen = foreign.iter().filter(|_| !is_of_signals);
    let seen: Vec<&&dyn PictureFault> = seen.collect();
    let inputs = || setup.faults.iter().chain(&setup.of_taxels);
    let draws = |fault: &Fault| draw_seeds(fault, request.seed, request.draws).len();
    let cells: usize = inputs().map(|fault| draws(fault)).sum();
    let cells = (cells + seen.len() + setup.of_labels.len()) * request.severities.len();
    for fault in setup.all() {
        plan.step("fault", format!("{}: {}", fault.id, fault.title));
    }
    for fault in &seen {
        let (name, key) = (fault.name(), fault.key());
        plan.step(
            "fault",
            format!("{name}: a fault of the plugin {key}; each frame is decoded once more"),
        );
    }
    let unseen = foreign.iter().filter(|_| is_of_signals);
    let unseen = unseen.map(|fault| SkippedFault::unseen(*fault));
    for skipped in setup.skipped.iter().cloned().chain(unseen) {
        plan.step("skip", format!("{}: {}", skipped.fault, skipped.reason));
    }
    let fresh = inputs().filter(|fault| compares(model) && fault.scope != Scope::Each);
    let fresh: usize = fresh.map(|fault| draws(fault)).sum();
    let of_plugins = if compares(model) { seen.len() } else { 0 };
    let fresh = (fresh + of_plugins) * request.severities.len();
    plan.step(
        "predict",
        format!(
            "{} without a fault and in {}; also with {} taken after the fault as reference",
            counted(scored, "sample"),
            counted(cells, "cell"),
            counted(
                fresh,
                match is_of_signals {
                    true => "untouched sample",
                    false => "untouched picture",
                }
            )
        ),
    );
    let is_asked = |name: &&str| request.metrics.iter().any(|asked| asked == name);
    let metrics = METRICS.into_iter();
    let metrics = metrics.filter(|name| METRICS[..2].contains(name) || is_asked(name));
    let metrics: Vec<&str> = metrics.collect();
    plan.step("score", metrics.join(", "));
    let subject = subject_of(dataset);
    if let Some(words) = not_measured([subject.source.as_str()]) {
        plan.step("note", words);
    }
    Ok(plan)
}
