//! Settings of a Net F/T box that determine the meaning of its readings: frame, filter, rate, range and bias.

use std::collections::BTreeMap;

use super::page::{PAGE, Page, PageError};
use crate::text::shown;

/// Settings of a Net F/T box, read from its configuration page.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setup {
    /// Model of the box; empty if the page lacks it. `serial` is the serial number of the calibrated transducer.
    product: String,
    serial: String,
    /// Displacement along x, y and z and rotation about x, y and z of the tool frame; `None` if the page lacks them.
    tool: Option<[f64; 6]>,
    /// Units of the displacement and of the rotation of the tool frame.
    tool_units: [String; 2],
    /// Number of the low-pass filter, 0 for no filter; `None` if the page states no number.
    filter: Option<f64>,
    /// Configured rate of records, Hz; `None` if the page lacks it. `internal_hz` is the rate at which the box measures.
    rate_hz: Option<f64>,
    internal_hz: Option<f64>,
    /// Measuring ranges of Fx, Fy and Fz, N; `None` if unknown.
    ranges_n: Option<[f64; 3]>,
    /// True if the box subtracts a bias; `None` if the page does not state it.
    is_biased: Option<bool>,
    /// Messages about unreadable entries of the page, and about a missing entry for the low-pass filter.
    unread: Vec<String>,
}

/// Frame of reference of the readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Frame {
    /// The frame of the transducer itself.
    Own,
    /// The tool frame that is set in the box.
    Tool,
}

/// Settings of the box that the driver's arguments expect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Expected {
    pub(super) frame: Frame,
    /// Rate of records, Hz; `None` accepts any rate.
    pub(super) rate_hz: Option<f64>,
    /// Minimum of the smallest measuring range of the forces, N; `None` accepts any range.
    pub(super) force_max_n: Option<f64>,
}

/// Cutoff frequencies of the low-pass filters of a Net F/T box, Hz. The first entry belongs to filter number 1.
const CUTOFFS_HZ: [f64; 12] = [
    838.0, 326.0, 152.0, 73.0, 35.0, 18.0, 8.0, 5.0, 1_500.0, 2_000.0, 2_500.0, 3_000.0,
];
/// Maximum relative difference at which two rates, or two ranges, count as equal.
const EQUAL: f64 = 0.01;

impl Setup {
    /// Reads the settings from `page`, whose force unit is `force_unit_n`, N. Each unreadable entry counts as absent and causes a warning, as does a
    /// missing low-pass filter entry.
    ///
    /// # Errors
    /// [`PageError::Entry`] for an unreadable tool frame, because the tool frame determines the axes.
    pub(super) fn read(page: &Page, force_unit_n: f64) -> Result<Setup, PageError> {
        let tool = page.six("cfgtfx")?;
        let mut unread = Vec::new();
        let range = or_unread(page.six("cfgmr"), &mut unread);
        let ranges_n = range.map(|[x, y, z, ..]| [x, y, z].map(|range| range * force_unit_n));
        let bias = or_unread(page.six("setbias"), &mut unread);
        // Without this entry a low pass would delay forces without a warning.
        let filter = page.number("setuserfilter").and_then(|filter| {
            filter.ok_or_else(|| PageError::entry("setuserfilter", "a number", ""))
        });
        Ok(Setup {
            product: page.entry("prodname"),
            serial: page.entry("cfgcalsn"),
            tool,
            tool_units: ["scfgtdu", "scfgtau"].map(|key| page.entry(key)),
            filter: or_unread(filter.map(Some), &mut unread),
            rate_hz: or_unread(page.number("comrdtrate"), &mut unread),
            internal_hz: or_unread(page.number("runrate"), &mut unread),
            ranges_n: ranges_n.filter(|ranges_n| least(*ranges_n) > 0.0),
            is_biased: bias.map(|bias| bias.into_iter().any(is_set)),
            unread,
        })
    }

    /// Smallest of the measuring ranges of Fx, Fy and Fz, N; `None` if unknown.
    fn range_n(&self) -> Option<f64> {
        self.ranges_n.map(least)
    }

    /// Measuring range of each force, N; `None` if unknown. In a tool frame, each force has the smallest of the three ranges.
    pub(super) fn ranges_n(&self) -> Option<[f64; 3]> {
        let ranges_n = self.ranges_n?;
        Some(match self.is_turned() {
            true => [least(ranges_n); 3],
            false => ranges_n,
        })
    }

    /// Checks that the settings of the box agree with `expected`.
    ///
    /// # Errors
    /// A sentence with the setting, the expected value and the remedy.
    pub(super) fn check(&self, expected: &Expected) -> Result<(), String> {
        if self.is_turned() && expected.frame == Frame::Own {
            return Err(format!(
                "the box transforms its readings into a tool frame (`cfgtfx` in {PAGE} is {}), expected zeros: clear the tool transformation on its Configurations page, or add `frame=tool` to the selector to measure in that frame",
                self.tool_in_words()
            ));
        }
        if let Some(rate_hz) = expected.rate_hz
            && let Some(set_hz) = self.rate_hz
            && !self.rates_hz(set_hz).any(|hz| is_near(hz, rate_hz))
        {
            return Err(format!(
                "the box sends {set_hz} readings per second (`comrdtrate` in {PAGE}), expected {rate_hz} by the selector: write `rate={set_hz}`, or set the RDT output rate on its Communications page"
            ));
        }
        if let Some(stated_n) = expected.force_max_n
            && let Some(range_n) = self.range_n()
            && stated_n > range_n
            && !is_near(stated_n, range_n)
        {
            return Err(format!(
                "the smallest range of the forces is {range_n} N (`cfgmr` in {PAGE}), expected at least {stated_n} N by the selector: write `force_max_n={range_n}`, omit it to use the range of each force, or select the calibration of that range on its Configurations page"
            ));
        }
        Ok(())
    }

    /// Possible record rates of a box set to `set_hz`, Hz: `set_hz`, and the lowest whole fraction of the measuring rate that is at least `set_hz`.
    fn rates_hz(&self, set_hz: f64) -> impl Iterator<Item = f64> {
        let internal_hz = self
            .internal_hz
            .filter(|internal_hz| *internal_hz >= set_hz);
        let sent_hz = internal_hz.map(|internal_hz| internal_hz / (internal_hz / set_hz).floor());
        std::iter::once(set_hz).chain(sent_hz)
    }

    /// True if the tool frame has a displacement or a rotation other than zero.
    fn is_turned(&self) -> bool {
        self.tool.is_some_and(|tool| tool.into_iter().any(is_set))
    }

    /// Displacement and rotation of the tool frame as text: `0;0;0;90;0;45 (mm, degrees)`.
    fn tool_in_words(&self) -> String {
        let numbers = self
            .tool
            .unwrap_or_default()
            .map(|number| number.to_string());
        let units = self.tool_units.clone().map(|unit| shown(&unit));
        format!("{} ({})", numbers.join(";"), units.join(", "))
    }

    /// Settings of the box by name, for storage with a recording.
    pub(super) fn settings(&self) -> BTreeMap<String, String> {
        let frame = match self.tool {
            None => "unknown".to_owned(),
            Some(_) if self.is_turned() => format!("tool {}", self.tool_in_words()),
            Some(_) => "own".to_owned(),
        };
        let bias = self.is_biased.map(|is_biased| match is_biased {
            true => "set".to_owned(),
            false => "none".to_owned(),
        });
        let number = |number: Option<f64>| number.map(|number| number.to_string());
        let known = [
            ("box", Some(shown(&self.product))),
            ("serial", Some(shown(&self.serial))),
            ("frame", Some(frame)),
            ("filter", number(self.filter)),
            ("rate_hz", number(self.rate_hz)),
            ("range_N", number(self.range_n())),
            ("bias", bias),
        ];
        let known = known.into_iter().filter_map(|(key, value)| {
            let value = value.filter(|value| !value.is_empty())?;
            Some((key.to_owned(), value))
        });
        known.collect()
    }

    /// Warnings about unreadable settings, and about settings that change readings and are not corrected by the driver.
    pub(super) fn warnings(&self) -> Vec<String> {
        let unread = self.unread.iter();
        let mut warnings: Vec<String> = unread
            .map(|problem| format!("{problem}; this setting is not checked or recorded: compare the settings on the pages of the box"))
            .collect();
        if self.tool.is_none() {
            warnings.push(format!(
                "{PAGE} has no `cfgtfx`, so a turned tool frame is not detected: compare the axes with a weight"
            ));
        }
        if let Some(filter) = self.filter.filter(|filter| is_set(*filter)) {
            let delay = match cutoff_hz(filter) {
                Some(cutoff_hz) => format!(
                    "delays forces by about {:.1} ms (a Net F/T box cuts off at {cutoff_hz} Hz)",
                    delay_ms(cutoff_hz)
                ),
                None => "delays forces by an unknown time".to_owned(),
            };
            warnings.push(format!(
                "low pass {filter} of the box (`setuserfilter`) {delay}, which only `latency_ms` under [force] corrects: switch the filter off (0) on the Settings page of the box, or run `taceva rig tap`"
            ));
        }
        warnings
    }
}

/// Value of `found`. An error gives `None`, and its message is appended to `unread`.
fn or_unread<T>(found: Result<Option<T>, PageError>, unread: &mut Vec<String>) -> Option<T> {
    found.unwrap_or_else(|error| {
        unread.push(error.to_string());
        None
    })
}

fn least([x, y, z]: [f64; 3]) -> f64 {
    x.min(y).min(z)
}

fn is_set(number: f64) -> bool {
    number.abs() > 0.0
}

fn is_near(one: f64, other: f64) -> bool {
    (one - other).abs() <= EQUAL * other.abs()
}

/// Cutoff frequency of the low-pass filter with number `filter`, Hz; `None` for an unknown number.
fn cutoff_hz(filter: f64) -> Option<f64> {
    let numbered = (1_u8..).zip(CUTOFFS_HZ);
    let mut found = numbered.filter(|(number, _)| (f64::from(*number) - filter).abs() < 0.5);
    found.next().map(|(_, cutoff_hz)| cutoff_hz)
}

/// Delay of a first-order low-pass filter at low frequencies, ms: 1 / (2π·cutoff).
fn delay_ms(cutoff_hz: f64) -> f64 {
    1e3 / (std::f64::consts::TAU * cutoff_hz)
}

#[cfg(test)]
mod tests;
