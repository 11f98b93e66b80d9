//! Faults of a simulated rig, with their times and durations.

use std::fmt;

use super::draws::Draws;

/// Kind of fault of a rig.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// The force transducer gives no reading.
    Silence,
    /// The force transducer repeats its last reading with fresh stamps.
    Freeze,
    /// The force transducer gives NaN.
    NotANumber,
    /// The force transducer is at the end of its range.
    Saturation,
    /// The readings arrive late.
    StaleStamps,
    /// The camera loses frames, or returns old ones.
    DroppedFrames,
    /// Every call takes longer, and force readings wait in buffers.
    SlowLink,
    /// The robot reports a motion that it did not make.
    StuckRobot,
    /// The disk writes part of the data, and then rejects all writes.
    FullDisk,
    /// The process ends between two instructions. Unsynced data may be lost or torn.
    Kill,
    /// The run is cancelled.
    Cancel,
    /// The emergency stop is pressed. The robot does not move until a person acknowledges it.
    EmergencyStop,
    /// Reports of the robot do not reach its monitoring thread. The robot still answers queries.
    NoReports,
    /// The enabling switch is released, for a moment or for longer than a run waits for it.
    Released,
    /// The enabling switch cannot be read until it is plugged in again.
    Unplugged,
}

impl FaultKind {
    /// Every kind.
    pub const ALL: [FaultKind; 15] = [
        FaultKind::Silence,
        FaultKind::Freeze,
        FaultKind::NotANumber,
        FaultKind::Saturation,
        FaultKind::StaleStamps,
        FaultKind::DroppedFrames,
        FaultKind::SlowLink,
        FaultKind::StuckRobot,
        FaultKind::FullDisk,
        FaultKind::Kill,
        FaultKind::Cancel,
        FaultKind::EmergencyStop,
        FaultKind::NoReports,
        FaultKind::Released,
        FaultKind::Unplugged,
    ];
    /// Number of kinds, from the start of [`ALL`](FaultKind::ALL), among which most faults are drawn. Separate draws decide the other kinds.
    const DRAWN: u64 = 11;

    /// Word in reports.
    pub const fn name(self) -> &'static str {
        match self {
            FaultKind::Silence => "silence",
            FaultKind::Freeze => "freeze",
            FaultKind::NotANumber => "not a number",
            FaultKind::Saturation => "saturation",
            FaultKind::StaleStamps => "stale stamps",
            FaultKind::DroppedFrames => "dropped frames",
            FaultKind::SlowLink => "slow link",
            FaultKind::StuckRobot => "stuck robot",
            FaultKind::FullDisk => "full disk",
            FaultKind::Kill => "kill",
            FaultKind::Cancel => "cancel",
            FaultKind::EmergencyStop => "emergency stop",
            FaultKind::NoReports => "no reports",
            FaultKind::Released => "released",
            FaultKind::Unplugged => "unplugged",
        }
    }
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// Number of calls hit by each kind of fault.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FaultCounts([u64; FaultKind::ALL.len()]);

impl FaultCounts {
    /// Number of calls hit by `kind`.
    pub fn of(&self, kind: FaultKind) -> u64 {
        self.0[kind as usize]
    }

    /// Adds the counts of another run.
    pub fn add(&mut self, other: &FaultCounts) {
        for (count, more) in self.0.iter_mut().zip(other.0) {
            *count += more;
        }
    }

    fn count(&mut self, kind: FaultKind) {
        self.0[kind as usize] += 1;
    }
}

/// A fault of a scenario.
#[derive(Clone, Copy, Debug)]
struct Fault {
    kind: FaultKind,
    from_s: f64,
    until_s: f64,
}

/// Index that separates the random draws for the emergency stop from all others.
const STOP: u64 = 90;
/// Index that separates the random draws for missing reports from all others.
const NO_REPORTS: u64 = 91;
/// Index that separates the random draws for the enabling switch from all others.
const SWITCH: u64 = 92;

/// Faults of a scenario.
#[derive(Clone, Debug)]
pub(super) struct Faults {
    faults: Vec<Fault>,
    struck: FaultCounts,
}

impl Faults {
    /// Draws one to four faults that begin in the first `span_s`, s; one seed in eight has none. Separately, one seed in eight has an emergency stop,
    /// and one in four lacks reports for a time. The enabling switch is released in every second seed and unplugged in one of four.
    pub(super) fn draw(draws: Draws, span_s: f64) -> Faults {
        let whole = |least, greatest, place| draws.between(least, greatest, place);
        let count = if whole(0, 7, [0, 0]) == 0 {
            0
        } else {
            whole(1, 4, [0, 1])
        };
        let faults = (1..=count).map(|number| {
            let kind = whole(0, FaultKind::DRAWN - 1, [number, 0]);
            let kind = FaultKind::ALL[usize::try_from(kind).unwrap_or(0)];
            let part = |place| draws.fraction([number, place]);
            let from_s = part(1) * span_s;
            // From a glitch of one reading to two seconds, with short and long ones equally likely.
            let rarely_s = match kind {
                // Frames are rare: a shorter fault between two of them has no effect.
                FaultKind::DroppedFrames => 2.0,
                _ => 0.0,
            };
            let until_s = from_s + rarely_s + 0.005 * 400_f64.powf(part(2));
            Fault {
                kind,
                from_s,
                until_s,
            }
        });
        let stop = (whole(0, 7, [STOP, 0]) == 0).then(|| Fault {
            kind: FaultKind::EmergencyStop,
            from_s: draws.fraction([STOP, 1]) * span_s,
            until_s: f64::INFINITY,
        });
        let unreported = (whole(0, 3, [NO_REPORTS, 0]) == 0).then(|| {
            let from_s = draws.fraction([NO_REPORTS, 1]) * span_s;
            Fault {
                kind: FaultKind::NoReports,
                from_s,
                until_s: from_s + 0.02 * 100_f64.powf(draws.fraction([NO_REPORTS, 2])),
            }
        });
        Faults {
            faults: faults
                .chain(stop)
                .chain(unreported)
                .chain(of_switch(draws, span_s))
                .collect(),
            struck: FaultCounts::default(),
        }
    }

    /// Fault because of which no person holds the enabling switch at `now_s`, and the time at which the fault began, s. `None` if the switch is held.
    pub(super) fn unheld(&self, now_s: f64) -> Option<(FaultKind, f64)> {
        let kinds = [FaultKind::Unplugged, FaultKind::Released];
        let of_kind = |kind| {
            let is_on = move |fault: &&Fault| {
                fault.kind == kind && (fault.from_s..fault.until_s).contains(&now_s)
            };
            let first = self.faults.iter().filter(is_on).map(|fault| fault.from_s);
            first.reduce(f64::min).map(|from_s| (kind, from_s))
        };
        kinds.into_iter().find_map(of_kind)
    }

    /// Faults of a scenario without any fault.
    #[cfg(test)]
    pub(super) fn none() -> Faults {
        Faults {
            faults: Vec::new(),
            struck: FaultCounts::default(),
        }
    }

    /// A fault of `kind` from `from_s` on, without end.
    #[cfg(test)]
    pub(super) fn from(kind: FaultKind, from_s: f64) -> Faults {
        let until_s = f64::INFINITY;
        Faults {
            faults: vec![Fault {
                kind,
                from_s,
                until_s,
            }],
            ..Faults::none()
        }
    }

    /// A fault of `kind` from `from_s` until `until_s`.
    #[cfg(test)]
    pub(super) fn between(kind: FaultKind, from_s: f64, until_s: f64) -> Faults {
        let mut faults = Faults::from(kind, from_s);
        faults.faults[0].until_s = until_s;
        faults
    }

    /// A fault of `kind` for `lasting_s` every `period_s`, two hundred times.
    #[cfg(test)]
    pub(super) fn every(kind: FaultKind, period_s: f64, lasting_s: f64) -> Faults {
        let one = |number: u32| {
            let from_s = f64::from(number) * period_s;
            Faults::between(kind, from_s, from_s + lasting_s).faults
        };
        Faults {
            faults: (1..=200).flat_map(one).collect(),
            ..Faults::none()
        }
    }

    /// A fault of `kind` during the whole run.
    #[cfg(test)]
    pub(super) fn always(kind: FaultKind) -> Faults {
        Faults::from(kind, f64::NEG_INFINITY)
    }

    /// True if a fault of `kind` affects a call at `now_s`. Counts the call.
    pub(super) fn strike(&mut self, kind: FaultKind, now_s: f64) -> bool {
        let active =
            |fault: &Fault| fault.kind == kind && (fault.from_s..fault.until_s).contains(&now_s);
        let strikes = self.faults.iter().any(active);
        if strikes {
            self.struck.count(kind);
        }
        strikes
    }

    /// True if a one-time fault of `kind` is due at `now_s`. The fault does not occur again.
    pub(super) fn strike_once(&mut self, kind: FaultKind, now_s: f64) -> bool {
        let due = |fault: &Fault| fault.kind == kind && fault.from_s <= now_s;
        let place = self.faults.iter().position(due);
        if let Some(place) = place {
            self.faults.remove(place);
            self.struck.count(kind);
        }
        place.is_some()
    }

    pub(super) fn struck(&self) -> FaultCounts {
        self.struck
    }
}

/// Draws faults of the enabling switch. Each release lasts from 0.01 s to 40 s, with a uniform logarithm. The switch may also be unplugged once.
fn of_switch(draws: Draws, span_s: f64) -> impl Iterator<Item = Fault> {
    let releases = match draws.between(0, 1, [SWITCH, 0]) {
        0 => 0,
        _ => draws.between(1, 6, [SWITCH, 1]),
    };
    let is_unplugged = draws.between(0, 3, [SWITCH, 2]) == 0;
    let one = move |kind, place: u64, shortest_s: f64, times: f64| {
        let from_s = draws.fraction([SWITCH, place]) * span_s;
        let lasts_s = shortest_s * times.powf(draws.fraction([SWITCH, place + 1]));
        Fault {
            kind,
            from_s,
            until_s: from_s + lasts_s,
        }
    };
    let released =
        (0..releases).map(move |number| one(FaultKind::Released, 10 + 2 * number, 0.01, 4_000.0));
    let unplugged = is_unplugged.then(|| one(FaultKind::Unplugged, 4, 0.5, 40.0));
    released.chain(unplugged)
}
