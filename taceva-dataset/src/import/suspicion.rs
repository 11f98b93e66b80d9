//! Numbers that contradict the unit they are said to be in.

use std::fmt;

use taceva_core::{Channel, Unit};

/// A channel whose numbers look like those of another unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Suspicion {
    /// Stable, for scripts: `magnitude-small` or `magnitude-large`.
    pub code: &'static str,
    /// The channel.
    pub channel: String,
    /// The magnitude looked at, in the channel's unit: the largest or the median one.
    pub magnitude: f64,
    /// The channel's unit.
    pub unit: Unit,
    /// The unit the numbers may be in.
    pub perhaps: &'static str,
}

impl fmt::Display for Suspicion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let which = if self.code == "magnitude-small" {
            "at most"
        } else {
            "typically"
        };
        write!(
            f,
            "{}: `{}` is {which} {} {}, which no gel shows; are the numbers in {}?",
            self.code, self.channel, self.magnitude, self.unit, self.perhaps
        )
    }
}

/// Fewest values that are judged.
const LEAST_VALUES: usize = 3;

/// What contacts of a gel look like in a unit: not all magnitudes are below `small`, the median is not above `large`.
struct Plausible {
    small: f64,
    small_perhaps: &'static str,
    large: f64,
    large_perhaps: &'static str,
}

fn plausible(channel: &Channel) -> Option<Plausible> {
    let is_contact = Channel::SIX.contains(channel);
    match channel.unit() {
        Unit::Millimetre => Some(Plausible {
            small: 0.05,
            small_perhaps: "m",
            // Gripper widths and the like may be larger than any place on a gel.
            large: if is_contact { 150.0 } else { 5_000.0 },
            large_perhaps: "um",
        }),
        Unit::Newton => Some(Plausible {
            small: 0.01,
            small_perhaps: "kN",
            large: 150.0,
            large_perhaps: "mN",
        }),
        _ => None,
    }
}

/// Whether the numbers of `channel` are off by about a thousand: metres said to be millimetres, millinewtons said to be newtons.
///
/// # Units
/// `values`: those of the channel.
///
/// ```
/// use taceva_core::Channel;
/// use taceva_dataset::magnitude_suspicion;
/// let metres = [0.0012, 0.0025, 0.0031];
/// let suspicion = magnitude_suspicion(&Channel::PZ, metres).expect("no press is 3 µm deep");
/// assert_eq!((suspicion.code, suspicion.perhaps), ("magnitude-small", "m"));
/// assert_eq!(magnitude_suspicion(&Channel::PZ, [1.2, 2.5, 3.1]), None);
/// ```
pub fn magnitude_suspicion(
    channel: &Channel,
    values: impl IntoIterator<Item = f64>,
) -> Option<Suspicion> {
    let plausible = plausible(channel)?;
    let mut magnitudes: Vec<f64> = values
        .into_iter()
        .map(f64::abs)
        .filter(|magnitude| *magnitude > 0.0)
        .collect();
    if magnitudes.len() < LEAST_VALUES {
        return None;
    }
    magnitudes.sort_unstable_by(f64::total_cmp);
    let largest = magnitudes[magnitudes.len() - 1];
    let median = magnitudes[magnitudes.len() / 2];
    let suspicion = |code, magnitude, perhaps| Suspicion {
        code,
        channel: channel.name().to_owned(),
        magnitude,
        unit: channel.unit(),
        perhaps,
    };
    if largest < plausible.small {
        Some(suspicion(
            "magnitude-small",
            largest,
            plausible.small_perhaps,
        ))
    } else if median > plausible.large {
        Some(suspicion(
            "magnitude-large",
            median,
            plausible.large_perhaps,
        ))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousandfold_error_is_noticed_either_way() {
        let code = |channel: &Channel, values: [f64; 3]| {
            magnitude_suspicion(channel, values).map(|suspicion| suspicion.code)
        };
        assert_eq!(
            code(&Channel::FZ, [900.0, 2_000.0, 4_100.0]),
            Some("magnitude-large")
        );
        assert_eq!(
            code(&Channel::FZ, [0.0009, 0.002, 0.0041]),
            Some("magnitude-small")
        );
        assert_eq!(code(&Channel::FZ, [0.9, 2.0, 4.1]), None);
        assert_eq!(
            code(&Channel::PZ, [300.0, 2_000.0, 900.0]),
            Some("magnitude-large")
        );
    }

    #[test]
    fn zeros_few_values_and_other_units_are_not_judged() {
        let ratio = Channel::named("grid_x", Unit::One).expect("a name");
        assert_eq!(magnitude_suspicion(&ratio, [1e9; 5]), None);
        assert_eq!(magnitude_suspicion(&Channel::FZ, [0.0; 50]), None);
        assert_eq!(magnitude_suspicion(&Channel::FZ, [1e-9, 1e-9]), None);
    }
}
