//! Follows the clock of a camera against the clock of this machine, and removes its drift from the time stamps.
//!
//! The offset of a frame is the time from its stamp to its arrival. Delays only increase the offset, so only the least offset in each block of frames
//! is used. The slope of a line through these least offsets gives the drift. The median of all pairwise slopes (Theil 1950, Sen 1968), weighted by
//! their times, is not affected by blocks in which every frame was delayed.

use std::collections::BTreeMap;

use taceva_core::Stamp;

/// Duration of the first blocks, s. It doubles each time the blocks are merged, up to `BLOCK_MAX_S`.
const BLOCK_S: f64 = 0.25;
const BLOCK_MAX_S: f64 = 4.0;
/// Minimum number of frames in a block. They must arrive within [`FRAMES_WITHIN_S`], s.
const FRAMES: u32 = 4;
const FRAMES_WITHIN_S: f64 = 30.0;
/// Minimum number of blocks for a line; the maximum is [`BLOCKS_MAX`]. A drift is only corrected with at least [`FOLLOWED_MIN`] blocks.
const BLOCKS_MIN: usize = 6;
const BLOCKS_MAX: usize = 64;
const FOLLOWED_MIN: usize = 12;
/// Greatest corrected drift, ppm. The drift of an oscillator is smaller.
const PPM_MAX: f64 = 1000.0;
/// Number of standard uncertainties above which a drift is corrected.
const SHOWN: f64 = 3.0;
/// Greatest error, s, of a line that is extrapolated after its last block. The assumed error of its slope is [`SHOWN`] standard uncertainties.
const CONTINUED_S: f64 = 1e-3;
/// Ratio of the standard deviation of a normal distribution to its median absolute deviation.
const NORMAL: f64 = 1.4826;
/// Greatest change of the drift correction between two stamps, relative to the time between them. Corrected stamps therefore keep their order.
const SLEW: f64 = 0.5;
/// Setting of a recording that states the drift, ppm; [`DRIFT_U`] states its standard uncertainty.
const DRIFT: &str = "sensor_clock_drift_ppm";
const DRIFT_U: &str = "sensor_clock_drift_u_ppm";

/// Estimates and removes the drift of one camera's clock.
#[derive(Clone, Debug, Default)]
pub(super) struct ClockFollower {
    block: Option<Block>,
    /// Least offset of each complete block, the oldest first.
    least: Vec<Offset>,
    /// Number of times that the blocks were merged.
    merged: i32,
    line: Option<Line>,
    /// Time from stamp to arrival before the drift correction, s; `None` until a drift is detected.
    anchor_s: Option<f64>,
    /// Drift removed from the last stamp, s. The field `last_s` is this stamp as the camera sent it, s.
    taken_off_s: f64,
    last_s: Option<f64>,
}

/// Time from the stamp of a frame to its arrival, and the time of that arrival, s.
#[derive(Clone, Copy, Debug)]
struct Offset {
    at_s: f64,
    offset_s: f64,
}

/// Block of frames in progress.
#[derive(Clone, Copy, Debug)]
struct Block {
    begun_s: f64,
    frames: u32,
    least: Offset,
}

/// Line through the least offsets of the blocks, over time.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// A point of the line.
    middle: Offset,
    slope: f64,
    /// Standard uncertainty of the slope.
    slope_u: f64,
}

/// Slope between two offsets, weighted by the time between them.
#[derive(Clone, Copy, Debug)]
struct Slope {
    slope: f64,
    weight: f64,
}

impl Line {
    /// Robust line through at least two offsets at different times.
    fn through(offsets: &[Offset]) -> Line {
        let count = f64::from(u32::try_from(offsets.len()).unwrap_or(u32::MAX));
        let middle_s = offsets.iter().map(|offset| offset.at_s).sum::<f64>() / count;
        let pairs = offsets.iter().enumerate();
        let slopes = pairs.flat_map(|(place, one)| {
            let later = offsets[place + 1..].iter();
            later.map(move |other| Slope {
                slope: (other.offset_s - one.offset_s) / (other.at_s - one.at_s),
                weight: other.at_s - one.at_s,
            })
        });
        let slope = weighted_median(slopes.collect());
        let flat = |offset: &Offset| offset.offset_s - slope * (offset.at_s - middle_s);
        let middle = Offset {
            at_s: middle_s,
            offset_s: median(offsets.iter().map(flat).collect()),
        };
        let off = offsets
            .iter()
            .map(|offset| (flat(offset) - middle.offset_s).abs());
        let spread_s = NORMAL * median(off.collect());
        let squares = offsets
            .iter()
            .map(|offset| (offset.at_s - middle_s).powi(2));
        Line {
            middle,
            slope,
            slope_u: spread_s / squares.sum::<f64>().sqrt(),
        }
    }

    fn at(&self, at_s: f64) -> f64 {
        self.middle.offset_s + self.slope * (at_s - self.middle.at_s)
    }

    /// True if the slope exceeds its uncertainty, and is small enough for an oscillator.
    fn shows_drift(&self) -> bool {
        let slope = self.slope.abs();
        slope > SHOWN * self.slope_u && slope <= PPM_MAX * 1e-6
    }
}

impl ClockFollower {
    /// Updates the drift estimate with the stamp of a frame that arrived at `now_s` or earlier, s. Returns the stamp without the drift since the
    /// first frames.
    pub(super) fn follow(&mut self, stamp: Stamp, now_s: f64) -> Stamp {
        let at_s = stamp.received_s.unwrap_or(now_s);
        self.see(Offset {
            at_s,
            offset_s: at_s - stamp.valid_s,
        });
        if let (Some(line), [oldest, .., newest]) = (self.line, self.least.as_slice())
            && self.least.len() >= FOLLOWED_MIN
            && line.shows_drift()
        {
            // During a pause, an extrapolation would multiply the error of the slope.
            let known_s = newest.at_s + CONTINUED_S / (SHOWN * line.slope_u);
            let anchor_s = *self.anchor_s.get_or_insert(line.at(oldest.at_s));
            let wanted_s = line.at(at_s.min(known_s)) - anchor_s;
            let passed_s = self.last_s.map_or(0.0, |last_s| stamp.valid_s - last_s);
            let most_s = SLEW * passed_s.max(0.0);
            self.taken_off_s += (wanted_s - self.taken_off_s).clamp(-most_s, most_s);
        }
        self.last_s = Some(stamp.valid_s);
        Stamp {
            valid_s: stamp.valid_s + self.taken_off_s,
            ..stamp
        }
    }

    /// Drift of the clock in the last minutes and its standard uncertainty, as settings of a recording; empty after too few frames.
    pub(super) fn settings(&self) -> BTreeMap<String, String> {
        let Some(line) = self.line else {
            return BTreeMap::new();
        };
        // A camera whose clock is fast stamps too late, so its offset falls.
        // The sum with 0 turns -0 into 0.
        let ppm = (-1e8 * line.slope).round() / 100.0 + 0.0;
        // An uncertainty is not rounded down.
        let u_ppm = (1e8 * line.slope_u).ceil() / 100.0;
        BTreeMap::from([
            (DRIFT.to_owned(), format!("{ppm:.2}")),
            (DRIFT_U.to_owned(), format!("{u_ppm:.2}")),
        ])
    }

    /// Adds the stamp-to-arrival time of a frame to its block. The first frame after the end of a block begins the next block, so that no block spans
    /// a pause.
    fn see(&mut self, seen: Offset) {
        let lasts_s = (BLOCK_S * 2.0_f64.powi(self.merged)).min(BLOCK_MAX_S);
        if let Some(block) = self.block {
            let passed_s = seen.at_s - block.begun_s;
            if passed_s >= lasts_s && block.frames >= FRAMES {
                self.block = None;
                self.close(block.least, lasts_s);
            } else if passed_s >= FRAMES_WITHIN_S {
                self.block = None;
            }
        }
        let block = self.block.get_or_insert(Block {
            begun_s: seen.at_s,
            frames: 0,
            least: seen,
        });
        block.frames += 1;
        if seen.offset_s < block.least.offset_s {
            block.least = seen;
        }
    }

    /// Adds the least offset in a complete block that lasts `lasts_s`, in s.
    fn close(&mut self, least: Offset, lasts_s: f64) {
        let is_later = self.least.last().is_none_or(|last| last.at_s < least.at_s);
        if !is_later {
            return;
        }
        self.least.push(least);
        if self.least.len() > BLOCKS_MAX {
            self.shorten(lasts_s);
        }
        if self.least.len() >= BLOCKS_MIN {
            self.line = Some(Line::through(&self.least));
        }
    }

    /// Merges neighbouring blocks that last `lasts_s` each, in s, or forgets the oldest block if the blocks have their full duration.
    fn shorten(&mut self, lasts_s: f64) {
        if lasts_s >= BLOCK_MAX_S {
            self.least.remove(0);
            return;
        }
        let pairs = self.least.chunks(2);
        let lower = pairs.map(|pair| match pair {
            [one, other] if other.offset_s < one.offset_s => *other,
            pair => pair[0],
        });
        self.least = lower.collect();
        self.merged += 1;
    }
}

/// Settings that a device measures while it is read: the drift of its clock.
pub(crate) fn measured_settings(now: BTreeMap<String, String>) -> BTreeMap<String, String> {
    let mut settings = now;
    settings.retain(|name, _| [DRIFT, DRIFT_U].contains(&name.as_str()));
    settings
}

/// Weighted median of at least one slope.
fn weighted_median(mut slopes: Vec<Slope>) -> f64 {
    slopes.sort_unstable_by(|one, other| one.slope.total_cmp(&other.slope));
    let half = slopes.iter().map(|of| of.weight).sum::<f64>() / 2.0;
    let mut below = 0.0;
    let found = slopes.iter().find(|of| {
        below += of.weight;
        below >= half
    });
    found.or(slopes.last()).map_or(f64::NAN, |of| of.slope)
}

/// Median of finite values; NaN without values.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_unstable_by(f64::total_cmp);
    match values.len() {
        0 => f64::NAN,
        count if count % 2 == 1 => values[count / 2],
        count => f64::midpoint(values[count / 2 - 1], values[count / 2]),
    }
}

#[cfg(test)]
mod tests;
