//! Test bench: a gel with an arm, a transducer and a camera in simulated time, and a session on it. The bench can have faults.

use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, ForceTransducer, Frame, FrameInfo, FrameMut,
    Halt, Newton, PixelFormat, Pose, Robot, Sensor, SinkError, Speed, Stamp, Wrench,
};

use crate::content_id::ContentId;
use crate::plan::Plan;
use crate::press::Motion;
use crate::rig_file::{RigFile, SignedAxes};
use crate::run::rig::plan;
use crate::run::{
    Answer, Cancel, Controls, Devices, Mode, Observation, Operator, Oversight, PressLog,
    PressRecord, Question, ReferenceTouch, RunError, RunSpec, SessionRecord, SessionSpec,
    SharedSupervisor, Supervisor, Timekeeper, run_guarded,
};

/// True axes of the transducer, by its mounting.
pub(super) const MOUNTED: [&str; 3] = ["x", "-y", "-z"];
/// Height of the gel surface, in mm.
pub(super) const SURFACE_MM: f64 = 0.13;
/// Stiffness of the gel against pushes along x and y, and against a press, in N/mm.
const STIFFNESS_N_MM: [f64; 3] = [0.1, 0.1, 0.5];

pub(super) fn rig_file(force_axes: [&str; 3]) -> RigFile {
    let axes = SignedAxes::read(force_axes).expect("right-handed");
    let text = format!(
        "rig_version = 1\n[robot]\ndriver = \"lab/arm\"\ncarries = \"indenter\"\norigin_mm = [0.0, 0.0, 0.0]\naxes = [\"x\", \"y\", \"z\"]\n[force]\ndriver = \"lab/box\"\naxes = {axes}\n"
    );
    RigFile::parse("lab.toml", &text).expect("a rig")
}

/// Test bench in simulated time: an arm, a transducer, a camera, and a gel with one stiffness for each axis.
#[derive(Clone)]
pub(super) struct Bench(Arc<Mutex<State>>);

pub(super) struct State {
    now_s: f64,
    pose: Pose,
    /// Place at which the tip touched the gel.
    touched: Option<[f64; 2]>,
    axes: SignedAxes,
    readings: u32,
    pub(super) motions: u32,
    is_halted: bool,
    pub(super) supervisor: Option<SharedSupervisor>,
    // Possible faults.
    pub(super) surface_mm: f64,
    pub(super) stiffness: f64,
    pub(super) latency_s: f64,
    pub(super) late_until_s: f64,
    pub(super) clings_n: f64,
    pub(super) sees: Sees,
    /// Number of captured frames, modulo 256.
    frames: u8,
    /// True if Fx and Fy are swapped after the first touch.
    pub(super) is_swapped: bool,
    touches: u32,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Sees {
    Touches,
    Nothing,
    /// Frames show the first touch forever after it.
    Afterwards,
}

impl Bench {
    pub(super) fn new(axes: [&str; 3]) -> Bench {
        let mut pose = Pose::default();
        pose.position.z.0 = -5.0;
        Bench(Arc::new(Mutex::new(State {
            now_s: 10.0,
            pose,
            touched: None,
            axes: SignedAxes::read(axes).expect("right-handed"),
            readings: 0,
            motions: 0,
            is_halted: false,
            supervisor: None,
            surface_mm: SURFACE_MM,
            stiffness: 1.0,
            latency_s: 0.0,
            late_until_s: f64::INFINITY,
            clings_n: 0.0,
            sees: Sees::Touches,
            frames: 0,
            is_swapped: false,
            touches: 0,
        })))
    }

    pub(super) fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().expect("whole")
    }
}

impl State {
    fn stamp(&self) -> Stamp {
        Stamp {
            valid_s: self.now_s,
            received_s: None,
        }
    }

    fn depth_mm(&self) -> f64 {
        (self.pose.position.z.0 - self.surface_mm).max(0.0)
    }

    /// Force of the tip on the gel, along the axes of the sensor, in N.
    fn force_n(&mut self) -> [f64; 3] {
        let depth_mm = self.depth_mm();
        if depth_mm <= 0.0 {
            let is_new = self.touched.take().is_none();
            return [0.0, 0.0, if is_new { 0.0 } else { self.clings_n }];
        }
        let here = [self.pose.position.x.0, self.pose.position.y.0];
        self.touches += u32::from(self.touched.is_none());
        let touched = *self.touched.get_or_insert(here);
        let [x, y, z] = STIFFNESS_N_MM.map(|stiffness| stiffness * self.stiffness);
        [
            x * (here[0] - touched[0]),
            y * (here[1] - touched[1]),
            z * depth_mm,
        ]
    }
}

impl Halt for Bench {
    fn halt(&self) -> Result<(), DriverError> {
        self.state().is_halted = true;
        Ok(())
    }
}

impl Robot for Bench {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let state = self.state();
        Ok((state.pose, state.stamp()))
    }

    fn move_to(&mut self, target: Pose, speed: Speed, _: Deadline) -> Result<Stamp, DriverError> {
        let mut state = self.state();
        if state.is_halted {
            let key = DriverKey::fixed("lab/arm");
            return Err(DriverError::new(ErrorKind::Interrupted, &key, "move"));
        }
        let (from, to) = (state.pose.position, target.position);
        let way_mm = (to.x.0 - from.x.0)
            .hypot(to.y.0 - from.y.0)
            .hypot(to.z.0 - from.z.0);
        state.now_s += way_mm / speed.mm_per_s();
        state.pose = target;
        state.motions += 1;
        state.force_n();
        Ok(state.stamp())
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(self.clone())
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.state().is_halted = false;
        Ok(())
    }
}

pub(super) struct Transducer(pub(super) Bench);

impl ForceTransducer for Transducer {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }

    /// Reads the force along the true axes, maps it by the axes of the rig file, and passes it to the supervisor.
    fn read(&mut self, _: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let mut state = self.0.state();
        state.readings += 1;
        state.now_s += 0.002;
        let mounted = SignedAxes::read(MOUNTED).expect("right-handed");
        let hiss = f64::from(state.readings % 3) * 1e-4;
        let mut force = state.force_n();
        if state.is_swapped && state.touches > 1 {
            force.swap(0, 1);
        }
        let force = state.axes.to_sensor(mounted.to_device(force));
        let wrench = Wrench {
            force: force.map(|force_n| Newton(force_n + 0.2 + hiss)),
            ..Wrench::default()
        };
        let stamp = state.stamp();
        let is_late = state.now_s < state.late_until_s;
        let now_s = state.now_s + if is_late { state.latency_s } else { 0.0 };
        state.now_s = now_s;
        let supervisor = state.supervisor.clone().expect("it is guarded");
        let seen = Observation::Numbered(wrench, stamp, u64::from(state.readings));
        drop(state);
        let _ = supervisor.lock().observe(&seen, now_s);
        // The next reading starts once this one has arrived.
        Ok((
            wrench,
            Stamp {
                valid_s: now_s,
                ..stamp
            },
        ))
    }

    fn sequence(&self) -> Option<u64> {
        Some(u64::from(self.0.state().readings))
    }
}

const FRAME: FrameInfo = FrameInfo {
    width: 16,
    height: 16,
    format: PixelFormat::Gray8,
};

struct Camera(Bench);

impl Sensor for Camera {
    fn frame_info(&self) -> FrameInfo {
        FRAME
    }

    fn capture(&mut self, mut into: FrameMut<'_>, _: Deadline) -> Result<Stamp, DriverError> {
        let mut state = self.0.state();
        state.now_s += 0.01;
        let is_seen = match state.sees {
            Sees::Nothing => false,
            Sees::Touches => state.depth_mm() > 0.0,
            Sees::Afterwards => state.readings > 0 && state.deepest() > 0.0,
        };
        for (place, byte) in into.bytes_mut().iter_mut().enumerate() {
            *byte = if is_seen && place < 32 { 90 } else { 60 };
        }
        // A camera whose frames are equal is frozen; this one lives.
        if matches!(state.sees, Sees::Afterwards) {
            state.frames = state.frames.wrapping_add(1);
            into.bytes_mut()[255] = state.frames;
        }
        Ok(state.stamp())
    }
}

impl State {
    /// Depth that a frame shows, in mm. A frame may show an earlier touch.
    fn deepest(&mut self) -> f64 {
        if self.depth_mm() > 0.0 {
            self.clings_n = self.clings_n.max(f64::MIN_POSITIVE);
        }
        self.clings_n
    }
}

impl Timekeeper for Bench {
    fn now_s(&self) -> f64 {
        self.state().now_s
    }

    fn rest(&mut self, rest: Duration) {
        self.state().now_s += rest.as_secs_f64();
    }
}

/// Test log that stores the records of a session.
#[derive(Default)]
pub(super) struct Memory {
    pub(super) presses: usize,
    pub(super) sessions: Vec<SessionRecord>,
}

impl PressLog for Memory {
    fn is_finished(&self, _: ContentId) -> bool {
        false
    }
    fn append(&mut self, _: &PressRecord) -> Result<(), SinkError> {
        self.presses += 1;
        Ok(())
    }
    fn untouched(&mut self, _: &Frame) -> Result<(), SinkError> {
        Ok(())
    }
    fn session(&mut self, record: &SessionRecord) -> Result<(), SinkError> {
        assert_eq!(self.presses, 0, "it comes before the first press");
        self.sessions.push(record.clone());
        Ok(())
    }
}

/// Test operator with one fixed answer. Records for each question the height of the tip and the number of its motions.
pub(super) struct Person {
    bench: Bench,
    answer: Answer,
    pub(super) asked: Vec<(Question, f64, u32)>,
}

impl Operator for Person {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        let state = self.bench.state();
        let asked = (question.clone(), state.pose.position.z.0, state.motions);
        self.asked.push(asked);
        self.answer
    }
}

pub(super) struct Session<'a> {
    pub(super) rig: &'a RigFile,
    pub(super) robot: Option<&'a str>,
    pub(super) touched: &'a [ReferenceTouch],
    pub(super) answer: Option<Answer>,
}

/// A supervisor of the bench that receives every reading of its transducer.
pub(super) fn supervised(bench: &Bench, plan: &Plan) -> SharedSupervisor {
    let limits = plan.limits.clone().expect("it moves");
    let supervisor = SharedSupervisor::new(Supervisor::new(limits, Arc::new(bench.clone())));
    bench.state().supervisor = Some(supervisor.clone());
    supervisor
}

/// Plan of one press: a touch of the surface, with a frame.
pub(super) fn one_press() -> Plan {
    let mut plan = plan();
    plan.presses.truncate(1);
    let planned = &mut plan.presses[0];
    planned.press.motion = Motion::Touch;
    planned.press.light = None;
    planned.frames = true;
    plan.contact.threshold_n.value = 0.02;
    plan.limits.as_mut().expect("it moves").signals.host_zero = true;
    plan
}

pub(super) fn begun(bench: &Bench, session: Session<'_>) -> (Result<(), RunError>, Memory, Person) {
    begun_with(bench, session, &one_press())
}

/// Runs a session like [`begun`], with the presses of `plan`.
pub(super) fn begun_with(
    bench: &Bench,
    session: Session<'_>,
    plan: &Plan,
) -> (Result<(), RunError>, Memory, Person) {
    let mut log = Memory::default();
    let mut person = Person {
        bench: bench.clone(),
        answer: session.answer.unwrap_or(Answer::Done),
        asked: Vec::new(),
    };
    let supervisor = supervised(bench, plan);
    let (mut robot, mut clock) = (bench.clone(), bench.clone());
    let (mut force, mut camera) = (Transducer(bench.clone()), Camera(bench.clone()));
    let devices = Devices {
        robot: &mut robot,
        force: &mut force,
        sensor: Some(&mut camera),
        lighting: None,
        specimens: None,
    };
    let cancel = Cancel::new();
    let has_person = session.answer.is_some();
    let controls = Controls {
        clock: &mut clock,
        cancel: &cancel,
        events: &mut |_| {},
        operator: has_person.then_some(&mut person as &mut dyn Operator),
    };
    let spec = RunSpec {
        plan,
        unit: &plan.presses[0].press.unit,
        mode: Mode::Acquire,
    };
    let session = SessionSpec {
        rig: session.rig,
        robot: session.robot,
        touched: session.touched,
    };
    let done = run_guarded(
        &spec,
        devices,
        &mut log,
        controls,
        Oversight::new(supervisor).with_session(session),
    );
    (done.map(drop), log, person)
}
