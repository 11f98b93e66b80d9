//! Tests with recordings of the simulated MagicTac with faults: findings of the checks, and errors that a new untouched picture removes.

use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_check::{ALL, CheckRequest, check};
use taceva_core::{Channel, Channels, Clock, Frame, Readings, Sample, SilentProgress};
use taceva_dataset::{Dataset, Recorder, RecordingFacts, RecordingSpec, SensorFacts, Source};
use taceva_sim::Model;
use taceva_sim::contact::{Indentation, Solid};
use taceva_sim::optics::{Bits, Camera, OpticsSpec, Stimulus, View};
use taceva_stress::{FAULTS, Fault, Stress, StressRequest, Undefined, stress};

use crate::bench_monitor::taken;
use crate::drawing::{WORK, fitted};

/// Number of contact points of the recording. Each is pressed to five depths.
const POINTS: u32 = 16;

/// Press, with its picture and its labels.
struct Pressed {
    frame: Frame,
    labels: [f64; 2],
    point: u32,
}

/// Untouched picture and presses of a simulated MagicTac.
struct Drawn {
    rest: Frame,
    presses: Vec<Pressed>,
}

impl Drawn {
    /// Simulates the presses. `turn` rotates their contact points, in radians.
    fn new(turn: f64) -> Drawn {
        let parameters = Model::MagicTac.parameters();
        let spec = OpticsSpec::new(&parameters);
        let camera = Camera::new(&spec, [80, 106], 0, 7).expect("a small frame");
        let mut camera = camera.with_bits(Bits::Eight);
        let rest = taken(&mut camera, &View::default());
        let (solid, probing) = (Solid::new(&parameters), parameters.probing);
        let mut presses = Vec::new();
        for number in 0..5 * POINTS {
            let point = number / 5;
            let (sin, cos) = (2.399_963 * f64::from(point) + turn).sin_cos();
            let out = 0.8 * (f64::from(point) / f64::from(POINTS)).sqrt();
            let depth_mm = probing.depth_max_mm * 0.2 * f64::from(number % 5 + 1);
            let contact = solid.contact(&Indentation {
                place_mm: [
                    probing.half_width_mm * out * cos,
                    probing.half_height_mm * out * sin,
                ],
                depth_mm,
                deepest_mm: depth_mm,
                shear_mm: [0.0; 2],
                indenter_radius_mm: 2.0,
                stiffness: 1.0,
            });
            let view = View {
                stimulus: Stimulus::Ball(contact),
                press: u64::from(number) + 1,
                ..View::default()
            };
            presses.push(Pressed {
                frame: taken(&mut camera, &view),
                labels: [contact.position_mm[0], contact.force_n[2]],
                point,
            });
        }
        Drawn { rest, presses }
    }

    /// Records the presses with `fault`. The untouched picture is from before the fault.
    fn record(&self, path: &Path, fault: Option<Stress>) -> Dataset {
        let sensor = SensorFacts::new("MagicTac").with_serial("0").with_gel("1");
        let facts = RecordingFacts::new(Source::Simulated, Clock::Unknown, sensor);
        let channels = Channels::new([Channel::PX, Channel::FZ]).expect("two");
        let spec = RecordingSpec::new(facts, channels);
        let mut recorder = Recorder::create(path, &spec).expect("new");
        recorder.append_reference(&self.rest).expect("recorded");
        let mut before: Option<&Frame> = None;
        for (number, press) in self.presses.iter().enumerate() {
            let name = format!("s{number:02}");
            let frame = match &fault {
                Some(stress) => stress.apply(&press.frame, &name, before),
                None => press.frame.clone(),
            };
            before = Some(&press.frame);
            let sample = Sample::new(name)
                .with_point_id(format!("p{}", press.point))
                .with_frame(frame)
                .with_truth(Readings::from_values(press.labels));
            recorder.append(&sample).expect("recorded");
        }
        recorder.close().expect("closed");
        Dataset::open(path).expect("a dataset")
    }
}

/// Codes of the findings in `dataset`, without TAC034. TAC034 alone compares untouched pictures with those from before the fault.
fn found(dataset: &Dataset) -> BTreeSet<&'static str> {
    let codes = ALL.iter().map(|check| check.code.to_owned());
    let request = CheckRequest {
        only: codes.filter(|code| code != "TAC034").collect(),
        split: None,
        seed: 0,
        jobs: NonZeroUsize::MIN,
    };
    let report = check(dataset, &request, &SilentProgress).expect("checked");
    report.findings.iter().map(|of| of.code).collect()
}

#[test]
fn ten_of_twelve_faults_at_severity_3_are_found_by_no_check_of_the_recording_alone() {
    let folder = tempfile::tempdir().expect("a folder");
    let drawn = Drawn::new(0.0);
    let clean = found(&drawn.record(&folder.path().join("clean"), None));
    let new = |fault: &'static Fault| {
        let stress = Stress::new(fault, fault.table[2], 1);
        let dataset = drawn.record(&folder.path().join(fault.id), Some(stress));
        let codes: Vec<&str> = found(&dataset).difference(&clean).copied().collect();
        (fault.id, codes)
    };
    let noticed: Vec<(&str, Vec<&str>)> = FAULTS
        .into_iter()
        .map(new)
        .filter(|(_, codes)| !codes.is_empty())
        .collect();
    let names: Vec<&str> = noticed.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["exposure_high", "stale_frames"], "{noticed:?}");
    assert!(noticed[0].1.contains(&"TAC004"), "{noticed:?}");
    assert!(noticed[1].1.contains(&"TAC002"), "{noticed:?}");
}

#[test]
fn a_new_untouched_picture_corrects_nine_tenths_of_faults_that_lie_still_in_the_picture() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = Drawn::new(0.7).record(&folder.path().join("seen"), None);
    let model = fitted(&seen, "ridge", &["size=16x16", "difference=true"]);
    let dataset = Drawn::new(0.0).record(&folder.path().join("unseen"), None);
    let request = StressRequest {
        faults: ["scratches", "tear", "dust"].map(str::to_owned).into(),
        severities: vec![1, 2, 3],
        ..StressRequest::default()
    };
    let report = stress(&dataset, &model, &request, WORK).expect("tested");
    let shares = report.faults.iter().map(|fault| fault.recovers["Fz"]);
    let known: Vec<f64> = shares.clone().filter_map(|share| share.value).collect();
    assert!(
        !known.is_empty() && known.iter().all(|share| *share >= 0.9),
        "{known:?}"
    );
    // A fault that adds no error has nothing to correct.
    let mut others = shares.filter(|share| share.value.is_none());
    assert!(others.all(|share| share.reason == Some(Undefined::NoExcess)));
}

#[test]
fn on_the_bench_a_higher_severity_changes_pictures_more_and_nine_of_ten_errors_do_not_fall() {
    let folder = tempfile::tempdir().expect("a folder");
    let seen = Drawn::new(0.7).record(&folder.path().join("seen"), None);
    let model = fitted(&seen, "ridge", &["size=16x16", "difference=true"]);
    let dataset = Drawn::new(0.0).record(&folder.path().join("unseen"), None);
    let report = stress(&dataset, &model, &StressRequest::default(), WORK).expect("tested");
    assert_eq!(report.faults.len(), FAULTS.len());
    let (mut pairs, mut falling) = (0, Vec::new());
    for fault in &report.faults {
        for pair in fault.severities.windows(2) {
            let stimuli = [&pair[0], &pair[1]].map(|of| of.stimulus.expect("a contact"));
            assert!(stimuli[0] < stimuli[1], "{}: {stimuli:?}", fault.id);
            let [lower, higher] = [&pair[0], &pair[1]].map(|of| of.stale["Fz"].degradation);
            let [_, end] = higher.ci95.expect("sixteen points");
            pairs += 1;
            if end < lower.value.expect("a ratio") {
                falling.push(format!("{} {}", fault.id, pair[1].severity));
            }
        }
    }
    // Within intervals: an error falls if the upper end of its interval is below the error of the lower severity.
    assert!(10 * falling.len() <= pairs, "of {pairs}: {falling:?}");
}
