//! A whole study planned by `taceva-protocol`, run on the bench under its supervisor.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use taceva_core::{
    Deadline, DriverError, DriverKey, ErrorKind, FrameInfo, FrameMut, Nanometre, Phase,
    PressOutcome, Sample, Sensor, Stamp,
};
use taceva_protocol::{PhaseKind, PlannedPress, PressRecord, RunError, Specimen, StopCause};
use taceva_sim::Model;

use crate::trial::{Log, Trial};

fn scene(model: Model) -> String {
    format!(
        "scene_version = 1
name = \"small\"
seed = 7
[robot]
driver = \"sim/robot\"
[force]
driver = \"sim/force-transducer\"
[lighting]
driver = \"sim/lighting\"
[model]
name = \"ridge\"
[protocol.calibration]
points = 6
indentations = 3
[protocol.spatial]
points = 4
[protocol.gratings]
step_mm = 0.75
presses = 2
[protocol.lighting]
points = 2
[protocol.repeatability]
points = 2
trials = 3
depth_step_mm = 0.5
[protocol.hysteresis]
points = 2
[protocol.surface]
points = 4
[protocol.idle]
frames = 3
[[study]]
name = \"one\"
[study.sensor]
driver = \"sim/{}\"
units = [\"1\", \"2\"]
",
        model.key()
    )
}

/// Upper bound of the error of a force reading.
const NOISE_N: f64 = 0.05;

#[test]
fn every_part_of_a_study_runs_to_its_end_on_every_sensor() {
    for model in Model::ALL {
        let tasks = "[protocol]\nslip = { strokes = 2, length_mm = 0.4 }\nshape = { presses = 2 }\npose = { pairs = 1 }\n";
        let trial = Trial::new(
            model,
            &scene(model).replace(
                "[protocol.calibration]",
                &format!("{tasks}[protocol.calibration]"),
            ),
        );
        let mut log = Log::default();
        for unit in ["1", "2"] {
            trial.run(unit, &mut log, usize::MAX);
        }
        assert_eq!(log.records.len(), trial.plan.presses.len(), "{model}");
        for kind in PhaseKind::ALL {
            // Ambient light does not reach the camera behind a coated gel.
            let is_left_out = kind == PhaseKind::LightSweep
                && matches!(model, Model::GelSight | Model::GelSightWm);
            let presses: Vec<&PlannedPress> = trial.plan.presses_of(kind).collect();
            assert_eq!(presses.is_empty(), is_left_out, "{model}: {kind}");
            for planned in presses {
                check(&trial, planned, &log);
            }
        }
    }
}

/// Checks that a record is complete for its press.
fn check(trial: &Trial, planned: &PlannedPress, log: &Log) {
    let mut records = log.records.iter();
    let record = records
        .find(|record| record.press == planned.id)
        .expect("it was made");
    let name = format!("{} {:?} {}", trial.model, planned.phases, planned.id);
    let (samples, wanted) = (&record.samples, planned.press.samples());
    match record.outcome {
        PressOutcome::Complete => assert_eq!(samples.len(), wanted, "{name}"),
        // Waypoints beyond a limit are omitted. The first of them is captured at the place where the tip stopped.
        PressOutcome::Limited(_) => {
            assert!(limited(record) > 0 && samples.len() <= wanted, "{name}");
        }
        other => panic!("{name}: {other:?}"),
    }
    let times: Vec<f64> = samples
        .iter()
        .map(|sample| sample.stamp.expect("taken at a time").valid_s)
        .collect();
    assert!(times.is_sorted_by(|one, next| one < next), "{name}");
    assert!(
        samples
            .iter()
            .map(number)
            .is_sorted_by(|one, next| one < next),
        "{name}"
    );
    for sample in samples {
        assert_eq!(sample.id, format!("{}/{}", planned.id, number(sample)));
        assert_eq!(sample.frame.is_some(), planned.frames, "{name}");
        let mut truth = sample.truth.as_slice().iter().flatten();
        assert!(truth.clone().count() > 0, "{name}");
        assert!(truth.all(|value| value.is_finite()), "{name}");
        let is_board = matches!(planned.press.specimen, Specimen::Grating { .. });
        assert_eq!(sample.kind.is_some(), is_board, "{name}");
    }
    check_forces(trial, planned, record);
}

/// Number of samples at which a limit stopped the robot before its waypoint.
fn limited(record: &PressRecord) -> usize {
    let samples = record.samples.iter();
    samples.filter(|sample| sample.limited_by.is_some()).count()
}

/// Number of a sample in its press.
fn number(sample: &Sample) -> usize {
    let (_, number) = sample.id.split_once('/').expect("press and number");
    number.parse().expect("a number")
}

/// Checks that the force grows with depth and decreases during retraction.
fn check_forces(trial: &Trial, planned: &PlannedPress, record: &PressRecord) {
    let mut channels = trial.plan.channels.iter();
    let channel = channels
        .position(|name| name == "Fz")
        .expect("it is measured");
    let mut channels = trial.plan.channels.iter();
    let depth = channels
        .position(|name| name == "Pz")
        .expect("it is measured");
    let waypoints = planned.press.waypoints();
    let curve: Vec<(f64, f64)> = record
        .samples
        .iter()
        .filter_map(|sample| Some((waypoints.get(number(sample))?, sample)))
        .filter(|(waypoint, _)| waypoint.shear == [Nanometre(0); 2])
        .map(|(waypoint, sample)| {
            let [depth_mm, force_n] =
                [depth, channel].map(|place| sample.truth.get(place).expect("it is read"));
            let was_reached = sample.depth_step.is_some();
            let depth_mm = if was_reached {
                waypoint.depth.to_millimetres()
            } else {
                depth_mm
            };
            (depth_mm, force_n)
        })
        .collect();
    for pair in curve.windows(2) {
        let [(depth, force), (next_depth, next_force)] = [pair[0], pair[1]];
        let wants = next_depth - depth;
        let rises = if wants == 0.0 { 0.0 } else { wants.signum() } * (next_force - force);
        assert!(rises > -NOISE_N, "{}: {curve:?}", trial.model);
    }
}

#[test]
fn a_run_that_was_interrupted_records_what_an_uninterrupted_one_does() {
    let scene = scene(Model::ViTacTip);
    let log = interrupted_and_whole(&Trial::new(Model::ViTacTip, &scene));
    assert!(!log.records.is_empty());
    assert!(!log.untouched.is_empty());
}

#[test]
fn presses_that_a_limit_ends_come_out_of_the_gel_by_their_stations_and_are_resumed_like_others() {
    let limits = "[limits]\nFz_max_N = 0.6\n[[study]]";
    let scene = scene(Model::GelSight).replace("[[study]]", limits);
    let trial = Trial::new(Model::GelSight, &scene);
    let log = interrupted_and_whole(&trial);
    let is_limited = |record: &&PressRecord| record.outcome.is_limited();
    assert!(log.records.iter().filter(is_limited).count() > 5);
    for planned in trial.plan.presses_of(PhaseKind::LoadUnload) {
        let mut records = log.records.iter().filter(is_limited);
        let record = records.find(|record| record.press == planned.id);
        let record = record.expect("no place of the gel bears the deepest waypoint");
        let out = record.samples.iter();
        let out = out.filter(|sample| sample.phase == Some(Phase::Unload));
        assert_eq!(2 * out.count(), record.samples.len());
        assert_eq!(
            limited(record),
            2,
            "the way in ends where the way out begins"
        );
        check(&trial, planned, &log);
    }
}

/// A sensor in which every n-th frame has a wrong size, so the driver rejects it.
struct Short {
    inner: Box<dyn Sensor>,
    every: u32,
    captured: Arc<AtomicU32>,
}

impl Sensor for Short {
    fn frame_info(&self) -> FrameInfo {
        self.inner.frame_info()
    }

    fn start(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.inner.start(deadline)
    }

    fn capture(&mut self, into: FrameMut<'_>, deadline: Deadline) -> Result<Stamp, DriverError> {
        const SENSOR: DriverKey = DriverKey::fixed("test/short");
        let stamp = self.inner.capture(into, deadline)?;
        let captured = self.captured.fetch_add(1, Ordering::Relaxed) + 1;
        if captured.is_multiple_of(self.every) {
            let why = "a frame of 64×48 rgb8 in 4608 bytes, expected 9216".to_owned();
            let error = DriverError::new(ErrorKind::Protocol, &SENSOR, "capture a frame");
            return Err(error.because(why));
        }
        Ok(stamp)
    }

    fn stop(&mut self) -> Result<(), DriverError> {
        self.inner.stop()
    }
}

/// Result of a run in which every n-th frame has a wrong size: its log, and the number of repeated frames.
fn with_short(every: u32) -> (Log, Result<usize, RunError>) {
    let trial = Trial::new(Model::GelSight, &scene(Model::GelSight));
    let mut log = Log::default();
    let instead = |inner| -> Box<dyn Sensor> {
        Box::new(Short {
            inner,
            every,
            captured: Arc::default(),
        })
    };
    let done = trial.run_seen_by("1", &mut log, usize::MAX, instead);
    (log, done)
}

#[test]
fn frames_of_a_wrong_size_end_a_run_by_an_error_that_says_which_size() {
    let (_, done) = with_short(1);
    let error = done.expect_err("no frame is right");
    let is_of_frames = matches!(&error.cause, StopCause::Frames { last: Some(_), .. });
    assert!(is_of_frames, "{error:?}");
    let said = error.to_string();
    assert!(said.contains("in 4608 bytes, expected 9216"), "{said}");
}

#[test]
fn a_frame_of_a_wrong_size_now_and_then_is_taken_again_and_counted() {
    let (whole, none) = with_short(u32::MAX);
    let (again, retried) = with_short(2);
    assert_eq!(none.expect("a run"), 0);
    let retried = retried.expect("a run");
    assert!(retried > 10, "{retried}");
    assert_eq!(again.records.len(), whole.records.len());
}

#[test]
fn the_camera_draws_each_recorded_frame_once_and_none_on_the_way_to_the_gel() {
    let trial = Trial::new(Model::GelSight, &scene(Model::GelSight));
    let mut log = Log::default();
    let drawn = Arc::new(AtomicU32::new(0));
    let captured = Arc::clone(&drawn);
    let counted = |inner| -> Box<dyn Sensor> {
        Box::new(Short {
            inner,
            every: u32::MAX,
            captured,
        })
    };
    trial
        .run_seen_by("1", &mut log, usize::MAX, counted)
        .expect("a run");
    let samples = log.records.iter().flat_map(|record| &record.samples);
    let recorded = samples.filter(|sample| sample.frame.is_some()).count();
    assert!(recorded > 20, "{recorded}");
    let drawn = drawn.load(Ordering::Relaxed) as usize;
    assert_eq!(drawn, recorded + log.untouched.len());
}

/// Log of an uninterrupted run of unit 1, compared with the log of an interrupted one.
fn interrupted_and_whole(trial: &Trial) -> Log {
    let (mut whole, mut pieces) = (Log::default(), Log::default());
    trial.run("1", &mut whole, usize::MAX);
    for most in [3, 8, 10, usize::MAX] {
        trial.run("1", &mut pieces, most);
    }
    // The log has one picture of the untouched gel for any number of restarts, and it differs from all presses.
    let pressed = whole.records.iter().flat_map(|record| &record.samples);
    let mut pressed = pressed.filter_map(|sample| sample.frame.as_ref());
    if let Some(first) = pressed.next() {
        assert_eq!(whole.untouched.len(), 1);
        assert_eq!(whole.untouched, pieces.untouched);
        assert_ne!(&whole.untouched[0], first);
    }
    assert_eq!(whole.records.len(), pieces.records.len());
    for (one, other) in whole.records.iter().zip(&pieces.records) {
        assert_eq!((one.press, one.outcome), (other.press, other.outcome));
        assert_eq!(one.samples.len(), other.samples.len());
        for (one, other) in one.samples.iter().zip(&other.samples) {
            // Only the time of day differs.
            assert_eq!(one.truth, other.truth, "{}", one.id);
            assert_eq!(one.frame, other.frame, "{}", one.id);
            assert_eq!(one.limited_by, other.limited_by, "{}", one.id);
        }
    }
    whole
}
