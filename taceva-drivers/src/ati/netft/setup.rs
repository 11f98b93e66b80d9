//! Settings of a box that determine the meaning of its readings: frame, filter, rate, range and bias.

use std::collections::BTreeMap;

use super::page::{PAGE, Page, PageError};
use crate::text::shown;

/// Settings of a box, as its page states them.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Setup {
    /// Model of the box, and serial number of the calibrated transducer; empty if the page lacks them.
    product: String,
    serial: String,
    /// Displacement and rotation of the tool frame; `None` if the page lacks them.
    tool: Option<[f64; 6]>,
    /// Units of the displacement and of the rotation.
    tool_units: [String; 2],
    /// Number of the low pass, 0 for none; `None` if the page lacks it.
    filter: Option<f64>,
    /// Configured rate of records, Hz; `internal_hz` is the rate of the measurement.
    rate_hz: Option<f64>,
    internal_hz: Option<f64>,
    /// Measuring ranges of the forces, N.
    ranges_n: Option<[f64; 3]>,
    /// True if the box subtracts a bias.
    is_biased: Option<bool>,
    /// Entries of the page that cannot be read.
    unread: Vec<String>,
}

/// Frame of readings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Frame {
    /// The transducer's own axes.
    Own,
    /// The tool frame that is set in the box.
    Tool,
}

/// Expectations of the selector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Expected {
    pub(super) frame: Frame,
    /// Rate of records, Hz.
    pub(super) rate_hz: Option<f64>,
    /// Measuring range, N.
    pub(super) force_max_n: Option<f64>,
}

/// Cutoffs of the low passes of a Net F/T box by their number, from 1, Hz.
const CUTOFFS_HZ: [f64; 12] = [
    838.0, 326.0, 152.0, 73.0, 35.0, 18.0, 8.0, 5.0, 1_500.0, 2_000.0, 2_500.0, 3_000.0,
];
/// Greatest difference of two rates, or of two ranges, that count as equal.
const EQUAL: f64 = 0.01;

impl Setup {
    /// Reads the settings from `page`. Its force unit is `force_unit_n`. An unreadable entry counts as absent.
    ///
    /// # Errors
    /// [`PageError::Entry`] for an unreadable tool frame, which decides the axes.
    pub(super) fn read(page: &Page, force_unit_n: f64) -> Result<Setup, PageError> {
        let tool = page.six("cfgtfx")?;
        let mut unread = Vec::new();
        let range = or_unread(page.six("cfgmr"), &mut unread);
        let ranges_n = range.map(|[x, y, z, ..]| [x, y, z].map(|range| range * force_unit_n));
        let bias = or_unread(page.six("setbias"), &mut unread);
        Ok(Setup {
            product: page.entry("prodname"),
            serial: page.entry("cfgcalsn"),
            tool,
            tool_units: ["scfgtdu", "scfgtau"].map(|key| page.entry(key)),
            filter: or_unread(page.number("setuserfilter"), &mut unread),
            rate_hz: or_unread(page.number("comrdtrate"), &mut unread),
            internal_hz: or_unread(page.number("runrate"), &mut unread),
            ranges_n: ranges_n.filter(|ranges_n| least(*ranges_n) > 0.0),
            is_biased: bias.map(|bias| bias.into_iter().any(is_set)),
            unread,
        })
    }

    /// Smallest measuring range of a force, N.
    fn range_n(&self) -> Option<f64> {
        self.ranges_n.map(least)
    }

    /// Measuring range of each force, N. In a tool frame it is the smallest of all.
    pub(super) fn ranges_n(&self) -> Option<[f64; 3]> {
        let ranges_n = self.ranges_n?;
        Some(match self.is_turned() {
            true => [least(ranges_n); 3],
            false => ranges_n,
        })
    }

    /// Fails if the settings contradict the selector.
    ///
    /// # Errors
    /// A sentence with the setting, the expectation and the remedy.
    pub(super) fn check(&self, expected: &Expected) -> Result<(), String> {
        if self.is_turned() && expected.frame == Frame::Own {
            return Err(format!(
                "the box moves its readings into a tool frame (`cfgtfx` in {PAGE} is {}), expected zeros: clear the tool transformation on its Configurations page, or add `frame=tool` to the selector to measure in that frame",
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

    /// Rates of a box that is set to `set_hz`: it sends every n-th reading, so its true rate may be higher.
    fn rates_hz(&self, set_hz: f64) -> impl Iterator<Item = f64> {
        let internal_hz = self
            .internal_hz
            .filter(|internal_hz| *internal_hz >= set_hz);
        let sent_hz = internal_hz.map(|internal_hz| internal_hz / (internal_hz / set_hz).floor());
        std::iter::once(set_hz).chain(sent_hz)
    }

    /// True if the box has a tool frame.
    fn is_turned(&self) -> bool {
        self.tool.is_some_and(|tool| tool.into_iter().any(is_set))
    }

    /// `0;0;0;90;0;45 (mm, degrees)`.
    fn tool_in_words(&self) -> String {
        let numbers = self
            .tool
            .unwrap_or_default()
            .map(|number| number.to_string());
        let units = self.tool_units.clone().map(|unit| shown(&unit));
        format!("{} ({})", numbers.join(";"), units.join(", "))
    }

    /// Settings by name, as a recording keeps them.
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

    /// Remarks on settings that shift readings and are not undone.
    pub(super) fn warnings(&self) -> Vec<String> {
        let unread = self.unread.iter();
        let mut warnings: Vec<String> = unread
            .map(|problem| format!("{problem}; it is neither checked nor recorded: compare the settings on the pages of the box"))
            .collect();
        if self.tool.is_none() {
            warnings.push(format!(
                "{PAGE} has no `cfgtfx`, so a turned tool frame would not be noticed: compare the axes with a weight"
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
                "low pass {filter} of the box (`setuserfilter`) {delay}, which only `latency_ms` under [force] takes off: set it to 0 on the Settings page of the box, or run `taceva rig tap`"
            ));
        }
        warnings
    }
}

/// Value of an entry. The error of an unreadable entry is added to `unread`.
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

/// Cutoff of the low pass `filter`, Hz; `None` for an unknown number.
fn cutoff_hz(filter: f64) -> Option<f64> {
    let numbered = (1_u8..).zip(CUTOFFS_HZ);
    let mut found = numbered.filter(|(number, _)| (f64::from(*number) - filter).abs() < 0.5);
    found.next().map(|(_, cutoff_hz)| cutoff_hz)
}

/// Delay of a low pass of first order at low frequencies, ms: 1 / (2π·cutoff).
fn delay_ms(cutoff_hz: f64) -> f64 {
    1e3 / (std::f64::consts::TAU * cutoff_hz)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: &str = "<netft><prodname>Net F/T</prodname><runrate>7000</runrate><setuserfilter>0</setuserfilter><setbias>0;0;0;0;0;0</setbias><cfgcalsn>FT12345</cfgcalsn><cfgmr>65;65;200;5;5;5</cfgmr><scfgtdu>mm</scfgtdu><scfgtau>degrees</scfgtau><cfgtfx>0;0;0;0;0;0</cfgtfx><comrdtrate>500</comrdtrate></netft>";

    fn setup(page: &str) -> Setup {
        let page = Page::whole(page.to_owned()).expect("a whole page");
        Setup::read(&page, 1.0).expect("settings")
    }

    fn expected() -> Expected {
        Expected {
            frame: Frame::Own,
            rate_hz: None,
            force_max_n: None,
        }
    }

    #[test]
    fn settings_of_a_plain_box_are_kept_without_a_warning() {
        let setup = setup(PLAIN);
        assert_eq!(setup.check(&expected()), Ok(()));
        assert_eq!(setup.warnings(), Vec::<String>::new());
        assert_eq!(setup.ranges_n(), Some([65.0, 65.0, 200.0]));
        let kept: Vec<String> = setup
            .settings()
            .into_iter()
            .map(|(key, value)| format!("{key}={value}"))
            .collect();
        assert_eq!(
            kept,
            [
                "bias=none",
                "box=Net F/T",
                "filter=0",
                "frame=own",
                "range_N=65",
                "rate_hz=500",
                "serial=FT12345"
            ]
        );
    }

    #[test]
    fn a_turned_tool_frame_is_refused_unless_it_is_wanted_and_then_kept() {
        let turned = setup(&PLAIN.replace("<cfgtfx>0;0;0;0;0;0", "<cfgtfx>0;0;0;90;0;45"));
        let refused = turned.check(&expected()).expect_err("turned");
        for words in [
            "0;0;0;90;0;45 (mm, degrees)",
            "Configurations page",
            "`frame=tool`",
        ] {
            assert!(refused.contains(words), "{refused}");
        }
        let wanted = Expected {
            frame: Frame::Tool,
            ..expected()
        };
        assert_eq!(turned.check(&wanted), Ok(()));
        assert_eq!(turned.ranges_n(), Some([65.0; 3]));
        let frame = turned.settings().remove("frame");
        assert_eq!(frame.as_deref(), Some("tool 0;0;0;90;0;45 (mm, degrees)"));
        let moved = setup(&PLAIN.replace("<cfgtfx>0;", "<cfgtfx>12.5;"));
        assert!(moved.check(&expected()).is_err());
    }

    #[test]
    fn a_rate_or_a_range_that_the_selector_states_otherwise_is_refused_with_the_line_to_write() {
        let setup = setup(PLAIN);
        let with_rate = |rate_hz| {
            setup.check(&Expected {
                rate_hz: Some(rate_hz),
                ..expected()
            })
        };
        assert_eq!(with_rate(500.0), Ok(()));
        let refused = with_rate(1000.0).expect_err("another rate");
        assert!(refused.contains("`rate=500`"), "{refused}");
        let with_range = |force_max_n| {
            setup.check(&Expected {
                force_max_n: Some(force_max_n),
                ..expected()
            })
        };
        assert_eq!(with_range(65.0), Ok(()));
        assert_eq!(with_range(20.0), Ok(()));
        let refused = with_range(650.0).expect_err("too wide");
        assert!(refused.contains("`force_max_n=65`"), "{refused}");
    }

    #[test]
    fn a_box_that_rounds_its_rate_up_may_be_stated_by_either_rate() {
        let setup = setup(&PLAIN.replace("<comrdtrate>500", "<comrdtrate>2000"));
        for rate_hz in [2000.0, 2333.3] {
            let stated = Expected {
                rate_hz: Some(rate_hz),
                ..expected()
            };
            assert_eq!(setup.check(&stated), Ok(()), "{rate_hz}");
        }
    }

    #[test]
    fn a_low_pass_is_kept_and_its_delay_is_a_warning() {
        for (filter, words) in [
            ("8", "about 31.8 ms"),
            ("4", "about 2.2 ms"),
            ("12", "about 0.1 ms"),
            ("13", "an unknown time"),
        ] {
            let page = PLAIN.replace("<setuserfilter>0", &format!("<setuserfilter>{filter}"));
            let setup = setup(&page);
            let warnings = setup.warnings();
            assert_eq!(warnings.len(), 1, "{warnings:?}");
            let is_named = warnings[0].contains(words) && warnings[0].contains("latency_ms");
            assert!(is_named, "{warnings:?}");
            assert_eq!(
                setup.settings().get("filter").map(String::as_str),
                Some(filter)
            );
        }
    }

    #[test]
    fn an_entry_in_another_form_is_a_warning_and_a_tool_frame_in_one_is_refused() {
        let other = setup(
            &PLAIN
                .replace("<setuserfilter>0", "<setuserfilter>aus")
                .replace("65;65;200;5;5;5", "65;65;200"),
        );
        assert_eq!(other.check(&expected()), Ok(()));
        assert_eq!(other.ranges_n(), None);
        assert_eq!(other.settings().get("filter"), None);
        let warnings = other.warnings();
        assert_eq!(warnings.len(), 2, "{warnings:?}");
        for (warning, words) in warnings.iter().zip(["`cfgmr`", "is `aus`"]) {
            assert!(warning.contains(words), "{warning}");
        }
        let page = PLAIN.replace("<cfgtfx>0;0;0;0;0;0", "<cfgtfx>0;0;0;90 deg;0;45");
        let page = Page::whole(page).expect("a whole page");
        let error = Setup::read(&page, 1.0).expect_err("a frame").to_string();
        assert!(error.contains("`cfgtfx`"), "{error}");
    }

    #[test]
    fn a_bias_is_kept_and_a_page_without_settings_is_a_warning() {
        let biased = setup(&PLAIN.replace("<setbias>0;0;0", "<setbias>0;-7;0"));
        assert_eq!(
            biased.settings().get("bias").map(String::as_str),
            Some("set")
        );
        let bare = setup("<netft></netft>");
        assert_eq!(bare.check(&expected()), Ok(()));
        assert_eq!(bare.settings().len(), 1, "{:?}", bare.settings());
        assert_eq!(
            bare.settings().get("frame").map(String::as_str),
            Some("unknown")
        );
        assert_eq!(bare.warnings().len(), 1);
    }
}
