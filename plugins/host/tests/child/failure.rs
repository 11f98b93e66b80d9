//! A failing child affects only its own devices, and the error describes the failure.

use std::error::Error;
use std::time::{Duration, Instant};

use taceva_core::{ArgSpec, Args, DriverError, ErrorKind, FrameMut, Sensor};
use taceva_host::{ChildError, Fate, Patience, Session};

use crate::runner::Test;
use crate::{LONG, child, odd};

pub(crate) const TESTS: &[Test] = &[
    (
        "a_panic_ends_its_own_device_and_no_other",
        a_panic_ends_its_own_device_and_no_other,
    ),
    (
        "an_exit_and_an_abort_say_so_to_every_device_of_the_child",
        an_exit_and_an_abort_say_so_to_every_device_of_the_child,
    ),
    (
        "a_call_that_hangs_is_ended_after_its_time",
        a_call_that_hangs_is_ended_after_its_time,
    ),
    (
        "a_child_that_is_killed_amid_frames_is_seen_within_50_ms",
        a_child_that_is_killed_amid_frames_is_seen_within_50_ms,
    ),
    (
        "a_time_that_is_none_is_a_fault_of_the_device",
        a_time_that_is_none_is_a_fault_of_the_device,
    ),
    (
        "a_child_outlives_the_thread_that_started_it_and_ends_with_its_last_device",
        a_child_outlives_the_thread_that_started_it_and_ends_with_its_last_device,
    ),
];

fn sensor(session: &dyn Session, does: &str) -> Box<dyn Sensor> {
    let specs = [ArgSpec::text("does")];
    let args = Args::parse(&specs, &format!("does={does}")).expect("sound");
    session.sensor(&odd::SENSOR, &args).expect("a sensor")
}

fn capture(sensor: &mut dyn Sensor) -> Result<u8, DriverError> {
    let mut bytes = vec![0; odd::FRAME.byte_len().expect("small")];
    let into = FrameMut::new(odd::FRAME, &mut bytes).expect("fits");
    sensor.capture(into, LONG)?;
    assert!(bytes.iter().all(|byte| *byte == bytes[0]), "a torn frame");
    Ok(bytes[0])
}

fn fate(error: &DriverError) -> Fate {
    let source = error.source().and_then(|source| source.downcast_ref());
    match source {
        Some(ChildError::Gone { fate, .. }) => fate.clone(),
        other => panic!("{error}: {other:?}"),
    }
}

fn a_panic_ends_its_own_device_and_no_other() {
    let session = child(Patience::default());
    let (mut bad, mut good) = (sensor(&session, "panics"), sensor(&session, "counts"));
    let error = capture(&mut *bad).expect_err("a panic");
    assert_eq!(error.kind(), ErrorKind::Panicked);
    assert!(error.to_string().contains("the lens fell off"), "{error}");
    let again = capture(&mut *bad).expect_err("dead");
    assert_eq!(again.kind(), ErrorKind::Panicked);
    assert_eq!(capture(&mut *good).expect("unharmed"), 1);
}

fn an_exit_and_an_abort_say_so_to_every_device_of_the_child() {
    for (does, expected) in [
        ("exits", Fate::Exited { code: 3 }),
        ("aborts", Fate::Signalled { signal: 6 }),
    ] {
        let session = child(Patience::default());
        let mut unharmed = sensor(&session, "counts");
        let other = child(Patience::default());
        let mut elsewhere = sensor(&other, "counts");
        let mut bad = sensor(&session, does);
        let error = capture(&mut *bad).expect_err(does);
        assert_eq!(error.kind(), ErrorKind::Disconnected);
        assert_eq!(fate(&error), expected);
        let beside = capture(&mut *unharmed).expect_err("its process is gone");
        assert_eq!(fate(&beside), expected);
        assert_eq!(session.child().fate(), Some(expected));
        assert_eq!(capture(&mut *elsewhere).expect("another process"), 1);
        let late = session.sensor(&odd::SENSOR, &Args::default());
        assert_eq!(
            late.map(drop).expect_err("gone").kind(),
            ErrorKind::Disconnected
        );
    }
}

fn a_call_that_hangs_is_ended_after_its_time() {
    let patience = Patience {
        grace: Duration::from_millis(200),
        ..Patience::default()
    };
    let session = child(patience);
    let mut hanging = sensor(&session, "hangs");
    let began = Instant::now();
    let mut bytes = vec![0; odd::FRAME.byte_len().expect("small")];
    let into = FrameMut::new(odd::FRAME, &mut bytes).expect("fits");
    let deadline = taceva_core::Deadline::after(Duration::from_millis(100));
    let error = hanging.capture(into, deadline).expect_err("it hangs");
    let took = began.elapsed();
    assert_eq!(
        fate(&error),
        Fate::Late {
            doing: "capture a frame".to_owned(),
            after: Duration::from_millis(300),
        }
    );
    assert!((300..400).contains(&took.as_millis()), "{took:?}");
}

fn a_child_that_is_killed_amid_frames_is_seen_within_50_ms() {
    let session = child(Patience::default());
    let mut counting = sensor(&session, "counts");
    let process = i32::try_from(session.child().process()).expect("a number");
    let killer = std::thread::spawn(move || {
        std::thread::sleep(Duration::from_millis(20));
        let now = Instant::now();
        let process = rustix::process::Pid::from_raw(process).expect("a process");
        rustix::process::kill_process(process, rustix::process::Signal::KILL).expect("killed");
        now
    });
    let mut frames = 0;
    let error = loop {
        match capture(&mut *counting) {
            Ok(_) => frames += 1,
            // The counter of this sensor is one byte. An overflow would panic and give another error.
            Err(error) => break error,
        }
        if frames == 250 {
            counting = sensor(&session, "counts");
            frames = 0;
        }
    };
    let seen = killer.join().expect("whole").elapsed();
    assert_eq!(fate(&error), Fate::Signalled { signal: 9 });
    assert!(!fate(&error).is_its_own_fault());
    assert!(seen < Duration::from_millis(50), "{seen:?}");
}

fn a_time_that_is_none_is_a_fault_of_the_device() {
    let session = child(Patience::default());
    let error = capture(&mut *sensor(&session, "lies")).expect_err("NaN");
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    assert!(error.to_string().contains("NaN"), "{error}");
    assert_eq!(session.child().fate(), None);
}

fn a_child_outlives_the_thread_that_started_it_and_ends_with_its_last_device() {
    let (session, mut counting) = std::thread::spawn(|| {
        let session = child(Patience::default());
        let counting = sensor(&session, "counts");
        (session, counting)
    })
    .join()
    .expect("whole");
    let process = session.child().process();
    drop(session);
    assert_eq!(capture(&mut *counting).expect("it lives"), 1);
    let interrupt = counting.interrupt_handle().expect("a handle");
    drop(counting);
    let gone = !std::path::Path::new(&format!("/proc/{process}")).exists();
    assert!(gone, "the process {process} is still there");
    interrupt.interrupt();
}
