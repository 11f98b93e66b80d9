//! Tests of readings, and of a transducer that fails.

use std::sync::atomic::{AtomicU32, Ordering};

use taceva_core::{Halt, Millimetre, Newton, SilentProgress};
use taceva_protocol::{MotionStage, RigLimits, Supervisor, Trip};

use super::*;

const KEY: DriverKey = DriverKey::fixed("test/force");

/// A scripted transducer. Each reading uses one entry, and further readings time out.
struct Script(Vec<Result<f64, ErrorKind>>);

impl ForceTransducer for Script {
    fn axes(&self) -> Axes {
        Axes::NORMAL
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        std::thread::sleep(Duration::from_millis(2));
        if self.0.is_empty() {
            std::thread::sleep(deadline.remaining());
            return Err(DriverError::new(ErrorKind::Timeout, &KEY, "read"));
        }
        match self.0.remove(0) {
            Ok(force_n) => {
                let mut wrench = Wrench::default();
                wrench.force[2] = Newton(force_n);
                Ok((wrench, Stamp::at(MonotonicClock.now())))
            }
            Err(kind) => Err(DriverError::new(kind, &KEY, "read")),
        }
    }
}

#[derive(Default)]
struct Halts(AtomicU32);

impl Halt for Halts {
    fn halt(&self) -> Result<(), DriverError> {
        self.0.fetch_add(1, Ordering::SeqCst);
        Ok(())
    }
}

/// Calls `act` with a transducer that follows `script`. Returns the result of `act` and the number of halts.
fn reading<T>(
    script: Vec<Result<f64, ErrorKind>>,
    act: impl FnOnce(&mut Mailbox, &SharedSupervisor) -> T,
) -> (T, u32) {
    reading_for(script, &SilentProgress, act)
}

/// Like [`reading`], with messages to `progress`.
fn reading_for<T>(
    script: Vec<Result<f64, ErrorKind>>,
    progress: &dyn Progress,
    act: impl FnOnce(&mut Mailbox, &SharedSupervisor) -> T,
) -> (T, u32) {
    let limits = RigLimits {
        depth_max: Millimetre(1.0),
        normal_max: Newton(2.0),
        shear_max: Newton(2.0),
        saturation: None,
        speed_max_mm_s: 20.0,
        overshoot: taceva_protocol::Overshoot {
            segment_mm: 0.015,
            healthy_mm: 0.0155,
            frozen_mm: 0.1205,
        },
        simulated: false,
        signals: taceva_protocol::Signals::default(),
    };
    let halts = Arc::new(Halts::default());
    let mut supervisor = Supervisor::new(limits, halts.clone());
    supervisor.watch(MotionStage::Search, MonotonicClock.now_s());
    let supervisor = SharedSupervisor::new(supervisor);
    let mut force = Script(script);
    let (mailbox, reader) = Mailbox::of(&mut force, KEY);
    let punctuality = Punctuality::new(progress);
    let seen = std::thread::scope(|scope| {
        let listeners = Listeners {
            supervisor: &supervisor,
            punctuality: &punctuality,
            viewer: None,
            progress,
        };
        let force = &mut force;
        scope.spawn(move || reader.serve(force, listeners));
        let mut mailbox = mailbox;
        mailbox.start(Deadline::PASSED).expect("started");
        act(&mut mailbox, &supervisor)
    });
    (seen, halts.0.load(Ordering::SeqCst))
}

const SECOND: Deadline = Deadline::after(Duration::from_secs(1));

#[test]
fn a_reading_is_taken_out_once_and_the_newest_first() {
    let script = vec![Ok(0.1), Ok(0.2), Ok(0.3)];
    let ((first, newest, nothing), halts) = reading(script, |mailbox, _| {
        let force_n = |mailbox: &mut Mailbox, deadline| {
            let read = mailbox.read(deadline);
            read.map(|(wrench, _)| wrench.force[2].0)
                .map_err(|error| error.kind())
        };
        let first = force_n(mailbox, SECOND);
        std::thread::sleep(Duration::from_millis(100));
        let newest = force_n(mailbox, SECOND);
        (first, newest, force_n(mailbox, Deadline::PASSED))
    });
    assert_eq!((first, newest), (Ok(0.1), Ok(0.3)));
    assert_eq!((nothing, halts), (Err(ErrorKind::Timeout), 0));
}

#[test]
fn a_limit_is_seen_by_the_thread_that_reads_though_nobody_asks() {
    let (tripped, halts) = reading(vec![Ok(0.1), Ok(2.5)], |_, supervisor| {
        std::thread::sleep(Duration::from_millis(100));
        supervisor.lock().tripped()
    });
    assert!(
        matches!(tripped, Some(Trip::NormalForce { .. })),
        "{tripped:?}"
    );
    assert_eq!(halts, 1);
}

#[test]
fn a_transducer_that_fails_halts_and_its_error_is_found_by_who_reads_next() {
    for (kind, is_trip) in [
        (ErrorKind::OutOfRange, true),
        (ErrorKind::Disconnected, false),
    ] {
        let ((found, tripped), halts) = reading(vec![Err(kind)], |mailbox, supervisor| {
            let found = mailbox.read(SECOND).map_err(|error| error.kind());
            (found.map(drop), supervisor.lock().tripped())
        });
        assert_eq!((found, tripped.is_some()), (Err(kind), is_trip));
        assert_eq!(halts, 1);
    }
}

/// Test observer that stores messages.
#[derive(Default)]
struct Remarks(Mutex<Vec<String>>);

impl Progress for Remarks {
    fn begin(&self, _: &str, _: Option<u64>) {}
    fn advance(&self, _: u64) {}
    fn end(&self) {}
    fn is_cancelled(&self) -> bool {
        false
    }
    fn remark(&self, words: &str) {
        self.0.lock().expect("whole").push(words.to_owned());
    }
}

/// Number of halts and the messages, for a transducer that is lost during a question to the operator. If `is_answered`, the question ends before the run.
fn lost_at_a_question(is_answered: bool) -> (u32, Vec<String>) {
    let readings = (0..20).map(|number| Ok(f64::from(number) * 1e-6));
    let errors = (0..1_000).map(|_| Err(ErrorKind::Disconnected));
    let script = readings.chain(errors).collect();
    let remarks = Remarks::default();
    let ((), halts) = reading_for(script, &remarks, |_, supervisor| {
        supervisor.lock().asks(true);
        std::thread::sleep(Duration::from_millis(600));
        if is_answered {
            supervisor.lock().asks(false);
            std::thread::sleep(Duration::from_millis(200));
        }
    });
    (halts, remarks.0.into_inner().expect("whole"))
}

#[test]
fn a_force_that_is_lost_while_a_question_stands_halts_once_and_is_remarked_once() {
    let (halts, remarks) = lost_at_a_question(false);
    assert_eq!((halts, remarks.len()), (1, 1), "{remarks:?}");
    assert!(remarks[0].contains("the force is lost: test/force"));
}

#[test]
fn a_force_that_is_still_lost_after_the_answer_halts_again() {
    let (halts, remarks) = lost_at_a_question(true);
    assert!(halts > 1, "{halts}");
    assert_eq!(remarks.len(), 1, "{remarks:?}");
}

#[test]
fn a_force_that_is_lost_at_a_question_is_remarked_once() {
    let remarks = Remarks::default();
    let ((), halts) = reading_for(vec![Ok(0.1)], &remarks, |_, supervisor| {
        supervisor.lock().asks(true);
        std::thread::sleep(Duration::from_millis(1_500));
    });
    let remarks = remarks.0.into_inner().expect("whole");
    assert_eq!((halts, remarks.len()), (1, 1), "{remarks:?}");
}
