//! A run of one press on the scripted rig, with its log in memory.

use taceva_core::{Frame, Nanometre, Phase, SinkError};

use super::rig::{Rig, plan};
use super::{
    Cancel, Controls, Devices, Event, ForceZero, Mode, PressLog, PressRecord, RunError, RunReport,
    RunSpec, run,
};
use crate::content_id::ContentId;
use crate::plan::{Plan, PlannedPress};
use crate::press::{Motion, Waypoint};

/// Press log in memory, with the changes of the force zero that exceeded the limit.
#[derive(Default)]
pub(super) struct Memory {
    pub(super) records: Vec<PressRecord>,
    pub(super) steps: Vec<ForceZero>,
}

impl PressLog for Memory {
    fn is_finished(&self, _: ContentId) -> bool {
        false
    }
    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError> {
        self.records.push(record.clone());
        Ok(())
    }
    fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
        Ok(())
    }
    fn zero_step(&mut self, _: ContentId, zero: &ForceZero) -> Result<(), SinkError> {
        self.steps.push(*zero);
        Ok(())
    }
}

/// Result of a run of one press.
pub(super) struct OnePress {
    pub(super) log: Memory,
    pub(super) events: Vec<Event>,
    pub(super) done: Result<RunReport, RunError>,
}

impl OnePress {
    /// Runs one press to `depth` in the middle of a gel, with a plan that `change` modifies. `force` gives the force in N by reading and height.
    pub(super) fn to(
        depth: Nanometre,
        force: impl FnMut(u32, f64) -> Option<f64> + Send + 'static,
        change: impl FnOnce(&mut Plan),
    ) -> OnePress {
        let mut rig = Rig::new(-3.0, force);
        let mut plan = plan();
        let is_indent = |press: &PlannedPress| matches!(press.press.motion, Motion::Indent(_));
        plan.presses.retain(is_indent);
        plan.presses.truncate(1);
        let planned = &mut plan.presses[0];
        planned.frames = false;
        planned.press.light = None;
        planned.press.place = [Nanometre(0); 2];
        planned.press.motion = Motion::Indent(vec![Waypoint {
            depth,
            shear: [Nanometre(0); 2],
            phase: Phase::Load,
        }]);
        change(&mut plan);
        let spec = RunSpec {
            plan: &plan,
            unit: &plan.presses[0].press.unit,
            mode: Mode::Acquire,
        };
        let (mut force, mut clock) = (rig.clone(), rig.clone());
        let devices = Devices {
            robot: &mut rig,
            force: &mut force,
            sensor: None,
            lighting: None,
            specimens: None,
        };
        let (mut log, mut events) = (Memory::default(), Vec::new());
        let controls = Controls {
            clock: &mut clock,
            cancel: &Cancel::new(),
            events: &mut |event| events.push(event.clone()),
            operator: None,
        };
        let done = run(&spec, devices, &mut log, controls);
        OnePress { log, events, done }
    }

    /// Number of recorded events for which `is_it` is true.
    pub(super) fn count(&self, is_it: impl Fn(&Event) -> bool) -> u32 {
        let counts = self.events.iter().map(|event| u32::from(is_it(event)));
        counts.sum()
    }
}
