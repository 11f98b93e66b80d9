//! Tests of the use of light and transducer during a run.

use std::sync::{Arc, Mutex};

use taceva_core::{
    Axes, Deadline, DriverError, ForceTransducer, Frame, Lighting, Nanometre, SinkError, Specimen,
    Stamp, Wrench,
};

use super::rig::{Rig, nothing, plan};
use super::*;
use crate::content_id::ContentId;
use crate::press::Motion;

/// Names of the calls that the test devices received, in order.
type Asked = Arc<Mutex<Vec<String>>>;

fn note(asked: &Asked, what: &str) {
    asked.lock().expect("whole").push(what.to_owned());
}

struct Transducer(Rig, Asked);

impl ForceTransducer for Transducer {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }
    fn start(&mut self, _: Deadline) -> Result<(), DriverError> {
        note(&self.1, "start");
        Ok(())
    }
    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        self.0.read(deadline)
    }
    fn stop(&mut self) -> Result<(), DriverError> {
        note(&self.1, "stop");
        Ok(())
    }
}

struct Lamps(Asked);

impl Lighting for Lamps {
    fn scenes(&self) -> &[String] {
        &[]
    }
    fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
        note(&self.0, scene);
        Ok(())
    }
}

struct Nowhere;

impl PressLog for Nowhere {
    fn is_finished(&self, _: ContentId) -> bool {
        false
    }
    fn append(&mut self, _: &PressRecord) -> Result<(), SinkError> {
        Ok(())
    }
    fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
        Ok(())
    }
}

/// A plan of three presses of one sphere at one place. Each press rests above the gel, without frames, in one of `lights`.
fn at_rest(lights: [&str; 3]) -> Plan {
    let mut plan = plan();
    plan.presses.truncate(3);
    for (planned, light) in plan.presses.iter_mut().zip(lights) {
        planned.frames = false;
        planned.press.unit = "a".to_owned();
        planned.press.place = [Nanometre(0); 2];
        planned.press.specimen = Specimen::Sphere {
            radius: Nanometre(4_000_000),
        };
        planned.press.light = Some(light.to_owned());
        planned.press.motion = Motion::Rest { frames: 1 };
    }
    plan
}

#[test]
fn light_is_set_where_it_changes_and_the_transducer_is_stopped_at_the_end() {
    let plan = at_rest(["S1", "S1", "S2"]);
    let spec = RunSpec {
        plan: &plan,
        unit: "a",
        mode: Mode::Acquire,
    };
    let (asked, mut rig) = (Asked::default(), Rig::new(-3.0, nothing));
    let mut force = Transducer(rig.clone(), asked.clone());
    let (mut lamps, mut clock) = (Lamps(asked.clone()), rig.clone());
    let devices = Devices {
        robot: &mut rig,
        force: &mut force,
        sensor: None,
        lighting: Some(&mut lamps),
        specimens: None,
    };
    let controls = Controls {
        clock: &mut clock,
        cancel: &Cancel::new(),
        events: &mut |_| {},
        operator: None,
    };
    let report = run(&spec, devices, &mut Nowhere, controls).expect("nothing in the way");
    assert_eq!((report.made, report.samples), (3, 3));
    let asked = asked.lock().expect("whole");
    assert_eq!(*asked, ["start", "S1", "S2", "stop"]);
}

#[test]
fn a_press_before_which_a_thread_halted_for_silence_is_made_again_and_the_run_goes_on() {
    let plan = at_rest(["S1"; 3]);
    let spec = RunSpec {
        plan: &plan,
        unit: "a",
        mode: Mode::Acquire,
    };
    let (asked, mut rig) = (Asked::default(), Rig::new(-3.0, nothing));
    let (mut force, mut clock) = (rig.clone(), rig.clone());
    let limits = plan.limits.clone().expect("it moves");
    let supervisor = Supervisor::new(limits, Arc::new(rig.clone()));
    let supervisor = SharedSupervisor::new(supervisor);
    let mut lamps = Lamps(asked);
    let seen = rig.clone();
    let devices = Devices {
        robot: &mut rig,
        force: &mut force,
        sensor: None,
        lighting: Some(&mut lamps),
        specimens: None,
    };
    // Before the second press, the guard thread receives no readings for 60 ms.
    let mut halted = 0;
    let controls = Controls {
        clock: &mut clock,
        cancel: &Cancel::new(),
        events: &mut |event| {
            if matches!(event, Event::Approaching { number: 2, .. }) && halted == 0 {
                halted += 1;
                let late_s = seen.now_s() + 0.06;
                let heard = supervisor.lock().observe(&Observation::Silence, late_s);
                assert!(heard.is_err());
            }
        },
        operator: None,
    };
    let made = run_guarded(
        &spec,
        devices,
        &mut Nowhere,
        controls,
        Oversight::new(supervisor.clone()),
    );
    let report = made.expect("silence ends no run");
    assert_eq!((report.made, report.redone, halted), (3, 1, 1));
}
