//! Detects numbers whose magnitude contradicts their stated unit.

use std::fmt;

use taceva_core::{Channel, SourceUnit, Unit};

/// Channel whose numbers suggest another unit.
///
/// ```
/// use taceva_core::Channel;
/// use taceva_import::magnitude_suspicion;
///
/// let metres = [0.0012, 0.0025, 0.0031];
/// let suspicion = magnitude_suspicion(&Channel::PZ, metres).ok_or("too small for mm")?;
/// assert_eq!((suspicion.code, suspicion.channel.as_str()), ("magnitude-small", "Pz"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Suspicion {
    /// Stable code for scripts: `magnitude-small` or `magnitude-large`.
    pub code: &'static str,
    /// Name of the channel, such as `Fz`.
    pub channel: String,
    /// Suspicious magnitude in the unit of the channel: the largest, the median, or the 95th percentile.
    pub magnitude: f64,
    /// Unit of the channel in the dataset.
    pub unit: Unit,
    /// Likely units, as the end of the question `are the numbers in …`.
    pub perhaps: String,
}

impl fmt::Display for Suspicion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let which = if self.code == "magnitude-small" {
            "at most"
        } else {
            "typically"
        };
        // A robot counts positions from its base.
        let origin = match (self.code, self.unit) {
            ("magnitude-large", Unit::Millimetre) => {
                ", or do they count from an origin outside the gel"
            }
            _ => "",
        };
        write!(
            f,
            "{}: `{}` is {which} {} {}, unusual for a gel; are the numbers in {}{origin}?",
            self.code,
            self.channel,
            three_digits(self.magnitude),
            self.unit,
            self.perhaps
        )
    }
}

/// Number nearest to `number` with three significant digits.
fn three_digits(number: f64) -> f64 {
    format!("{number:.2e}").parse().unwrap_or(number)
}

/// Minimum number of values for a check.
const LEAST_VALUES: usize = 3;

/// Plausible magnitudes of gel contacts in a unit. At least one magnitude must reach `small`. The median must not exceed `large`, and the 95th
/// percentile must not exceed `most`. `typical` is the usual range.
struct Plausible {
    small: f64,
    large: f64,
    most: f64,
    typical: [f64; 2],
    /// Units in which labs state this quantity.
    written: &'static [&'static str],
}

fn plausible(channel: &Channel) -> Option<Plausible> {
    let is_contact = Channel::SIX.contains(channel);
    match channel.unit() {
        Unit::Millimetre => Some(Plausible {
            small: 0.05,
            // Positions outside the gel, such as gripper widths, may be larger.
            large: if is_contact { 150.0 } else { 5_000.0 },
            most: f64::INFINITY,
            typical: [0.05, 50.0],
            written: &["m", "mm", "um"],
        }),
        Unit::Newton => Some(Plausible {
            small: 0.01,
            // Fingers of a few square centimetres press with some newtons; 1 N is about 100 gram-force.
            large: if is_contact { 30.0 } else { 150.0 },
            most: if is_contact { 100.0 } else { f64::INFINITY },
            typical: [0.05, 30.0],
            written: &["kN", "N", "gf", "mN"],
        }),
        _ => None,
    }
}

/// Detects numbers of `channel` in another unit: metres labelled as millimetres, gram-force labelled as newtons. `None` for plausible numbers.
///
/// # Units
/// `values`: numbers in the unit of the channel.
///
/// ```
/// use taceva_core::Channel;
/// use taceva_import::magnitude_suspicion;
/// let metres = [0.0012, 0.0025, 0.0031];
/// let suspicion = magnitude_suspicion(&Channel::PZ, metres).expect("no press is 3 µm deep");
/// assert_eq!(suspicion.code, "magnitude-small");
/// assert_eq!(suspicion.perhaps, "m but labelled mm, or in mm but labelled um");
/// assert_eq!(magnitude_suspicion(&Channel::PZ, [1.2, 2.5, 3.1]), None);
/// ```
pub fn magnitude_suspicion(
    channel: &Channel,
    values: impl IntoIterator<Item = f64>,
) -> Option<Suspicion> {
    let plausible = plausible(channel)?;
    let found = odd(&plausible, values)?;
    // The unit stated by the map is unknown here.
    let pairs = plausible.written.iter().filter_map(|said| {
        let meant = meant(&plausible, said, found.typical);
        (!meant.is_empty()).then(|| format!("{} but labelled {said}", meant.join(" or ")))
    });
    let perhaps = pairs.collect::<Vec<_>>().join(", or in ");
    Some(found.suspicion(channel, perhaps))
}

/// Detects suspicious numbers like [`magnitude_suspicion`]. The numbers were converted from the unit `said`, which limits the suggested units.
pub(super) fn magnitude_suspicion_in(
    channel: &Channel,
    said: &SourceUnit,
    values: impl IntoIterator<Item = f64>,
) -> Option<Suspicion> {
    let plausible = plausible(channel)?;
    let found = odd(&plausible, values)?;
    let meant = meant(&plausible, said.symbol(), found.typical);
    let perhaps = format!("{} and not in {}", meant.join(" or "), said.symbol());
    Some(found.suspicion(
        channel,
        match meant.is_empty() {
            true => String::new(),
            false => perhaps,
        },
    ))
}

/// Common units, other than `said`, that would bring `typical` into the usual range of the channel. `said` is the stated unit of `typical`.
fn meant(plausible: &Plausible, said: &str, typical: f64) -> Vec<&'static str> {
    let in_kept = |symbol: &str| SourceUnit::parse(symbol).ok().map(|unit| unit.convert(1.0));
    let Some(said_as) = in_kept(said) else {
        return Vec::new();
    };
    let [least, greatest] = plausible.typical;
    let fits = |symbol: &&str| {
        in_kept(symbol)
            .is_some_and(|as_kept| (least..=greatest).contains(&(typical / said_as * as_kept)))
    };
    let others = plausible.written.iter().filter(|symbol| **symbol != said);
    others.copied().filter(fits).collect()
}

/// Magnitudes that no gel contact produces.
struct Odd {
    code: &'static str,
    magnitude: f64,
    /// Magnitude for the choice of units: the median, or the 95th percentile if only this percentile is suspicious.
    typical: f64,
}

impl Odd {
    fn suspicion(self, channel: &Channel, perhaps: String) -> Suspicion {
        Suspicion {
            code: self.code,
            channel: channel.name().to_owned(),
            magnitude: self.magnitude,
            unit: channel.unit(),
            perhaps: match perhaps.is_empty() {
                true => "another unit".to_owned(),
                false => perhaps,
            },
        }
    }
}

fn odd(plausible: &Plausible, values: impl IntoIterator<Item = f64>) -> Option<Odd> {
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
    let most = magnitudes[(magnitudes.len() - 1) * 19 / 20];
    let (code, magnitude, typical) = match () {
        () if largest < plausible.small => ("magnitude-small", largest, median),
        () if median > plausible.large => ("magnitude-large", median, median),
        // Most samples are without contact, so the median is noise.
        () if most > plausible.most => ("magnitude-large", most, most),
        () => return None,
    };
    Some(Odd {
        code,
        magnitude,
        typical,
    })
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
    fn the_hint_names_the_unit_that_makes_the_numbers_usual_ones() {
        let perhaps = |channel: &Channel, said: &str, values: [f64; 3]| {
            let said = SourceUnit::parse(said).expect("a unit");
            let kept = values.map(|value| said.convert(value));
            magnitude_suspicion_in(channel, &said, kept).map(|suspicion| suspicion.perhaps)
        };
        let hint = |text: &str| Some(text.to_owned());
        // Millimetres declared as metres, and the reverse.
        assert_eq!(
            perhaps(&Channel::PZ, "m", [1.2, 2.5, 3.1]),
            hint("mm and not in m")
        );
        assert_eq!(
            perhaps(&Channel::PZ, "um", [1.2, 2.5, 3.1]),
            hint("mm and not in um")
        );
        assert_eq!(
            perhaps(&Channel::PZ, "mm", [0.0012, 0.0025, 0.0031]),
            hint("m and not in mm")
        );
        assert_eq!(
            perhaps(&Channel::PZ, "mm", [1200.0, 2500.0, 3100.0]),
            hint("um and not in mm")
        );
        // 0.5 N to 3 N in gram-force.
        assert_eq!(
            perhaps(&Channel::FZ, "N", [50.0, 120.0, 310.0]),
            hint("gf or mN and not in N")
        );
        assert_eq!(
            perhaps(&Channel::FZ, "N", [5.0, 12.0, 160.0]),
            None,
            "one large one is no unit"
        );
        assert_eq!(perhaps(&Channel::FZ, "gf", [50.0, 120.0, 310.0]), None);
        // Few presses of 2 N in gram-force, and noise between them.
        let presses = (0..40).map(|at| if at % 8 == 0 { 204.0 } else { 0.3 });
        let found = magnitude_suspicion(&Channel::FZ, presses).expect("too large");
        assert!(
            found.perhaps.contains("gf or mN but labelled N"),
            "{}",
            found.perhaps
        );
    }

    #[test]
    fn large_positions_may_count_from_another_origin_and_forces_do_not() {
        let said = |channel: &Channel, values: [f64; 3]| {
            magnitude_suspicion(channel, values).map(|suspicion| suspicion.to_string())
        };
        let origin = "count from an origin outside the gel?";
        let place = said(&Channel::PX, [300.0, 301.5, 303.0]).expect("no gel is so wide");
        assert!(place.ends_with(origin), "{place}");
        let force = said(&Channel::FZ, [900.0, 2_000.0, 4_100.0]).expect("no press is so hard");
        assert!(!force.contains(origin), "{force}");
    }

    #[test]
    fn a_magnitude_is_formatted_with_three_digits() {
        let said = |values: [f64; 3]| {
            let found = magnitude_suspicion(&Channel::FZ, values).expect("no press of a gel");
            found.to_string()
        };
        let large = said([900.0, 2_034.567_890_123_4, 4_100.0]);
        assert!(large.contains("`Fz` is typically 2030 N,"), "{large}");
        let small = said([0.0009, 0.002, 0.004_123_456_789]);
        assert!(small.contains("`Fz` is at most 0.00412 N,"), "{small}");
    }

    #[test]
    fn zeros_few_values_and_other_units_are_not_judged() {
        let ratio = Channel::named("grid_x", Unit::One).expect("a name");
        assert_eq!(magnitude_suspicion(&ratio, [1e9; 5]), None);
        assert_eq!(magnitude_suspicion(&Channel::FZ, [0.0; 50]), None);
        assert_eq!(magnitude_suspicion(&Channel::FZ, [1e-9, 1e-9]), None);
    }
}
