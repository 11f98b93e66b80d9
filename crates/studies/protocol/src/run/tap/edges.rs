//! Latency of each device, computed from recorded taps.

use super::heard::{Said, TapHeard};
use super::line::Line;
use crate::rig_file::Latency;

/// Distance above the gel from which on a signal counts as measured in the air, in mm.
const AIR_MM: f64 = 0.1;
/// Duration of the last section of a tap, in s. The tip rests in the gel, and every device reports this state.
const REST_S: f64 = 0.2;
/// Least number of readings, frames or poses in a section of a tap.
const LEAST: usize = 3;
/// Share of the whole change of a signal at which its edge lies. In the air, the signal stays below it.
const EDGE: f64 = 0.5;
/// Least share of the change that the signal has reached at rest.
const AT_REST: f64 = 0.75;
/// Distance from either end of the motion within which poses are ignored, in mm, because the arm accelerates there.
const END_MM: f64 = 0.05;
/// Least ratio of the greatest to the least speed of taps. At a smaller ratio, offset and latency cannot be separated.
const LEAST_RATIO: f64 = 1.5;
/// Greatest share of dropped taps, as a divisor: at most one tap in four.
const DROPPED: usize = 4;
/// Greatest share of taps dropped as late, as a divisor: at most one tap in five.
const LATE: usize = 5;
/// Number of standard deviations about the mean that contain the delay of 95 of 100 taps.
const WITHIN: f64 = 2.0;

/// Recordings of repeated taps at one place of the gel.
#[derive(Clone, Debug, PartialEq)]
pub struct Tapped {
    contact_mm: f64,
    reference_mm: f64,
    taps: Vec<TapHeard>,
}

/// Reasons why taps give no latency.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TapError {
    /// A device gave too few values in a section of a tap.
    #[error(
        "tap {tap}: {count} {what} arrived {stretch}, expected at least {LEAST}: measure the rate of the {device} with `taceva rig check`"
    )]
    Few {
        /// Number of the tap, counted from 1.
        tap: usize,
        /// Name of the device: `robot`, `force` or `sensor`.
        device: &'static str,
        /// Values of the device: `poses`, `readings` or `frames`.
        what: &'static str,
        /// Section of the tap, in words, such as `in the air before the contact`.
        stretch: &'static str,
        /// Number of values in this section.
        count: usize,
    },
    /// A device does not show the tap clearly. The signal in the air varies by at least half of the change at the touch.
    #[error(
        "tap {tap}: the {device} signal does not show the tap clearly: in the air the signal varies by {in_air:.2} of its change, expected below \
         {EDGE}; check the mounting, the light and the noise of the device"
    )]
    Unclear {
        /// Number of the tap, counted from 1.
        tap: usize,
        /// Name of the device: `force` or `sensor`.
        device: &'static str,
        /// Greatest deviation of the signal in the air, as a share of the change at the touch.
        in_air: f64,
    },
    /// The signal of a device still changes long after the tip came to rest.
    #[error(
        "tap {tap}: the {device} signal still changes after the tip has rested for 0.4 s: the latency is too long for a tap, or the gel creeps. Run the command again, lower the buffering of the device, or measure its `latency_ms` in another way and write it into the rig file"
    )]
    Late {
        /// Number of the tap, counted from 1.
        tap: usize,
        /// Name of the device: `force` or `sensor`.
        device: &'static str,
    },
    /// Too many taps are dropped as late, so the remaining taps would show too short a latency.
    #[error(
        "{late} of {taps} taps were left out as late, expected at most a fifth: the remaining taps show too short a latency. Run the command again, lower the buffering of the device, or measure its `latency_ms` in another way and write it into the rig file"
    )]
    MostlyLate {
        /// Number of late taps.
        late: usize,
        /// Number of all taps.
        taps: usize,
    },
    /// The robot does not follow the requested speeds.
    #[error(
        "the fast taps are {ratio:.2} times as fast as the slow taps, expected 3, so distance and latency cannot be separated: check whether the controller limits the speed"
    )]
    OneSpeed {
        /// Speed of the fastest tap divided by that of the slowest.
        ratio: f64,
    },
    /// The latency of a device differs too much between taps.
    #[error(
        "the latency of the {device} varies by {spread_ms:.1} ms between taps, expected at most half a frame, {allowed_ms:.1} ms. Stop other traffic and other programs, run with `chrt -f 10` if you do not yet, and check the rig for vibration"
    )]
    Spread {
        /// Name of the device: `force` or `sensor`.
        device: &'static str,
        /// Two standard deviations of the delay of a single tap, in ms.
        spread_ms: f64,
        /// Greatest allowed spread, in ms.
        allowed_ms: f64,
    },
}

/// Motion of the tip in one tap, as a straight line fitted to its poses over time.
#[derive(Clone, Copy, Debug)]
struct Passage {
    /// Time at which the tip passed the reference height, in s.
    at_s: f64,
    speed_mm_s: f64,
}

/// Motion of the tip in one tap, and the times in s at which the signals of transducer and sensor have changed by half.
#[derive(Clone, Copy, Debug)]
struct TapEdges {
    passage: Passage,
    force_s: f64,
    sensor_s: f64,
}

impl Tapped {
    /// Number of taps. They alternate between the speed in contact and a slower speed.
    pub const TAPS: u32 = 20;

    /// Empty record of taps on a gel at the height `contact_mm`. The time at which the tip passes `reference_mm` counts as the time of a tap.
    pub(super) fn new(contact_mm: f64, reference_mm: f64) -> Tapped {
        Tapped {
            contact_mm,
            reference_mm,
            taps: Vec::new(),
        }
    }

    pub(super) fn add(&mut self, heard: TapHeard) {
        self.taps.push(heard);
    }

    /// Number of recorded taps.
    pub fn count(&self) -> usize {
        self.taps.len()
    }

    /// Latencies of the transducer and of the sensor.
    ///
    /// Each tap gives a delay: from the time at which the tip passes the reference height, to the time at which the signal of a device has changed by
    /// half. Over all taps the delay is L + δ/v, a line in the reciprocal of the speed v. L is the latency. δ is the distance below the reference
    /// height at which the signal has changed by half.
    ///
    /// A tap that a device does not show clearly is dropped, up to a quarter of all taps. A late tap is dropped, up to a fifth of all taps.
    ///
    /// # Errors
    /// [`TapError`] for missing, unclear or contradictory signals. If more than a quarter of the taps have an error, the first of these errors is returned.
    pub fn latencies(&self) -> Result<(Latency, Latency), TapError> {
        let (mut clear, mut dropped) = (Vec::new(), Vec::new());
        for edges in self.edges() {
            match edges {
                Ok(edges) => clear.push(edges),
                Err(error) => dropped.push(error),
            }
        }
        if let Some(first) = dropped.first()
            && DROPPED * dropped.len() > self.taps.len()
        {
            return Err(*first);
        }
        let (late, taps) = (late_among(&dropped), self.taps.len());
        if LATE * late > taps {
            return Err(TapError::MostlyLate { late, taps });
        }
        let speeds = || clear.iter().map(|tap| tap.passage.speed_mm_s);
        let ratio = speeds().fold(0.0, f64::max) / speeds().fold(f64::INFINITY, f64::min);
        if ratio.is_nan() || ratio < LEAST_RATIO {
            return Err(TapError::OneSpeed { ratio });
        }
        let of = |edge_s: fn(&TapEdges) -> f64| {
            let late = clear.iter().map(|tap| {
                let Passage { at_s, speed_mm_s } = tap.passage;
                (1.0 / speed_mm_s, edge_s(tap) - at_s)
            });
            intercept(&late.collect::<Vec<_>>())
        };
        let force = of(|tap| tap.force_s);
        let sensor = of(|tap| tap.sensor_s);
        let allowed_ms = self.frame_period_s() / 2.0 * 1e3;
        for (device, latency) in [("force", force), ("sensor", sensor)] {
            // NaN is rejected too.
            if latency.spread_ms.is_nan() || latency.spread_ms > allowed_ms {
                return Err(TapError::Spread {
                    device,
                    spread_ms: latency.spread_ms,
                    allowed_ms,
                });
            }
        }
        Ok((force, sensor))
    }

    /// Reasons why taps are dropped, because a device does not show them clearly.
    pub fn dropped(&self) -> Vec<TapError> {
        self.edges().into_iter().filter_map(Result::err).collect()
    }

    /// Number of taps that are dropped as late.
    pub fn late(&self) -> usize {
        late_among(&self.dropped())
    }

    /// Motion and signal edges of each tap, in order; the reason for a dropped tap.
    fn edges(&self) -> Vec<Result<TapEdges, TapError>> {
        let taps = self.taps.iter().enumerate();
        taps.map(|(place, heard)| self.edges_of(place + 1, heard))
            .collect()
    }

    fn edges_of(&self, tap: usize, heard: &TapHeard) -> Result<TapEdges, TapError> {
        let passage = self.passage(tap, heard)?;
        let above_mm = self.reference_mm - self.contact_mm + AIR_MM;
        let air_s = passage.at_s - above_mm / passage.speed_mm_s;
        let edge_s = |device, what, said: &Said| Listened { tap, device, what }.edge_s(said, air_s);
        Ok(TapEdges {
            passage,
            force_s: edge_s("force", "readings", &heard.forces)?,
            sensor_s: edge_s("sensor", "frames", &heard.frames)?,
        })
    }

    fn passage(&self, tap: usize, heard: &TapHeard) -> Result<Passage, TapError> {
        let deepest = heard.heights.iter().map(|(_, height_mm)| *height_mm);
        let highest_mm = deepest.clone().fold(f64::INFINITY, f64::min);
        let deepest_mm = deepest.fold(f64::NEG_INFINITY, f64::max);
        let inside = highest_mm + END_MM..deepest_mm - END_MM;
        let under_way: Vec<(f64, f64)> = heard
            .heights
            .iter()
            .filter(|(_, height_mm)| inside.contains(height_mm))
            .map(|(at_s, height_mm)| (height_mm - self.reference_mm, *at_s))
            .collect();
        if under_way.len() < LEAST {
            return Err(TapError::Few {
                tap,
                device: "robot",
                what: "poses",
                stretch: "on the way into the gel",
                count: under_way.len(),
            });
        }
        let line = Line::through(&under_way);
        Ok(Passage {
            at_s: line.at_zero,
            speed_mm_s: 1.0 / line.slope,
        })
    }

    /// Median time between the frames of all taps, in s.
    fn frame_period_s(&self) -> f64 {
        let between = |heard: &TapHeard| -> Vec<f64> {
            let pairs = heard.frames.windows(2);
            pairs.map(|pair| pair[1].0 - pair[0].0).collect()
        };
        let mut periods: Vec<f64> = self.taps.iter().flat_map(between).collect();
        periods.sort_by(f64::total_cmp);
        periods.get(periods.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Description of one device in one tap, for errors.
struct Listened {
    tap: usize,
    device: &'static str,
    what: &'static str,
}

impl Listened {
    /// Time at which the signal `said` has changed by half, in s. Before `air_s`, the tip touches nothing.
    fn edge_s(&self, said: &Said, air_s: f64) -> Result<f64, TapError> {
        let Listened { tap, device, what } = *self;
        let end_s = said.last().map_or(0.0, |(at_s, _)| *at_s);
        let few = |stretch, count| TapError::Few {
            tap,
            device,
            what,
            stretch,
            count,
        };
        let stretch = |from_s: f64, to_s: f64| -> Vec<&[f64]> {
            let inside = said
                .iter()
                .filter(|(at_s, _)| (from_s..to_s).contains(at_s));
            inside.map(|(_, numbers)| numbers.as_slice()).collect()
        };
        let in_air = stretch(f64::NEG_INFINITY, air_s);
        let at_rest = stretch(end_s - REST_S, f64::INFINITY);
        if in_air.len() < LEAST {
            return Err(few("in the air before the contact", in_air.len()));
        }
        if at_rest.len() < LEAST {
            return Err(few("while the tip rested in the gel", at_rest.len()));
        }
        let (air, rest) = (mean(&in_air), mean(&at_rest));
        let change: Vec<f64> = rest
            .iter()
            .zip(&air)
            .map(|(rest, air)| rest - air)
            .collect();
        let whole: f64 = change.iter().map(|change| change * change).sum();
        // Projection on the change: 0 in the air, 1 at rest, independent of other variation.
        let shown = |numbers: &[f64]| -> f64 {
            let apart = numbers.iter().zip(&air).map(|(number, air)| number - air);
            apart
                .zip(&change)
                .map(|(apart, change)| apart * change)
                .sum::<f64>()
                / whole
        };
        let greatest = in_air.iter().map(|numbers| shown(numbers).abs());
        let in_air = greatest.fold(0.0, f64::max);
        // Without any change the projection is NaN.
        if whole <= 0.0 || in_air.is_nan() || in_air >= EDGE {
            return Err(TapError::Unclear {
                tap,
                device,
                in_air: if whole > 0.0 { in_air } else { f64::INFINITY },
            });
        }
        if at_rest.iter().any(|numbers| shown(numbers) < AT_REST) {
            return Err(TapError::Late { tap, device });
        }
        let mut before = (0.0, 0.0);
        for (at_s, numbers) in said {
            let now = shown(numbers);
            if now >= EDGE {
                let part = (EDGE - before.1) / (now - before.1);
                return Ok(before.0 + part * (at_s - before.0));
            }
            before = (*at_s, now);
        }
        Err(TapError::Late { tap, device })
    }
}

fn late_among(dropped: &[TapError]) -> usize {
    let late = |error: &&TapError| matches!(error, TapError::Late { .. });
    dropped.iter().filter(late).count()
}

/// Mean of each column.
fn mean(rows: &[&[f64]]) -> Vec<f64> {
    let mut sums = vec![0.0; rows.first().map_or(0, |row| row.len())];
    let mut count = 0.0_f64;
    for row in rows {
        count += 1.0;
        for (sum, number) in sums.iter_mut().zip(*row) {
            *sum += number;
        }
    }
    sums.into_iter().map(|sum| sum / count.max(1.0)).collect()
}

/// Latency from pairs `late` of a reciprocal speed and a delay in s: the delay extrapolated to infinite speed.
fn intercept(late: &[(f64, f64)]) -> Latency {
    let line = Line::through(late);
    Latency {
        after_robot_ms: line.at_zero * 1e3,
        error_ms: WITHIN * line.error * 1e3,
        spread_ms: WITHIN * line.deviation * 1e3,
    }
}

#[cfg(test)]
mod tests;
