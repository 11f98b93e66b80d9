//! Simulated rig on which a test runs a plan, with a log in memory.

use std::ops::Range;

use taceva_core::{Deadline, DriverError, Frame, FrameInfo, FrameMut, Sensor, SinkError, Stamp};

use crate::simulation::devices::{SimulatedForce, SimulatedRobot, SimulatedSensor};
use crate::simulation::draws::Draws;
use crate::simulation::fault::Faults;
use crate::simulation::gel::Gel;
use crate::simulation::oracle::{Oracle, Stated};
use crate::simulation::scenario::scenario_plan;
use crate::simulation::world_handle::Shared;
use taceva_protocol::ContentId;
use taceva_protocol::Plan;
use taceva_protocol::{
    Cancel, Controls, Devices, Event, Mode, Operator, PressLog, PressRecord, RunError, RunReport,
    RunSpec, run,
};

pub(super) const SOFT: Gel = Gel {
    stiffness_n_mm: 0.5,
    noise_n: 0.003,
    zero_noise_n: 0.0,
    saturation_n: 20.0,
    normal_max_n: 1.5,
    pose_noise_mm: 0.0,
    slope: 0.0,
};

/// Gel that is so hard that every press ends at the force limit.
pub(super) const HARD: Gel = Gel {
    stiffness_n_mm: 5.0,
    ..SOFT
};

#[derive(Default)]
pub(super) struct Memory {
    pub(super) untouched: Vec<Frame>,
    pub(super) records: Vec<PressRecord>,
    pub(super) full_after: Option<usize>,
}

impl PressLog for Memory {
    fn is_finished(&self, press: ContentId) -> bool {
        self.records.iter().any(|record| record.press == press)
    }
    fn append(&mut self, record: &PressRecord) -> Result<(), SinkError> {
        if self
            .full_after
            .is_some_and(|most| self.records.len() >= most)
        {
            return Err("no space left".into());
        }
        self.records.push(record.clone());
        Ok(())
    }
    fn untouched(&mut self, frame: &Frame) -> Result<(), SinkError> {
        self.untouched.push(frame.clone());
        Ok(())
    }
}

pub(super) struct Bench {
    pub(super) shared: Shared,
    pub(super) plan: Plan,
    pub(super) cancel: Cancel,
    pub(super) events: Vec<Event>,
    /// Captures in which the camera repeats its last frame, numbered from the start of a run.
    pub(super) frozen: Range<u32>,
    /// Person who answers questions.
    pub(super) operator: Option<Box<dyn Operator>>,
}

impl Bench {
    pub(super) fn new(gel: Gel) -> Bench {
        Bench::with(gel, scenario_plan(1, &gel).expect("a plan"))
    }

    /// A rig with this gel, and a plan for it.
    pub(super) fn with(gel: Gel, plan: Plan) -> Bench {
        let limits = plan.limits.as_ref().expect("limits");
        let stated = Stated::new(limits, gel.stiffness_n_mm, gel.noise_n, 0.1, 0.02)
            .at_speed(plan.contact.speed_mm_s.value, limits.overshoot.segment_mm);
        let faultless = Faults::none();
        Bench {
            shared: Shared::new(gel, Oracle::new(stated), faultless, Draws::new(1, "test")),
            plan,
            cancel: Cancel::new(),
            events: Vec::new(),
            frozen: 0..0,
            operator: None,
        }
    }

    pub(super) fn run(&mut self, mode: Mode, log: &mut Memory) -> Result<RunReport, RunError> {
        let unit = self.plan.units[0].clone();
        self.run_unit(&unit, mode, log)
    }

    pub(super) fn run_unit(
        &mut self,
        unit: &str,
        mode: Mode,
        log: &mut Memory,
    ) -> Result<RunReport, RunError> {
        let (mut robot, mut force, mut sensor) = (
            SimulatedRobot(self.shared.clone()),
            SimulatedForce::new(self.shared.clone()),
            Freezing {
                inner: SimulatedSensor(self.shared.clone()),
                frozen: self.frozen.clone(),
                captures: 0,
                last: Vec::new(),
            },
        );
        let mut clock = self.shared.clone();
        let (events, cancel) = (&mut self.events, &self.cancel);
        let spec = RunSpec {
            plan: &self.plan,
            unit,
            mode,
        };
        let devices = Devices {
            robot: &mut robot,
            force: &mut force,
            sensor: Some(&mut sensor),
            lighting: None,
            specimens: None,
        };
        let mut note = |event: &Event| events.push(event.clone());
        let controls = Controls {
            clock: &mut clock,
            cancel,
            events: &mut note,
            operator: match &mut self.operator {
                Some(operator) => Some(&mut **operator),
                None => None,
            },
        };
        run(&spec, devices, log, controls)
    }

    pub(super) fn height(&self) -> f64 {
        self.shared.world().tip[2]
    }
}

/// Camera that repeats its last frame during some captures.
struct Freezing {
    inner: SimulatedSensor,
    frozen: Range<u32>,
    captures: u32,
    last: Vec<u8>,
}

impl Sensor for Freezing {
    fn frame_info(&self) -> FrameInfo {
        self.inner.frame_info()
    }

    fn capture(
        &mut self,
        mut into: FrameMut<'_>,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let info = into.info();
        let again = FrameMut::new(info, into.bytes_mut()).expect("its size");
        let stamp = self.inner.capture(again, deadline)?;
        self.captures += 1;
        if self.frozen.contains(&self.captures) {
            into.bytes_mut().copy_from_slice(&self.last);
        } else {
            self.last = into.bytes_mut().to_vec();
        }
        Ok(stamp)
    }
}
