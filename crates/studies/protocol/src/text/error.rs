//! What is wrong with a scene, where, and what would have been accepted.

use std::fmt;

use taceva_core::FrameInfo;

use crate::frame_size::FrameSize;
use crate::reason::PlanReason;

/// A scene that is refused.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneError {
    /// The name of the scene's text, such as its file.
    pub source_name: String,
    /// The line, from 1, if one line is to blame.
    pub line: Option<u64>,
    /// What is wrong.
    pub problem: Box<SceneProblem>,
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.source_name)?;
        if let Some(line) = self.line {
            write!(f, ", line {line}")?;
        }
        write!(f, ": {}", self.problem)
    }
}

impl std::error::Error for SceneError {}

/// What is wrong with a scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneProblem {
    /// Not TOML, or a value of the wrong type.
    #[error("{0}")]
    Syntax(String),
    /// A text larger than any scene.
    #[error("the scene has {bytes} bytes, expected at most {greatest}")]
    Size {
        /// Its bytes.
        bytes: usize,
        /// The most that is read.
        greatest: usize,
    },
    /// A key that nothing reads.
    #[error("`{key}`: unknown key{}; known here: {known}", did_you_mean(.nearest))]
    UnknownKey {
        /// As written.
        key: String,
        /// The nearest known key.
        nearest: Option<String>,
        /// Every known key.
        known: String,
    },
    /// A key without which there is no scene.
    #[error("the key `{0}` is missing")]
    MissingKey(String),
    /// A scene for another program version.
    #[error("scene version {0} is not known here, expected 1")]
    Version(u32),
    /// A rig file for another program version.
    #[error("rig version {0} is not known here, expected 1")]
    RigVersion(u32),
    /// A name out of a closed list that is not in it.
    #[error("`{name}`: unknown {what}{}; known: {known}{}", did_you_mean(.nearest), found_where(.what, .name))]
    UnknownName {
        /// What it should name: `driver of a sensor`, `metric`, `report format`.
        what: &'static str,
        /// As written.
        name: String,
        /// The nearest known name.
        nearest: Option<String>,
        /// Every known name.
        known: String,
    },
    /// A name that is given twice.
    #[error("`{name}` is the name of two {what}", name = taceva_core::shown(name))]
    Twice {
        /// What kind of thing has the name, such as a unit.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// A count of zero, or beyond what a bench can do.
    #[error("`{key}` is {found}, expected a whole number from {least} to {greatest}")]
    Count {
        /// The key.
        key: &'static str,
        /// As written.
        found: u64,
        /// The least accepted.
        least: u64,
        /// The greatest accepted.
        greatest: u64,
    },
    /// A number outside what is possible.
    #[error("`{key}` is {found}, expected a number above {above} and up to {greatest}")]
    Range {
        /// The key.
        key: &'static str,
        /// As written.
        found: f64,
        /// What it must exceed.
        above: f64,
        /// The greatest accepted.
        greatest: f64,
    },
    /// A size of frames that is none.
    #[error(
        "`frames` is `{found}`, expected WIDTHxHEIGHT in pixels, each a whole number from 1 to {}, such as \"64x48\"",
        FrameSize::SIDE_MAX
    )]
    FrameSize {
        /// As written.
        found: String,
    },
    /// Frames that would have to be enlarged.
    #[error(
        "`frames` is `{found}`, but the frames of study `{study}` are {frame}: expected at most `{}x{}`, since frames are reduced and never enlarged",
        frame.width,
        frame.height
    )]
    FramesEnlarged {
        /// As written.
        found: FrameSize,
        /// The study.
        study: String,
        /// The frames that its sensor gives.
        frame: FrameInfo,
    },
    /// Frames with fewer pixels than a model looks at.
    #[error(
        "`frames` is `{found}`, but {who} looks at {least_width}×{least_height} cells of each: expected at least `{least_width}x{least_height}`"
    )]
    FramesTooSmall {
        /// As written.
        found: FrameSize,
        /// Which model.
        who: String,
        /// The cells of its grid along x.
        least_width: u32,
        /// The cells of its grid along y.
        least_height: u32,
    },
    /// A limit that would allow more than the device or the scene above allows.
    #[error("`{key}` is {found}, but {who} allows at most {limit}: limits may only be tightened")]
    LimitLoosened {
        /// The key.
        key: &'static str,
        /// As written.
        found: f64,
        /// Whose limit it is.
        who: String,
        /// The limit.
        limit: f64,
    },
    /// A depth or another length of a protocol beyond its limit.
    #[error("`{key}` is {found}, beyond the limit `{limit_key}` = {limit} ({who})")]
    BeyondLimit {
        /// The key.
        key: &'static str,
        /// As written.
        found: f64,
        /// The limit that it breaks.
        limit_key: &'static str,
        /// The value of that limit.
        limit: f64,
        /// Whose limit it is.
        who: String,
    },
    /// A limit without which no robot is moved.
    #[error("nobody declares `{key}`: write it under [limits], no robot is moved without it")]
    LimitAbsent {
        /// The limit.
        key: &'static str,
    },
    /// Boards that are not in the catalogue.
    #[error("gratings of {found} mm are not in the catalogue: {catalogue}")]
    Grating {
        /// As written.
        found: f64,
        /// What there is.
        catalogue: &'static str,
    },
    /// Devices that are stamped by different clocks.
    #[error(
        "`{simulated}` runs in the time of its simulated bench and `{real}` in that of the machine: one rig has one clock; choose both simulated or both real"
    )]
    MixedClocks {
        /// The simulated device.
        simulated: String,
        /// The real one.
        real: String,
    },
    /// A robot that is moved in its base frame, of which nobody says how it lies to the sensor's.
    #[error(
        "the robot `{robot}` moves in its base frame, and nothing says how that lies to the gel: write a rig file with `origin_mm` and `axes` under [robot] and name it by `rig = \"lab.toml\"` or --rig (docs/rig.md)"
    )]
    Unmapped {
        /// The robot.
        robot: String,
    },
    /// A rig file whose robot went down to the gel and touched nothing.
    #[error(
        "nothing was touched down to {search_mm} mm below the height that `origin_mm` says: mend `origin_mm` or `axes` of [robot], or see whether the force transducer feels a finger"
    )]
    NothingTouched {
        /// How far below it was searched, in mm.
        search_mm: f64,
    },
    /// A rig file whose axes are not those along which forces were felt.
    #[error("`axes` of [force]: {felt}{}", mended(.expected, *.may_be_robot))]
    AxesContradicted {
        /// What was pushed, and what was felt.
        felt: String,
        /// What would agree with it, where a turn does.
        expected: Option<String>,
        /// Whether the robot may as well have gone another way than it was sent.
        may_be_robot: bool,
    },
    /// A robot that rests too late after a limit was passed.
    #[error(
        "`{robot}` moves on for {stop_ms} ms after a halt, so that it rests {needed_ms:.0} ms after a limit was passed: expected at most {greatest_ms:.0} ms"
    )]
    SlowStop {
        /// The robot.
        robot: String,
        /// What it states, in ms.
        stop_ms: f64,
        /// With one reading and one message, in ms.
        needed_ms: f64,
        /// The most that is allowed, in ms.
        greatest_ms: f64,
    },
    /// A speed at which the tip goes too far in contact while its force grows stale.
    #[error(
        "`speed_mm_s` is {found}, but {who} may be silent for {stale_ms:.0} ms before it counts as gone: expected at most {greatest:.3}"
    )]
    Blind {
        /// As written, in mm/s.
        found: f64,
        /// Whose readings.
        who: String,
        /// Their greatest age, in ms.
        stale_ms: f64,
        /// The most that is allowed, in mm/s.
        greatest: f64,
    },
    /// A force transducer of which nobody could say that its signal froze.
    #[error(
        "{who} reads in steps of {resolution_n} N, its noise is {noise_n} N and it numbers no readings: a signal that is frozen could not be distinguished from one that rests; expected numbered readings, or steps below the noise"
    )]
    FrozenUnseen {
        /// Which.
        who: String,
        /// Its step, in N.
        resolution_n: f64,
        /// Its noise, in N.
        noise_n: f64,
    },
    /// Two statements that exclude each other.
    #[error("{0}")]
    Contradiction(String),
    /// A scene without something to measure.
    #[error("{0}")]
    Incomplete(String),
    /// A metric asked for by name that can be computed in no study of the scene.
    #[error("`{metric}` can never apply: {reason}", metric = taceva_core::shown(metric))]
    NeverApplies {
        /// The metric.
        metric: String,
        /// Why.
        reason: PlanReason,
    },
    /// More presses than are planned at most.
    #[error("the plan has {found} presses, expected at most {greatest}")]
    TooManyPresses {
        /// How many.
        found: u64,
        /// The most that is planned.
        greatest: u64,
    },
}

fn mended(expected: &Option<String>, may_be_robot: bool) -> String {
    let force = expected.as_ref().map_or_else(
        || "no turn by right angles explains that: see how the transducer is mounted".to_owned(),
        |expected| format!("write axes = {expected}"),
    );
    match may_be_robot {
        true => format!(
            "; if the tip moved as it was sent, {force}; if it went another way, mend `axes` of [robot]"
        ),
        false => format!("; {force}"),
    }
}

fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map_or_else(String::new, |nearest| {
        format!(", did you mean `{nearest}`?")
    })
}

/// Where a driver of a plugin, `ID/KEY` with dots in its id, would be found.
fn found_where(what: &str, name: &str) -> &'static str {
    let is_of_plugin = name.split_once('/').is_some_and(|(id, _)| id.contains('.'));
    if what.starts_with("driver of") && is_of_plugin {
        "; a plugin is found where `taceva plugin install` put it, or in the folder that `--plugin-dir` names"
    } else {
        ""
    }
}
