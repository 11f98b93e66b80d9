//! Severities of a fault, each with its parameter. The parameter is found from the change of the untouched picture, or taken from a table.

use serde::Serialize;

use taceva_core::{Frame, shown};
use taceva_dataset::Leds;
use taceva_evaluate::EvaluateError;
use taceva_models::MarkerTracker;

use crate::fault::{Fault, Scope};
use crate::scale::{Scale, difference};
use crate::stress::{Stress, draw_seeds};

/// Change of the untouched picture at severities 1 to 5, as a ratio to the change by contact (the stimulus).
pub const TARGETS: [f64; 5] = [0.03, 0.1, 0.3, 1.0, 3.0];
/// Value above all severities that stands for "the skill ends at no severity".
pub const NEVER: u8 = 6;

/// Least parameter that the search for a severity tries, as a fraction of the greatest parameter.
const LEAST: f64 = 1e-7;
/// Ratio of the found stimulus to the target stimulus at which a search ends.
const ACCURACY: f64 = 1.02;
/// Maximum number of bisections in the search for a parameter.
const STEPS: usize = 28;
/// Time, as a fraction of the recording, at which the stimulus of a fault that grows with time must reach its target.
const MIDDLE: f64 = 0.5;
/// Number of picture lines over which the stimulus is averaged, for a fault with random numbers for each picture.
const LINES: u32 = 512;
/// Maximum number of pictures over which the stimulus is averaged, for a fault with random numbers for each picture.
const DRAWN: u32 = 32;

/// Quantity that sets the severity of a fault.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum By {
    /// Change of the untouched picture by the fault, divided by the change by contact. A severity has the same ratio for all faults and sensors.
    #[default]
    Stimulus,
    /// Parameter of the fault, from a table of the fault.
    Parameter,
}

/// Severity of a fault, with its parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Level {
    pub(crate) severity: u8,
    pub(crate) parameter: f64,
}

/// Severity that the fault cannot reach on this sensor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Unreached {
    /// The severity.
    pub severity: u8,
    /// Target stimulus: change of the untouched picture, divided by the change by contact.
    pub target: f64,
    /// Greatest stimulus of the fault, if it is below the target. Otherwise the least possible stimulus above the target.
    pub most: f64,
    /// Parameter that gives the stimulus `most`.
    pub parameter: f64,
}

/// Severities of a fault that can and that cannot be reached.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Levels {
    pub(crate) reached: Vec<Level>,
    pub(crate) unreached: Vec<Unreached>,
}

/// Parses severities, such as `1-5`, `3` or `1,3,5`.
///
/// # Errors
/// [`EvaluateError::Request`] for other text.
pub fn severities(text: &str) -> Result<Vec<u8>, EvaluateError> {
    let one = |text: &str| {
        let number = text.trim().parse::<u8>().ok();
        number.filter(|number| (1..NEVER).contains(number))
    };
    let range = |text: &str| match text.split_once('-') {
        None => one(text).map(|only| only..=only),
        Some((first, last)) => Some(one(first)?..=one(last)?).filter(|range| !range.is_empty()),
    };
    let ranges: Option<Vec<_>> = text.split(',').map(range).collect();
    let Some(ranges) = ranges else {
        return Err(EvaluateError::Request(format!(
            "severity `{}`: expected numbers from 1 to 5, such as 3, 1,3,5 or 1-5",
            shown(&text)
        )));
    };
    let mut severities: Vec<u8> = ranges.into_iter().flatten().collect();
    severities.sort_unstable();
    severities.dedup();
    Ok(severities)
}

impl Levels {
    /// Takes the parameters of `severities` from the table of `fault`.
    pub(crate) fn by_parameter(fault: &Fault, severities: &[u8]) -> Levels {
        let level = |severity: &u8| Level {
            severity: *severity,
            parameter: fault.table[usize::from(*severity) - 1],
        };
        Levels {
            reached: severities.iter().map(level).collect(),
            unreached: Vec::new(),
        }
    }

    /// Finds the parameters at which the untouched picture changes by the [`TARGETS`] of `severities`.
    pub(crate) fn by_stimulus(
        fault: &'static Fault,
        severities: &[u8],
        reference: &Reference<'_>,
    ) -> Levels {
        let stimulus = |parameter: f64| reference.stimulus(fault, parameter);
        let greatest = stimulus(fault.most);
        let mut levels = Levels::default();
        for &severity in severities {
            let at = usize::from(severity) - 1;
            let target = TARGETS[at];
            let (parameter, most) = match greatest < target {
                true => (fault.most, greatest),
                false => {
                    let parameter = solve(target, fault.most, stimulus);
                    (parameter, stimulus(parameter))
                }
            };
            // A stimulus that reaches the next target belongs to a higher severity.
            let next = TARGETS.get(at + 1).copied().unwrap_or(f64::INFINITY);
            match (target..next).contains(&most) {
                true => levels.reached.push(Level {
                    severity,
                    parameter,
                }),
                false => levels.unreached.push(Unreached {
                    severity,
                    target,
                    most,
                    parameter,
                }),
            }
        }
        levels
    }
}

/// Finds the least parameter with a stimulus of at least `target`, by bisection of its logarithm. The result does not depend on other targets.
fn solve(target: f64, most: f64, stimulus: impl Fn(f64) -> f64) -> f64 {
    let mut low = LEAST * most;
    let mut high = most;
    if stimulus(low) >= target {
        return low;
    }
    for _ in 0..STEPS {
        let middle = (low * high).sqrt();
        let found = stimulus(middle);
        if found < target {
            low = middle;
            continue;
        }
        high = middle;
        if found <= ACCURACY * target {
            break;
        }
    }
    high
}

/// Untouched picture from whose change the parameters of severities are found.
pub(crate) struct Reference<'a> {
    pub(crate) scale: &'a Scale,
    pub(crate) untouched: &'a Frame,
    pub(crate) contact: f64,
    pub(crate) markers: Option<&'a MarkerTracker>,
    pub(crate) leds: Leds,
    pub(crate) seed: u64,
    /// Number of random draws of the positions of a fault.
    pub(crate) draws: u32,
}

impl Reference<'_> {
    /// Change of the untouched picture by `fault` at `parameter`, as a ratio to the change by contact.
    fn stimulus(&self, fault: &'static Fault, parameter: f64) -> f64 {
        if Stress::new(fault, parameter, self.seed).repeats() {
            return parameter * self.scale.successive / self.contact;
        }
        let seeds = draw_seeds(fault, self.seed, self.draws);
        let drawn = match fault.scope {
            Scope::Fixed | Scope::Drawn => 1,
            Scope::Each => (LINES / self.untouched.info().height.max(1)).clamp(1, DRAWN),
        };
        let pictures = seeds
            .iter()
            .flat_map(|&seed| (0..drawn).map(move |number| (seed, number)));
        let changes = pictures.map(|(seed, number)| {
            let stress = Stress::new(fault, parameter, seed);
            let stress = stress.with_markers(self.markers).with_leds(self.leds);
            let stress = stress.at(MIDDLE);
            let sample = format!("untouched {number}");
            difference(&stress.apply(self.untouched, &sample, None), self.untouched)
        });
        changes.sum::<f64>() / (f64::from(drawn) * seeds.len() as f64 * self.contact)
    }
}
