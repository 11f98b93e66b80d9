//! `rig tap`: taps the gel at one place, and determines the latency of each device for the rig file.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use taceva_core::Descriptor;
use taceva_protocol::{Latency, RigFile, RigLatencies, SceneProblem};

use crate::error::AcquireError;
use crate::presses::{TappedRig, Workshop, tap_study, written_latencies_ms};
use crate::scene::{Overrides, PlannedScene, SceneText, StudySource};

/// Scene that plans the taps, with limits, speeds and the tests before the first tap. The gel is tapped in the middle.
const SCENE: &str = r#"
scene_version = 1
name = "tap"
[sensor]
footprint = { shape = "disc", radius_mm = 1.0 }
[model]
name = "ridge"
[metrics]
want = ["accuracy"]
[protocol.contact]
speed_mm_s = 4.5
clearance_mm = 1.0
[protocol.calibration]
points = 1
indentations = 1
"#;

/// Result of tapping on a rig.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct RigTap {
    /// True if the devices are emulated, as the rig file or the robot states.
    pub simulated: bool,
    /// Number of taps used for the latencies. The readings of every device show when contact began and ended.
    pub taps: usize,
    /// Reason for each other tap: a device does not show clearly when contact began or ended. At most a quarter of all taps are dropped.
    pub dropped: Vec<String>,
    /// Number of dropped taps in which a signal still changed long after the tip rested. At most a fifth of all taps are dropped as late.
    pub late: usize,
    /// Previous latencies of robot, transducer and sensor, in ms, from the rig file, or otherwise from the drivers.
    pub before_ms: [f64; 3],
    /// Delay of the transducer relative to the robot that the previous latencies do not correct.
    pub force: Latency,
    /// Delay of the sensor relative to the robot that the previous latencies do not correct.
    pub sensor: Latency,
    /// Latencies to store in the rig file.
    pub latencies: RigLatencies,
    /// Settings of the sensor that were measured during the taps: the drift of its clock, and the standard uncertainty of this drift.
    pub settings: BTreeMap<String, String>,
    /// Text of the rig file with these latencies; `None` if the user must edit the file.
    #[serde(skip)]
    pub text: Option<String>,
}

/// Taps the gel on the rig of the file at `path`. The file is not written.
///
/// # Errors
/// [`AcquireError::Scene`] with the line of the rig file if it lacks a robot, a transducer, a sensor or limits. [`AcquireError::Open`] and
/// [`AcquireError::Acquisition`] if a device fails or the rig contradicts its file. [`AcquireError::Taps`] if the taps do not determine the latency.
pub fn tap_rig(path: &Path, workshop: Workshop<'_>) -> Result<RigTap, AcquireError> {
    let rig = super::read_rig(path)?;
    check_devices(&rig)?;
    let text = SceneText {
        name: format!("taceva rig tap {}", path.display()),
        text: SCENE.to_owned(),
        folder: PathBuf::from("."),
    };
    let instead = Overrides {
        rig: Some(path.to_owned()),
        ..Overrides::default()
    };
    let planned = PlannedScene::with(text, workshop.drivers, &instead)?;
    let study = planned.studies.first();
    let study = study.expect("the scene has a study");
    let StudySource::Rig(spec) = &study.source else {
        return Err(AcquireError::Request(
            "taps need a rig, not a recording".to_owned(),
        ));
    };
    let info = spec
        .info(&study.study, workshop.drivers)
        .map_err(|(at, problem)| AcquireError::from(rig.error(at, problem)))?;
    let stated = |device: &Option<Descriptor>, of: fn(&Descriptor) -> Option<f64>| {
        device.as_ref().and_then(of)
    };
    let stated = [
        stated(&info.robot, |robot| robot.robot()?.latency_ms),
        stated(&info.force, |force| force.force()?.latency_ms),
        stated(&info.sensor, |sensor| sensor.sensor()?.latency_ms),
    ];
    let written = written_latencies_ms(&rig);
    let before_ms = [0, 1, 2].map(|device: usize| {
        let latency = written[device].or(stated[device]);
        latency.unwrap_or(0.0)
    });
    let TappedRig {
        tapped,
        is_emulated,
        measured,
    } = tap_study(study, workshop)?;
    let (force, sensor) = tapped.latencies().map_err(|source| AcquireError::Taps {
        rig: rig.name().to_owned(),
        source,
    })?;
    let dropped: Vec<String> = tapped.dropped().iter().map(ToString::to_string).collect();
    let latencies = RigLatencies::measured(before_ms, &force, &sensor);
    Ok(RigTap {
        simulated: rig.simulated || is_emulated,
        taps: tapped.count() - dropped.len(),
        dropped,
        late: tapped.late(),
        before_ms,
        force,
        sensor,
        latencies,
        settings: measured,
        text: rig.with_latencies(&latencies),
    })
}

/// Rejects a rig that lacks a robot, a transducer or a sensor.
fn check_devices(rig: &RigFile) -> Result<(), AcquireError> {
    for (key, is_there) in [
        ("robot", rig.robot.is_some()),
        ("force", rig.force.is_some()),
        ("sensor", rig.sensor.is_some()),
    ] {
        if !is_there {
            let missing = SceneProblem::MissingKey(key.to_owned());
            return Err(AcquireError::from(rig.error(None, missing)));
        }
    }
    Ok(())
}
