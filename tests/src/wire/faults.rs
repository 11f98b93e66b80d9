//! Outcomes of a study on emulated devices under repeated faults.

use std::collections::BTreeSet;
use std::time::Duration;

use taceva_dataset::Dataset;
use taceva_wire::{ArmFault, BenchOptions, Device, Fault, FaultKind, ServeOptions};

use super::{HaltTimes, LateCounts, OnTheWire, RUN, UnderWay, scene_of};
use crate::random::Random;

/// Fault to inject in a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wrong {
    /// Fault of a link, for a duration.
    Link(Device, FaultKind, Duration),
    /// Fault of the robot, until a person clears it.
    Arm(ArmFault),
}

/// Required outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// No effect: the study continues.
    Unharmed,
    /// The robot is stopped within this time, ms, and the study continues by itself.
    Stopped(u64),
    /// The study may end and can be resumed. If a time in ms is given, the robot is stopped within this time.
    MayEnd(Option<u64>),
    /// The study ends, and the robot does not move any more.
    Left,
}

/// A fault to inject, with the required outcome.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name of the case.
    pub name: &'static str,
    /// Fault to inject.
    pub wrong: Wrong,
    /// Required outcome.
    pub outcome: Outcome,
}

/// Age from which a reading is stale, ms.
const STALE_MS: u64 = 50;
/// Extra time that the machine and the robot may take, ms.
const SLACK_MS: u64 = 25;
/// Time of motion from a frozen force signal until the robot stands, ms. Detection takes eight readings, each at a new pose, and the robot reports
/// 100 poses per second.
const FROZEN_MS: u64 = 100;

const fn link(device: Device, kind: FaultKind, lasts_ms: u64) -> Wrong {
    Wrong::Link(device, kind, Duration::from_millis(lasts_ms))
}

const fn case(name: &'static str, wrong: Wrong, outcome: Outcome) -> Case {
    Case {
        name,
        wrong,
        outcome,
    }
}

/// All cases.
pub const CASES: [Case; 24] = {
    use Device::{Camera, Force, Robot};
    use FaultKind::{
        Drop, Foreign, Frozen, Gap, Hostile, Late, Merged, NotANumber, Saturated, Silent, Split,
    };
    use Outcome::{Left, MayEnd, Stopped, Unharmed};
    const SILENCE: Outcome = Stopped(STALE_MS + SLACK_MS);
    const BROKEN: Outcome = MayEnd(Some(STALE_MS + SLACK_MS));
    [
        case("force drop", link(Force, Drop, 30), Unharmed),
        case("force late", link(Force, Late, 150), SILENCE),
        case("force silent", link(Force, Silent, 150), SILENCE),
        case(
            "force frozen",
            link(Force, Frozen, 400),
            MayEnd(Some(FROZEN_MS)),
        ),
        case("force nan", link(Force, NotANumber, 150), BROKEN),
        case("force saturated", link(Force, Saturated, 150), BROKEN),
        case("force gap", link(Force, Gap, 150), Unharmed),
        case("force split", link(Force, Split, 150), Unharmed),
        case("force merged", link(Force, Merged, 150), Unharmed),
        case("force foreign", link(Force, Foreign, 150), MayEnd(None)),
        case("force hostile", link(Force, Hostile, 150), MayEnd(None)),
        case("robot drop", link(Robot, Drop, 30), Unharmed),
        case("robot late", link(Robot, Late, 150), SILENCE),
        case("robot silent", link(Robot, Silent, 150), SILENCE),
        case("robot nan", link(Robot, NotANumber, 150), BROKEN),
        case("robot split", link(Robot, Split, 150), Unharmed),
        case("robot merged", link(Robot, Merged, 150), Unharmed),
        case("robot foreign", link(Robot, Foreign, 150), MayEnd(None)),
        case("robot hostile", link(Robot, Hostile, 150), MayEnd(None)),
        case("camera drop", link(Camera, Drop, 150), Unharmed),
        case("camera late", link(Camera, Late, 150), Unharmed),
        case("camera hostile", link(Camera, Hostile, 150), MayEnd(None)),
        case("emergency stop", Wrong::Arm(ArmFault::EmergencyStop), Left),
        case("collision", Wrong::Arm(ArmFault::Collision), Left),
    ]
};

/// Result of a repeated fault.
#[derive(Clone, Debug, Default)]
pub struct Played {
    /// Number of repetitions.
    pub times: usize,
    /// Time for which the robot moved during each fault, ms, ascending.
    pub stopped_ms: Vec<f64>,
    /// Number of studies started.
    pub studies: usize,
    /// Number of studies that ended early and were resumed.
    pub ended: usize,
    /// Late turns of the guard and stale readings, as the studies counted them.
    pub late: LateCounts,
    /// Halts of motions, as the studies counted them.
    pub halts: HaltTimes,
    /// Greatest one-minute load average at the start or end of a study; `None` if the system does not state it.
    pub load: Option<f64>,
    /// Descriptions of forbidden outcomes.
    pub broken: Vec<String>,
}

impl Played {
    /// Greatest time for which the robot moved during a fault, ms; 0 without faults.
    pub fn most_ms(&self) -> f64 {
        self.stopped_ms.last().copied().unwrap_or_default()
    }

    /// Median time for which the robot moved during a fault, ms; 0 without faults.
    pub fn median_ms(&self) -> f64 {
        let middle = self.stopped_ms.len() / 2;
        self.stopped_ms.get(middle).copied().unwrap_or_default()
    }

    /// 99.9 % quantile of the times for which the robot moved during a fault, ms. Of fewer than 1000 times, it is the greatest; 0 without faults.
    pub fn most_but_one_in_1000_ms(&self) -> f64 {
        let over = self.stopped_ms.len() / 1000;
        let quantile = self.stopped_ms.iter().rev().nth(over);
        quantile.copied().unwrap_or_default()
    }

    /// Updates the greatest load average with the present one.
    fn look_at_load(&mut self) {
        let text = std::fs::read_to_string("/proc/loadavg").unwrap_or_default();
        let minute = text.split(' ').next();
        let load: Option<f64> = minute.and_then(|minute| minute.parse().ok());
        self.load = self.load.into_iter().chain(load).reduce(f64::max);
    }

    /// Checks that at most one halt in 1000 was late. Does nothing for faults of the robot's link, because they delay the answer to a halt.
    fn check_halts(&mut self, case: &Case) {
        let late = self.halts.late.total();
        let is_robots = matches!(case.wrong, Wrong::Link(Device::Robot, ..));
        if !is_robots && late > self.halts.halts / 1000 {
            self.broken.push(format!(
                "{}: {late} of {} halts late, driver calls within {:.1} ms, at rest within {:.1} ms",
                case.name, self.halts.halts, self.halts.call_ms, self.halts.rest_ms
            ));
        }
    }
}

/// Number of presses for a study with `times` faults; a few faults need only a short study.
fn presses_of(times: usize) -> usize {
    times.clamp(3, 12)
}

/// Number of early ends of a study beyond the number of faults, from which the study makes no progress.
const MOST_ENDS: usize = 60;
/// Observation time of an arm that must not move.
const LOOKED_AT: Duration = Duration::from_millis(300);

/// Scene with presses in quick succession, so that many faults fit into little time.
fn scene(presses: usize) -> String {
    let text = scene_of(presses);
    // At a higher speed a busy machine would be rejected for reacting too late.
    let quick = "speed_mm_s = 2.0\nclearance_mm = 0.6\nsettle_s = 0.02\n";
    let changed = text.replace("speed_mm_s = 2.0\n", quick);
    assert!(changed != text, "the scene has a speed");
    changed
}

/// Injects the fault of `case` as often as `times` states, at moments drawn from `seed`.
///
/// # Panics
/// If the devices or the program cannot be started, which ends the test.
pub fn play(case: &Case, times: usize, seed: u64) -> Played {
    let mut result = Played::default();
    let mut random = Random::new(seed);
    while result.times < times && result.broken.is_empty() {
        let options = ServeOptions::over(BenchOptions::quiet(seed + result.studies as u64));
        let on = OnTheWire::new(&options, &scene(presses_of(times)));
        result.studies += 1;
        result.play_study(case, times, &on, &mut random);
    }
    result.stopped_ms.sort_by(f64::total_cmp);
    result.check_halts(case);
    result
}

impl Played {
    /// Injects faults during one study and its resumptions, until the study has every press or the robot must not move any more.
    fn play_study(&mut self, case: &Case, times: usize, on: &OnTheWire, random: &mut Random) {
        let mut ends = 0;
        loop {
            let begun = sessions(on);
            self.look_at_load();
            let mut study = UnderWay::begin(on.study());
            let mut is_left = false;
            while study.ended().is_none() {
                // A fault during the start of a session ends it before the first press.
                if sessions(on) == begun {
                    std::thread::sleep(Duration::from_millis(5));
                    continue;
                }
                // A press that is interrupted three times ends the study, so two faults are more than a press apart.
                let pause = match case.outcome {
                    Outcome::Unharmed => Duration::from_millis(200),
                    Outcome::Stopped(_) => Duration::from_millis(8_000),
                    _ => Duration::from_millis(2_500),
                };
                let pause = pause + Duration::from_millis(random.below(500) as u64);
                if self.times >= times || is_left || !wait_for_motion(on, &mut study, pause) {
                    std::thread::sleep(Duration::from_millis(5));
                    continue;
                }
                is_left = self.strike(case, on);
            }
            let (is_well, said) = study.end();
            self.late.add(&said);
            self.halts.add(&said);
            self.look_at_load();
            if !self.broken.is_empty() {
                // Lines about misses state if the kernel, the program or a device was late.
                self.broken
                    .extend(LateCounts::lines(&said).map(str::to_owned));
            }
            if is_left {
                self.is_still(on, is_well);
                return;
            }
            if is_well {
                self.broken
                    .extend(lacks(&on.recording(RUN), presses_of(times)));
                return;
            }
            ends += 1;
            self.ended += 1;
            if !matches!(case.outcome, Outcome::MayEnd(_)) || ends == times + MOST_ENDS {
                self.broken.push(format!("{}: {said}", case.name));
                return;
            }
        }
    }

    /// Injects the fault, and measures for how long the robot moves while the fault lasts. Returns true if nothing may move from now on.
    fn strike(&mut self, case: &Case, on: &OnTheWire) -> bool {
        let bench = on.served.bench();
        self.times += 1;
        let (device, kind, lasts) = match case.wrong {
            Wrong::Link(device, kind, lasts) => (device, kind, lasts),
            Wrong::Arm(fault) => {
                on.served.arm().suffer(fault);
                return true;
            }
        };
        let before = bench.truth();
        bench.inject(Fault {
            device,
            kind,
            lasts,
        });
        std::thread::sleep(lasts);
        let after = bench.truth();
        let most_ms = match case.outcome {
            Outcome::Stopped(most_ms) | Outcome::MayEnd(Some(most_ms)) => most_ms,
            _ => return false,
        };
        let stopped_ms = (after.in_motion - before.in_motion).as_secs_f64() * 1e3;
        self.stopped_ms.push(stopped_ms);
        if stopped_ms > most_ms as f64 {
            self.broken.push(format!(
                "{}: in motion for {stopped_ms:.1} ms, expected at most {most_ms} ms",
                case.name
            ));
        }
        false
    }

    /// Checks that the robot does not move, neither while the study ends nor when it is resumed.
    fn is_still(&mut self, on: &OnTheWire, is_well: bool) {
        let bench = on.served.bench();
        if is_well {
            self.broken.push("a study that continued".to_owned());
        }
        let stood = bench.truth().way_mm;
        let (is_well, _) = UnderWay::begin(on.study()).end();
        std::thread::sleep(LOOKED_AT);
        let way_mm = bench.truth().way_mm - stood;
        if is_well || way_mm > 0.0 {
            self.broken
                .push(format!("it moved by {way_mm} mm after a fault of the arm"));
        }
    }
}

/// Kills a study repeatedly, as `kill -9` does, each time after a delay drawn from `seed`, and resumes it. Returns the number of recorded
/// presses.
///
/// # Errors
/// Missing or duplicate presses of the recording, or the output of the last study.
///
/// # Panics
/// If the devices or the program cannot be started, which ends the test.
pub fn play_kills(times: usize, seed: u64) -> Result<usize, String> {
    let mut random = Random::new(seed);
    let options = ServeOptions::over(BenchOptions::quiet(seed));
    let presses = presses_of(times);
    let on = OnTheWire::new(&options, &scene(presses));
    let mut kills = 0;
    while kills < times {
        let mut study = UnderWay::begin(on.study());
        std::thread::sleep(Duration::from_millis(300 + random.below(30_000) as u64));
        if study.ended() == Some(true) {
            // The study was faster than the kill: check its recording and restart.
            lacks(&on.recording(RUN), presses).map_or(Ok(()), Err)?;
            let folder = on.folder().join(RUN);
            std::fs::remove_dir_all(folder).map_err(|error| error.to_string())?;
            continue;
        }
        study.kill();
        kills += 1;
    }
    let (is_well, said) = UnderWay::begin(on.study()).end();
    match (
        is_well,
        is_well
            .then(|| lacks(&on.recording(RUN), presses))
            .flatten(),
    ) {
        (false, _) => Err(said),
        (true, Some(lack)) => Err(lack),
        (true, None) => Ok(presses),
    }
}

/// Number of sessions in the recording.
fn sessions(on: &OnTheWire) -> usize {
    let path = on.folder().join(RUN).join("recordings/1-wire.sessions.csv");
    std::fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

/// Waits for `pause`, then until the tip moves; `false` if the study ended first.
fn wait_for_motion(on: &OnTheWire, study: &mut UnderWay, pause: Duration) -> bool {
    std::thread::sleep(pause);
    while !on.served.bench().truth().is_moving {
        if study.ended().is_some() {
            return false;
        }
        std::thread::sleep(Duration::from_micros(500));
    }
    study.ended().is_none()
}

/// Description of the presses that `recording` lacks or has twice, of `expected` presses; `None` if it has each once.
fn lacks(recording: &Dataset, expected: usize) -> Option<String> {
    let samples = recording.table().samples();
    let presses: BTreeSet<&str> = samples
        .iter()
        .filter_map(|sample| sample.split_once('/'))
        .map(|(press, _)| press)
        .collect();
    let different: BTreeSet<&String> = samples.iter().collect();
    let is_whole = presses.len() == expected && different.len() == samples.len();
    (!is_whole).then(|| {
        format!(
            "{} samples, {} of them different, of {} presses, expected {expected}",
            samples.len(),
            different.len(),
            presses.len()
        )
    })
}
