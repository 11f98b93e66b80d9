//! Rehearsal of a scene. The tip visits every place above the gel, while guard threads watch. Nothing is pressed or recorded.

use taceva_core::{Frame, Millimetre, SinkError};
use taceva_protocol::{Cancel, ContentId, Event, Mode, PressLog, PressRecord, RunError, RunSpec};

use super::devices::{OpenRig, Sitting};
use super::operator::{stopped, unit_is_there};
use super::workshop::Workshop;
use crate::error::AcquireError;
use crate::scene::{PlannedScene, StudySource};

/// Height of a rehearsal above the travel height, in mm. The tip does not touch the gel if the rig file's origin is wrong by less than this height.
pub const AIR_MM: f64 = 10.0;

/// Visits every place of `scene` at [`AIR_MM`] above the travel height. Returns the number of places.
///
/// # Errors
/// [`AcquireError::Open`] and [`AcquireError::Acquisition`] if a device fails, the tip touches something, or the run is cancelled.
pub fn rehearse_scene(scene: &PlannedScene, workshop: Workshop<'_>) -> Result<usize, AcquireError> {
    if workshop.operator.is_none() {
        scene.check_unattended(workshop.drivers)?;
    }
    let presses: usize = scene
        .studies
        .iter()
        .flat_map(|study| &study.plan.presses)
        .filter(|press| press.press.load().is_none() || press.press.repeat == Some(0))
        .count();
    workshop.progress.begin("place", Some(presses as u64));
    let cancel = Cancel::new();
    let mut visited = 0;
    for study in &scene.studies {
        let StudySource::Rig(rig) = &study.source else {
            continue;
        };
        let mut sitting = Sitting::new(workshop, &cancel);
        for unit in &study.plan.units {
            if !unit_is_there(study, rig, unit, &mut sitting)? {
                continue;
            }
            let mut open = OpenRig::open(study, rig, unit, sitting)?;
            let spec = RunSpec {
                plan: &study.plan,
                unit,
                mode: Mode::Rehearse {
                    height: Millimetre(AIR_MM),
                },
            };
            let mut events = |event: &Event| {
                if let Event::Rehearsed(_) = event {
                    workshop.progress.advance(1);
                }
                if workshop.progress.is_cancelled() {
                    cancel.cancel();
                }
            };
            let done = open.conduct(&spec, &mut Unwritten, sitting, &mut events);
            let report = done.map_err(|error| {
                // Nothing was pressed, so nothing is repeated.
                let error = RunError {
                    press: None,
                    ..error
                };
                stopped(&study.plan, error)
            })?;
            sitting.is_enabled = true;
            visited += report.made;
        }
    }
    workshop.progress.end();
    Ok(visited)
}

/// Press log that is always empty.
struct Unwritten;

impl PressLog for Unwritten {
    fn is_finished(&self, _: ContentId) -> bool {
        false
    }

    fn append(&mut self, _: &PressRecord) -> Result<(), SinkError> {
        Err("nothing is pressed in the air".into())
    }

    fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
        Ok(())
    }
}
