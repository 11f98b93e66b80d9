//! Guarantees of sensors: frames, lighting, interrupts and errors.

#![expect(unsafe_code, reason = "the tables of a plugin are called")]

use std::thread;
use std::time::{Duration, Instant};

use taceva_plugin::abi::ext::{SENSOR_LIGHTING, SensorLightingCalls};
use taceva_plugin::abi::{
    FRAME_NUMBERED, LIGHTING_FACTORY, PixelFormat, SENSOR_FACTORY, SensorCalls, Status, Text,
};

use super::{AT_ONCE, SECOND};
use crate::fake_host::{Open, ended};
use crate::places::frame;

#[test]
fn a_frame_is_written_into_the_buffer_of_the_host() {
    let sensor = Open::new(SENSOR_FACTORY, "well");
    let calls = sensor.calls::<SensorCalls>();
    let mut bytes = [0; 40];
    let mut frame = frame(&mut bytes);
    // SAFETY: the frame and its buffer live for the call.
    let (status, message) = ended(|error| unsafe {
        calls.start.expect("a function")(sensor.handle(), SECOND, error);
        calls.capture.expect("a function")(sensor.handle(), &raw mut frame, SECOND, error)
    });
    assert_eq!((status, message.as_str()), (Status::OK, ""));
    assert_eq!(
        (frame.width, frame.height, frame.format),
        (4, 3, PixelFormat::RGB8)
    );
    assert_eq!(
        (frame.length, frame.stamp.valid_ns, frame.stamp.received_ns),
        (36, 1_500_000_000, 0)
    );
    assert_eq!((frame.sequence, frame.flags), (1, 0), "frames are counted");
    assert!(frame.release.is_none() && std::ptr::eq(frame.data, frame.buffer));
    assert_eq!(
        (bytes[35], bytes[36]),
        (1, 0),
        "no byte beyond the frame is touched"
    );
}

#[test]
fn a_frame_has_the_number_that_its_device_gave_it() {
    let sensor = Open::new(SENSOR_FACTORY, "numbered");
    let calls = sensor.calls::<SensorCalls>();
    for number in [42, 44] {
        let mut bytes = [0; 36];
        let mut frame = frame(&mut bytes);
        // SAFETY: the frame and its buffer live for the call.
        let (status, _) = ended(|error| unsafe {
            calls.start.expect("a function")(sensor.handle(), SECOND, error);
            calls.capture.expect("a function")(sensor.handle(), &raw mut frame, SECOND, error)
        });
        assert_eq!(status, Status::OK);
        assert_eq!((frame.sequence, frame.flags), (number, FRAME_NUMBERED));
    }
}

#[test]
fn the_light_of_a_sensor_is_an_ability_that_some_have() {
    let lit = Open::new(SENSOR_FACTORY, "well");
    let light = lit
        .extension::<SensorLightingCalls>(SENSOR_LIGHTING)
        .expect("it can");
    let set = |scene: &str| {
        // SAFETY: the text lives for the call.
        ended(|error| unsafe {
            light.set.expect("a function")(lit.handle(), Text::from(scene), SECOND, error)
        })
    };
    assert_eq!(set("room").0, Status::OK);
    assert_eq!(
        set("moon"),
        (
            Status::INVALID_ARGUMENT,
            "cannot do it: no scene moon".to_owned()
        )
    );
    assert!(
        Open::new(SENSOR_FACTORY, "block")
            .extension::<SensorLightingCalls>(SENSOR_LIGHTING)
            .is_none()
    );
}

#[test]
fn an_interrupt_ends_a_blocked_capture_and_leaves_the_sensor_usable() {
    let sensor = Open::new(SENSOR_FACTORY, "block");
    let calls = sensor.calls::<SensorCalls>();
    let capture = |timeout_ns| {
        let mut bytes = [0; 36];
        let mut frame = frame(&mut bytes);
        // SAFETY: the frame and its buffer live for the call.
        ended(|error| unsafe {
            calls.capture.expect("a function")(sensor.handle(), &raw mut frame, timeout_ns, error)
        })
    };
    sensor.interrupt();
    assert_eq!(
        capture(1_000_000).0,
        Status::TIMEOUT,
        "an interrupt of nothing is none of the next call"
    );
    let interrupted = thread::scope(|scope| {
        let blocked = scope.spawn(|| (capture(60 * SECOND), Instant::now()));
        thread::sleep(Duration::from_millis(20));
        let asked = Instant::now();
        sensor.interrupt();
        let (ended, at) = blocked.join().expect("it answers");
        assert!(at - asked < AT_ONCE, "{:?}", at - asked);
        ended
    });
    assert_eq!(
        interrupted,
        (
            Status::INTERRUPTED,
            "cannot do it: it was interrupted".to_owned()
        )
    );
    assert_eq!(capture(1_000_000).0, Status::TIMEOUT);
}

#[test]
fn the_error_of_a_driver_keeps_its_kind_and_its_reason() {
    let sensor = Open::new(SENSOR_FACTORY, "refuse");
    let mut bytes = [0; 36];
    let mut frame = frame(&mut bytes);
    // SAFETY: the frame and its buffer live for the call.
    let ended = ended(|error| unsafe {
        sensor.calls::<SensorCalls>().capture.expect("a function")(
            sensor.handle(),
            &raw mut frame,
            SECOND,
            error,
        )
    });
    assert_eq!(
        ended,
        (
            Status::DISCONNECTED,
            "cannot do it: the cable is out".to_owned()
        )
    );
    let refused = Open::in_rig(LIGHTING_FACTORY, "well", std::ptr::null_mut()).err();
    assert_eq!(
        refused,
        Some((
            Status::PERMISSION_DENIED,
            "cannot do it: not for you".to_owned()
        ))
    );
}
