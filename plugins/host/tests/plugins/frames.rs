//! Frames of a plugin's sensor: their pixels and their numbers.

use taceva_core::{ErrorKind, Sensor};

use crate::devices::{SECOND, capture, eye};
use crate::fixture::Fixture;

#[test]
fn frames_are_copied_or_lent_and_the_same() {
    for lends in [None, Some("LEND")] {
        let macros: Vec<&str> = lends.into_iter().collect();
        let Some(fixture) = Fixture::built(&macros) else {
            return;
        };
        let mut eye = eye(&fixture);
        eye.start(SECOND).expect("starts");
        assert_eq!(capture(&mut eye).expect("a frame"), vec![5; 8 * 6 * 3]);
        let (sum, sequence) = eye
            .lend(SECOND, |frame| {
                let sum: u32 = frame.bytes.iter().copied().map(u32::from).sum();
                (sum, frame.sequence)
            })
            .expect("a frame");
        assert_eq!(
            (sequence, lends.is_none() || sum == 5 * 8 * 6 * 3),
            (2, true)
        );
        let lighting = eye.lighting().expect("it can set the light");
        assert_eq!(lighting.scenes(), ["dark", "room"]);
        lighting.set("room", SECOND).expect("a scene");
        let error = lighting.set("beach", SECOND).expect_err("none");
        assert_eq!(error.kind(), ErrorKind::InvalidArgument);
        assert_eq!(capture(&mut eye).expect("a frame")[0], 9);
    }
}

#[test]
fn frames_have_the_numbers_that_the_device_gave_them_and_none_where_it_gives_none() {
    let flagged = "FRAME_FLAGS=(TACEVA_FRAME_NUMBERED|TACEVA_FRAME_DROPPED)";
    for (macros, expected) in [
        // Two frames are lost after each.
        (
            &["FRAME_FLAGS=TACEVA_FRAME_NUMBERED", "FRAME_STEP=3"][..],
            [Some(3), Some(6), Some(9)],
        ),
        // The device flags a loss before each frame, and its numbers have no gap.
        (&[flagged, "FRAME_STEP=1"][..], [Some(1), Some(3), Some(5)]),
        (&[][..], [None; 3]),
    ] {
        let Some(fixture) = Fixture::built(macros) else {
            return;
        };
        let mut eye = eye(&fixture);
        eye.start(SECOND).expect("starts");
        let numbers = [(); 3].map(|()| {
            capture(&mut eye).expect("a frame");
            eye.sequence()
        });
        assert_eq!(numbers, expected, "{macros:?}");
    }
}
