//! Monitor of a sensor in use. Pictures without contact are compared with earlier ones, and pictures of contact with the training pictures.

mod baseline;
mod change;
mod level;
mod limit;
mod lines;
mod recording;

use std::collections::{BTreeSet, VecDeque};

use taceva_core::{Frame, shown};
use taceva_dataset::Dataset;
use taceva_evaluate::{EvaluateError, Need, model_extractor, usable};
use taceva_models::{Extractor, FeatureDistance, Model};

pub use self::change::{Alarm, Change};
pub use self::recording::watch;

use self::baseline::Baseline;
use self::level::Level;
use self::limit::{LEARNT, Limited, WINDOW};
use self::lines::line_change;
use crate::scale::Scale;

/// Number of untouched pictures (pictures without contact) whose mean is the baseline.
const SETTLED: u32 = 50;
/// Minimum change of pattern that is reported, as a ratio to the change by contact.
const PATTERN: f64 = 0.1;
/// Minimum change of detail that is reported, as a ratio to the change by contact. Noise hides most of a change of detail.
const DETAIL: f64 = 0.05;
/// Minimum change of one line between successive pictures that is reported, as a ratio to the change by contact.
const LINES: f64 = 0.5;
/// Maximum accepted difference of the baseline from the reference picture, as a ratio to the change by contact. Flicker of one picture is below it.
const REFERENCE: f64 = 1.0;
/// Number of repeated pictures among the newest 30 that counts as a change.
const REPEATS: usize = 3;
/// Number of pictures unlike the training pictures, among the newest 30 pictures of contact, that counts as a change.
const OUTSIDE: usize = 20;

/// Monitor of a sensor in use.
///
/// An untouched picture has no contact. The mean of the first 50 is the baseline, and the next 200 set the limits. A change is then found if at least
/// 19 of the newest 30 untouched pictures, or their mean brightness, exceed a limit. It is also found if one line changes strongly from the previous
/// picture, in three of them. Each kind of change is reported once. After its remedy, create a new monitor.
///
/// ```
/// use taceva_core::{Frame, FrameInfo, PixelFormat};
/// use taceva_stress::{Change, Monitor};
/// let info = FrameInfo { width: 4, height: 4, format: PixelFormat::Gray8 };
/// let picture = |light: u8, number: u8| {
///     let noise = (0..16).map(|pixel| light + pixel * (number % 7) % 3);
///     Frame::new(info, noise.collect())
/// };
/// // Contact changes pictures by 10 of 255.
/// let mut monitor = Monitor::new(picture(100, 0)?, 10.0 / 255.0)?;
/// for number in 0..250 {
///     assert!(monitor.untouched(&picture(100, number)?)?.is_empty());
/// }
/// let mut found = Vec::new();
/// for number in 0..30 {
///     found.extend(monitor.untouched(&picture(110, number)?)?);
/// }
/// assert_eq!(found[0].change, Change::Brightness);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Monitor {
    reference: Frame,
    contact: f64,
    /// Sum of each pixel value over the first untouched pictures, for the baseline.
    sums: Vec<u32>,
    settled: u32,
    baseline: Option<Baseline>,
    level: Level,
    pattern: Limited,
    detail: Limited,
    lines: Limited,
    before: Option<Frame>,
    /// True if a picture repeated the previous picture while the limits were set. Later repeats are then not reported.
    has_repeats: bool,
    repeats: Newest,
    training: Option<Training>,
    /// Number of untouched pictures of the calibration; `None` if the monitor does not learn from them.
    calibration: Option<usize>,
    untouched: u64,
    /// Number of untouched pictures that were compared with the limits.
    compared: u64,
    touched: u64,
    found: BTreeSet<Change>,
}

/// Training pictures of a model, with the newest pictures of contact.
#[derive(Clone, Debug)]
struct Training {
    model: Model,
    extractor: Extractor,
    outside: Newest,
}

/// Mark of each of the newest pictures, at most 30, such as "repeats the previous picture".
#[derive(Clone, Debug, Default)]
struct Newest(VecDeque<bool>);

impl Newest {
    /// Takes the next mark. Returns the number of marks among the newest pictures.
    fn push(&mut self, is_marked: bool) -> usize {
        if self.0.len() == WINDOW {
            self.0.pop_front();
        }
        self.0.push_back(is_marked);
        self.0.iter().filter(|is_marked| **is_marked).count()
    }
}

impl Monitor {
    /// Number of untouched pictures that set the baseline and the limits.
    pub const PICTURES: usize = SETTLED as usize + LEARNT;
    /// Minimum number of untouched pictures of a calibration from which a monitor learns. Limits from so few pictures may be wider.
    pub const LEAST_PICTURES: usize = 2 * SETTLED as usize;

    /// Creates a monitor. `reference` is the untouched picture of the calibration. `contact` is the mean change of pictures by contact, a fraction of
    /// full scale.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for an empty picture, or a change that is not above 0.
    pub fn new(reference: Frame, contact: f64) -> Result<Monitor, EvaluateError> {
        let numbers = reference.samples().count();
        if numbers == 0 {
            return Err(EvaluateError::Request(
                "the reference has no pixels, expected an untouched picture".to_owned(),
            ));
        }
        if !(contact.is_finite() && contact > 0.0) {
            return Err(EvaluateError::Request(format!(
                "mean change of pictures by contact: found {contact}, expected a share of full scale above 0"
            )));
        }
        Ok(Monitor {
            reference,
            contact,
            sums: vec![0; numbers],
            settled: 0,
            baseline: None,
            level: Level::default(),
            pattern: Limited::by_most(PATTERN),
            detail: Limited::by_most(DETAIL),
            lines: Limited::by_some(LINES),
            before: None,
            has_repeats: false,
            repeats: Newest::default(),
            training: None,
            calibration: None,
            untouched: 0,
            compared: 0,
            touched: 0,
            found: BTreeSet::new(),
        })
    }

    /// Creates a monitor for a sensor unit from `dataset`, its calibration, with the reference picture and the change by contact. Reads at most 33
    /// pictures.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for several recordings, or a recording without a reference, pictures or contact. Errors of reading.
    pub fn of(dataset: &Dataset) -> Result<Monitor, EvaluateError> {
        let refused = |words: &str| {
            let path = shown(dataset.path());
            Err(EvaluateError::Request(format!("{path}: {words}")))
        };
        if !dataset.recordings().is_empty() {
            return refused("several recordings, expected one, because each has its own reference");
        }
        dataset.require_view()?;
        let scale = Scale::of(dataset, &framed(dataset))?;
        let contact = scale.contact;
        match (scale.untouched.filter(|_| scale.is_reference), contact) {
            (None, _) => refused(
                "the recording has no reference, expected a picture without contact; `taceva capture` records it, and a map names it as `reference`",
            ),
            (_, None) => refused(
                "no picture of contact differs from the reference, so no change can be compared with contact; name a recording with presses",
            ),
            (Some(reference), Some(contact)) => Monitor::new(reference, contact),
        }
    }

    /// Also compares pictures of contact with the training pictures of `model`. `dataset` is the recording of the calibration. A model without
    /// training pictures has no effect.
    ///
    /// # Errors
    /// [`EvaluateError::Unsuited`] if the model does not suit the pictures.
    pub fn with_model(self, model: Model, dataset: &Dataset) -> Result<Monitor, EvaluateError> {
        let is_known = model.reads_frames() && model.feature_distance().is_some();
        let training = is_known.then(|| -> Result<Training, EvaluateError> {
            let extractor = model_extractor(dataset, &model)?;
            Ok(Training {
                model,
                extractor,
                outside: Newest::default(),
            })
        });
        Ok(Monitor {
            training: training.transpose()?,
            ..self
        })
    }

    /// Number of further untouched pictures that the monitor needs before it can find changes.
    pub fn missing(&self) -> usize {
        let settled = SETTLED - self.settled;
        settled as usize + self.pattern.missing()
    }

    /// Minimum changes of brightness, pattern, detail and single lines that are found, as ratios to the change by contact. `None` while untouched
    /// pictures are [missing](Monitor::missing).
    pub fn smallest(&self) -> Option<[f64; 4]> {
        Some([
            self.level.smallest()?,
            self.pattern.smallest()?,
            self.detail.smallest()?,
            self.lines.smallest()?,
        ])
    }

    /// Upper bound of the expected number of false alarms in `pictures` untouched pictures, if 200 pictures set the limits. With fewer, more false
    /// alarms are expected.
    ///
    /// The bound assumes that untouched pictures do not drift and are exchangeable. Its brightness term assumes normally distributed flicker. Its
    /// pattern and detail terms hold for every distribution. It has no term for single lines: no alarm is expected if their noise has no outliers.
    /// Flicker that is similar in successive pictures causes more alarms (docs/faults.md).
    ///
    /// ```
    /// assert!(taceva_stress::Monitor::false_alarms(300_000) < 0.001);
    /// ```
    pub fn false_alarms(pictures: u64) -> f64 {
        2.0 * limit::false_alarms(pictures) + level::false_alarms(pictures)
    }

    /// Numbers of untouched pictures and of pictures of contact that the monitor got so far.
    pub fn pictures(&self) -> [u64; 2] {
        [self.untouched, self.touched]
    }

    /// Number of untouched pictures of the calibration; `None` if [`learn_from`](Monitor::learn_from) was not called.
    pub fn calibration_pictures(&self) -> Option<usize> {
        self.calibration
    }

    /// True if "no change" is a valid result: at least 30 untouched pictures were compared with the limits. After
    /// [`learn_from`](Monitor::learn_from), the calibration must also have enough untouched pictures.
    ///
    /// ```
    /// use taceva_core::{Frame, FrameInfo, PixelFormat};
    /// let info = FrameInfo { width: 4, height: 4, format: PixelFormat::Gray8 };
    /// let monitor = taceva_stress::Monitor::new(Frame::new(info, vec![9; 16])?, 0.1)?;
    /// assert!(!monitor.is_decided());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn is_decided(&self) -> bool {
        let is_enough = |pictures: usize| pictures >= Monitor::LEAST_PICTURES;
        self.calibration.is_none_or(is_enough) && self.compared >= WINDOW as u64
    }

    /// Kinds of change that the monitor has found so far.
    pub fn found(&self) -> &BTreeSet<Change> {
        &self.found
    }

    /// Takes the next untouched picture. Returns the changes that it shows for the first time.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a picture of another size or format than the reference.
    pub fn untouched(&mut self, frame: &Frame) -> Result<Vec<Alarm>, EvaluateError> {
        self.require_kind(frame)?;
        self.untouched += 1;
        let before = self.before.replace(frame.clone());
        let is_repeat = before.as_ref().is_some_and(|before| before == frame);
        let line = before.map_or(0.0, |before| line_change(&before, frame));
        let is_learning = self.missing() > 0;
        let number = self.untouched;
        let mut alarms = Vec::new();
        match &self.baseline {
            None => {
                let stimulus = self.settle(frame);
                alarms.extend(Alarm::of(Change::Reference, number, stimulus));
            }
            Some(baseline) => {
                let difference = baseline.difference(frame);
                let level = self.level.push(difference.level / self.contact);
                let pattern = self.pattern.push(difference.pattern / self.contact);
                let detail = self.detail.push(difference.detail / self.contact);
                alarms.extend(Alarm::of(Change::Brightness, number, level));
                alarms.extend(Alarm::of(Change::Pattern, number, pattern));
                alarms.extend(Alarm::of(Change::Detail, number, detail));
                let lines = self.lines.push(line / self.contact);
                alarms.extend(Alarm::of(Change::Lines, number, lines));
            }
        }
        match is_learning {
            true => self.has_repeats |= is_repeat,
            false => {
                self.compared += 1;
                let repeats = self.repeats.push(is_repeat);
                let is_change = repeats >= REPEATS && !self.has_repeats;
                let strength = is_change.then(|| share(repeats));
                alarms.extend(Alarm::of(Change::Repeats, number, strength));
            }
        }
        Ok(self.first(alarms))
    }

    /// Takes the next picture of contact. Returns the change that it shows for the first time.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a picture of another size or format than the reference.
    pub fn touched(&mut self, frame: &Frame) -> Result<Vec<Alarm>, EvaluateError> {
        self.require_kind(frame)?;
        self.touched += 1;
        self.before = None;
        let Some(training) = &mut self.training else {
            return Ok(Vec::new());
        };
        let features = training.extractor.extract_all([frame])?;
        let distances = training.model.distances(&features)?;
        let mut distances = distances.into_iter().flatten();
        let outside = training
            .outside
            .push(distances.any(FeatureDistance::is_outside));
        let strength = (outside >= OUTSIDE).then(|| share(outside));
        let alarm = Alarm::of(Change::Contact, self.touched, strength);
        Ok(self.first(alarm.into_iter().collect()))
    }

    /// Adds a picture to the baseline. When the baseline is complete and differs from the reference, returns the difference, as a ratio to the change
    /// by contact.
    fn settle(&mut self, frame: &Frame) -> Option<f64> {
        for (sum, number) in self.sums.iter_mut().zip(frame.samples()) {
            *sum += u32::from(number);
        }
        self.settled += 1;
        if self.settled < SETTLED {
            return None;
        }
        let baseline = Baseline::new(frame.info(), &self.sums, self.settled);
        let difference = baseline.difference(&self.reference);
        let stimulus = (difference.level.abs() + difference.pattern) / self.contact;
        self.baseline = Some(baseline);
        (stimulus > REFERENCE).then_some(stimulus)
    }

    /// Removes the alarms of kinds of change that were found before.
    fn first(&mut self, mut alarms: Vec<Alarm>) -> Vec<Alarm> {
        alarms.retain(|alarm| self.found.insert(alarm.change));
        alarms
    }

    fn require_kind(&self, frame: &Frame) -> Result<(), EvaluateError> {
        let (found, expected) = (frame.info(), self.reference.info());
        match found == expected {
            true => Ok(()),
            false => Err(EvaluateError::Request(format!(
                "a picture of {found}, expected {expected} as in the recording of the calibration: set the camera to that format, or calibrate again"
            ))),
        }
    }
}

/// Rows of `dataset` with a picture.
fn framed(dataset: &Dataset) -> Vec<usize> {
    let need = Need {
        frame: true,
        labels: None,
    };
    usable(dataset, &dataset.all_rows(), need)
}

/// Fraction of the newest 30 pictures that `count` pictures are.
fn share(count: usize) -> f64 {
    count as f64 / WINDOW as f64
}
