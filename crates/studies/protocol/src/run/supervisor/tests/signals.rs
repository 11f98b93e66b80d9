//! Tests of frozen signals, and of the state after a halt or a new stage.

use super::*;
use crate::limits::FROZEN_READINGS;

/// Supervisor of a moving tip. A force is read after each motion, every 0.02 s.
struct Watched {
    supervisor: Supervisor,
    now_s: f64,
}

impl Watched {
    fn new(stage: MotionStage) -> Watched {
        let (supervisor, _) = watching(stage);
        Watched {
            supervisor,
            now_s: 10.0,
        }
    }

    fn moved(&mut self) {
        let moved = self
            .supervisor
            .observe(&pose(0.3, 0.3, self.now_s), self.now_s);
        assert_eq!(moved, Ok(()));
    }

    fn read(&mut self, force_n: f64) -> Option<Trip> {
        let force = Observation::Force(force(force_n), at(self.now_s));
        let tripped = self.supervisor.observe(&force, self.now_s).err();
        self.now_s += 0.02;
        tripped
    }

    /// Reads `force_n` after each of `count` motions, and checks that no reading halts the robot.
    fn repeat(&mut self, count: u32, force_n: f64) {
        for _ in 0..count {
            self.moved();
            assert_eq!(self.read(force_n), None);
        }
    }
}

#[test]
fn one_equal_reading_fewer_than_frozen_passes_and_the_next_halts_with_their_number() {
    let mut watched = Watched::new(PRESS);
    // The first reading has no predecessor.
    watched.repeat(1 + FROZEN_READINGS - 1, 0.1);
    watched.moved();
    let readings = FROZEN_READINGS;
    assert_eq!(watched.read(0.1), Some(Trip::Frozen { readings }));
}

#[test]
fn a_reading_that_differs_in_any_component_begins_the_count_anew() {
    let mut watched = Watched::new(PRESS);
    watched.repeat(FROZEN_READINGS, 0.1);
    assert!(!watched.supervisor.is_fresh());
    let mut other = force(0.1);
    other.torque[0].0 = 1e-9;
    watched.moved();
    let now_s = watched.now_s;
    let other = Observation::Force(other, at(now_s));
    assert_eq!(watched.supervisor.observe(&other, now_s), Ok(()));
    assert!(watched.supervisor.is_fresh());
    watched.now_s += 0.02;
    watched.repeat(FROZEN_READINGS, 0.1);
}

#[test]
fn equal_readings_at_rest_neither_count_nor_forgive() {
    let mut watched = Watched::new(PRESS);
    watched.repeat(FROZEN_READINGS, 0.1);
    for _ in 0..20 {
        assert_eq!(watched.read(0.1), None);
    }
    watched.moved();
    assert!(matches!(watched.read(0.1), Some(Trip::Frozen { .. })));
}

#[test]
fn a_signal_that_froze_in_the_search_is_frozen_in_the_press() {
    let mut watched = Watched::new(MotionStage::Search);
    watched.repeat(FROZEN_READINGS, 0.1);
    watched.supervisor.watch(PRESS, watched.now_s);
    watched.moved();
    assert!(matches!(watched.read(0.1), Some(Trip::Frozen { .. })));
}

#[test]
fn a_signal_that_froze_in_the_air_is_counted_on_from_stage_to_stage() {
    let air = MotionStage::Travel { threshold_n: 5.0 };
    let mut watched = Watched::new(air);
    watched.repeat(FROZEN_READINGS / 2, 0.1);
    watched.supervisor.watch(air, watched.now_s);
    assert!(!watched.supervisor.is_fresh());
    watched.repeat(FROZEN_READINGS / 2, 0.1);
    watched.supervisor.watch(MotionStage::Search, watched.now_s);
    watched.moved();
    let readings = FROZEN_READINGS;
    assert_eq!(watched.read(0.1), Some(Trip::Frozen { readings }));
}

#[test]
fn a_number_that_stands_still_is_counted_on_over_travel() {
    let mut watched = Watched::new(PRESS);
    let mut read = |stage: MotionStage, noise_n: f64| {
        let now_s = watched.now_s;
        watched.supervisor.watch(stage, now_s);
        watched.moved();
        // The force differs; the sequence number does not.
        let said = Observation::Numbered(force(0.1 + noise_n), at(now_s), 7);
        watched.now_s += 0.02;
        watched.supervisor.observe(&said, now_s).err()
    };
    let air = MotionStage::Travel { threshold_n: 5.0 };
    for reading in 0..FROZEN_READINGS {
        let stage = if reading < 4 { PRESS } else { air };
        assert_eq!(read(stage, f64::from(reading) * 1e-6), None);
    }
    let readings = FROZEN_READINGS;
    assert_eq!(read(air, 1.0), Some(Trip::Frozen { readings }));
}

#[test]
fn a_transducer_that_sets_its_zero_begins_the_count_anew() {
    let mut watched = Watched::new(MotionStage::Search);
    watched.repeat(FROZEN_READINGS, 0.1);
    let now_s = watched.now_s;
    watched.supervisor.watch(MotionStage::Zeroing, now_s);
    assert!(watched.supervisor.is_fresh());
    watched.supervisor.watch(MotionStage::Search, now_s);
    watched.repeat(FROZEN_READINGS, 0.1);
}

#[test]
fn travel_forgets_the_force_before_it_for_its_zero_may_have_moved() {
    let mut watched = Watched::new(MotionStage::Search);
    watched.repeat(1, 0.1);
    let air = MotionStage::Travel { threshold_n: 5.0 };
    watched.supervisor.watch(air, watched.now_s);
    // A step across the change of zero is not a rate; 1.6 N in 6 ms would be too fast.
    watched.now_s -= 0.014;
    assert_eq!(watched.read(-1.5), None);
}

#[test]
fn the_first_reason_of_a_halt_is_kept_whatever_comes_after_it() {
    let (mut supervisor, halts) = watching(PRESS);
    let hard = Observation::Force(force(9.0), at(10.0));
    let first = supervisor.observe(&hard, 10.0).expect_err("a limit");
    assert!(matches!(first, Trip::NormalForce { .. }));
    assert_eq!(supervisor.observe(&Observation::Silence, 20.0), Err(first));
    assert_eq!(supervisor.trip(Trip::NotFinite), first);
    assert_eq!(supervisor.tripped(), Some(first));
    assert_eq!(halts.0.load(Ordering::SeqCst), 3);
    supervisor.release(PRESS, 20.0);
    assert_eq!(supervisor.tripped(), None);
}

#[test]
fn every_component_that_is_no_number_halts() {
    for axis in 0..3 {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut wrench = Wrench::default();
            wrench.force[axis] = Newton(value);
            let force = Observation::Force(wrench, at(10.02));
            assert_eq!(trip(PRESS, &force), Some(Trip::NotFinite));
            let mut place = [0.3; 3];
            place[axis] = value;
            let [x, y, z] = place.map(Millimetre);
            let observation = Observation::Pose {
                pose: Pose {
                    position: Point { x, y, z },
                    ..Pose::default()
                },
                stamp: at(10.02),
                target: at_height(0.3),
            };
            assert_eq!(trip(PRESS, &observation), Some(Trip::NotFinite));
        }
    }
    let no_time = pose(0.3, 0.3, f64::NAN);
    assert_eq!(trip(PRESS, &no_time), Some(Trip::NotFinite));
}
