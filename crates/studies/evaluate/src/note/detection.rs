//! Detection limit of the normal force, and its verification by light presses.

use std::fmt;

use taceva_core::counted;
use taceva_results::{Score, Value};

/// Evidence for a detection limit.
#[derive(Clone, Debug, PartialEq)]
pub enum Detection {
    /// A limit, and the light presses that verify it.
    Verified {
        /// Detection limit, in N.
        limit_n: f64,
        /// Least and greatest true force of the light presses, in N.
        forces_n: [f64; 2],
        /// Number of samples of the light presses. One press may have several samples.
        samples: u64,
        /// Number of places at which the light presses were made.
        places: u64,
    },
    /// Only the noise of untouched frames is known, with the reason why light presses give no limit.
    Unverified(Option<String>),
}

impl Detection {
    /// Evidence in `scores`; `None` without a score for the noise of untouched frames.
    pub(crate) fn of(scores: &[Score]) -> Option<Detection> {
        let has_noise = |score: &Score| {
            score.metric == "noise_equivalent_force" && score.value.number().is_some()
        };
        scores.iter().any(has_noise).then(|| {
            let mut scores = scores.iter();
            let limit = scores.find(|score| score.metric == "detection_limit");
            limit.and_then(verified).unwrap_or_else(|| {
                Detection::Unverified(limit.and_then(|limit| match &limit.value {
                    Value::Undefined(reason) => Some(reason.clone()),
                    _ => None,
                }))
            })
        })
    }
}

fn verified(score: &Score) -> Option<Detection> {
    let force = |name: &str| score.variant(name)?.value.number();
    let places = score.counts.iter().find(|(name, _)| name == "places");
    Some(Detection::Verified {
        limit_n: score.value.number()?,
        forces_n: [force("least_force")?, force("greatest_force")?],
        samples: score.n,
        places: places.map(|(_, count)| *count)?,
    })
}

impl fmt::Display for Detection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Detection::Verified {
                limit_n,
                forces_n: [least, greatest],
                samples,
                places,
            } => write!(
                f,
                "detection limit: {limit_n:.3} N of Fz, from {} of light presses ({least:.3} N to {greatest:.3} N) at {places} places; \
                 it is not verified for other forces, places and days",
                counted(*samples, "sample")
            ),
            Detection::Unverified(reason) => {
                f.write_str("detection limit: not verified")?;
                if let Some(reason) = reason {
                    write!(f, " ({reason})")?;
                }
                f.write_str("; noise_equivalent_force uses untouched frames only")?;
                match reason {
                    // Every reason states what is missing, so no advice on light presses is added.
                    Some(_) => Ok(()),
                    None => f.write_str(
                        "; light presses (0.02 N to 0.2 N) at ten places or more would verify a limit",
                    ),
                }
            }
        }
    }
}
