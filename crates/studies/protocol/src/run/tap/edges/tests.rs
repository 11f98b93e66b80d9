use super::*;

const CONTACT_MM: f64 = 0.1;
const DEPTH_MM: f64 = 0.4;
const LEAD_MM: f64 = 0.5;
/// Time at which the tip starts to move, in s.
const SETS_OUT_S: f64 = 0.15;
const LASTS_S: f64 = 0.6;

/// Test rig that presses a gel. Force and frames are delayed, with noise that depends on the number of the tap.
#[derive(Clone, Copy)]
struct Rig {
    force_late_s: f64,
    frame_late_s: f64,
    frame_hz: f64,
    /// Greatest shift of the signal edges of a tap, at random, in s.
    shaken_s: f64,
    /// Change of brightness that the touch causes in a part of the frame, in steps of an 8-bit pixel.
    shade: f64,
}

const RIG: Rig = Rig {
    force_late_s: 0.0123,
    frame_late_s: 0.0381,
    frame_hz: 60.0,
    shaken_s: 0.0,
    shade: 20.0,
};

/// A pseudo-random number from −1 to 1 for each pair of `tap` and `place`.
fn noise(tap: u32, place: u32) -> f64 {
    let mixed = (tap * 7919 + place + 1)
        .wrapping_mul(2_654_435_761)
        .rotate_left(9)
        >> 8;
    f64::from(mixed % 2001) / 1000.0 - 1.0
}

impl Rig {
    fn tap(&self, number: u32) -> TapHeard {
        let speed = if number.is_multiple_of(2) { 4.5 } else { 1.5 };
        let way_mm = LEAD_MM + DEPTH_MM;
        let over_s = SETS_OUT_S + way_mm / speed + LASTS_S;
        let height_mm = |at_s: f64| {
            let gone = ((at_s - SETS_OUT_S) * speed).clamp(0.0, way_mm);
            CONTACT_MM - LEAD_MM + gone
        };
        let pressed = |at_s: f64| ((height_mm(at_s) - CONTACT_MM).max(0.0) / DEPTH_MM).powf(1.5);
        let shaken_s = self.shaken_s * noise(number, 0);
        let times = |rate_hz: f64| {
            let phase = (noise(number, 1) + 1.0) / 2.0;
            (0_u32..)
                .map(move |place| (place, (f64::from(place) + phase) / rate_hz))
                .take_while(move |(_, at_s)| *at_s < over_s)
        };
        let heights = times(100.0)
            .map(|(place, at_s)| (at_s, height_mm(at_s) + 0.002 * noise(number, place)));
        let forces = times(200.0).map(|(place, at_s)| {
            let force = 0.3 * pressed(at_s - self.force_late_s - shaken_s);
            (
                at_s,
                vec![0.0, 0.0, 0.2 + force + 0.001 * noise(number, place)],
            )
        });
        let frames = times(self.frame_hz).map(|(place, at_s)| {
            // Another part of the gel changes later, and more.
            let pressed = pressed(at_s - self.frame_late_s - shaken_s);
            let hiss = 0.3 * noise(number, place + 77);
            let shades = [
                100.0 - self.shade * pressed,
                80.0 + self.shade * pressed.powi(2),
            ];
            (at_s, vec![shades[0] + hiss, shades[1] - hiss, 50.0 + hiss])
        });
        TapHeard {
            heights: heights.collect(),
            forces: forces.collect(),
            frames: frames.collect(),
        }
    }

    fn tapped(&self, taps: u32) -> Tapped {
        let mut tapped = Tapped::new(CONTACT_MM, CONTACT_MM + DEPTH_MM / 2.0);
        for number in 0..taps {
            tapped.add(self.tap(number));
        }
        tapped
    }
}

#[test]
fn twenty_taps_find_the_latency_of_each_device_to_a_millisecond_or_two() {
    let tapped = RIG.tapped(20);
    assert_eq!(tapped.count(), 20);
    let (force, sensor) = tapped.latencies().expect("clear edges");
    // Readings come every 5 ms and frames every 17 ms; the edge between two of them is a straight line.
    assert!((force.after_robot_ms - 12.3).abs() < 1.0, "{force:?}");
    assert!((sensor.after_robot_ms - 38.1).abs() < 2.0, "{sensor:?}");
    for latency in [force, sensor] {
        assert!(
            latency.error_ms < 2.0 && latency.spread_ms < 8.0,
            "{latency:?}"
        );
    }
}

#[test]
fn a_device_that_is_earlier_than_the_robot_has_a_latency_below_nothing() {
    let early = Rig {
        force_late_s: -0.006,
        ..RIG
    };
    let (force, _) = early.tapped(20).latencies().expect("clear edges");
    assert!((force.after_robot_ms + 6.0).abs() < 1.0, "{force:?}");
}

#[test]
fn a_spread_over_half_a_frame_is_refused_with_both_numbers() {
    let shaken = Rig {
        shaken_s: 0.02,
        ..RIG
    };
    let error = shaken.tapped(20).latencies().expect_err("it jumps about");
    let TapError::Spread {
        device: "force",
        spread_ms,
        allowed_ms,
    } = error
    else {
        panic!("{error}");
    };
    assert!(
        spread_ms > allowed_ms && (allowed_ms - 8.33).abs() < 0.1,
        "{error}"
    );
    assert!(
        error
            .to_string()
            .contains("expected at most half a frame, 8.3 ms"),
        "{error}"
    );
}

#[test]
fn what_does_not_show_the_tap_is_named() {
    let dark = Rig { shade: 0.0, ..RIG };
    let error = dark.tapped(20).latencies().expect_err("nothing is seen");
    assert!(
        matches!(
            error,
            TapError::Unclear {
                device: "sensor",
                ..
            }
        ),
        "{error}"
    );
    let slow = Rig {
        frame_hz: 2.0,
        ..RIG
    };
    let error = slow.tapped(20).latencies().expect_err("hardly a frame");
    assert!(
        matches!(
            error,
            TapError::Few {
                device: "sensor",
                ..
            }
        ),
        "{error}"
    );
    let late = Rig {
        frame_late_s: 0.55,
        ..RIG
    };
    let error = late.tapped(20).latencies().expect_err("not seen yet");
    let is_late = matches!(
        error,
        TapError::Late {
            device: "sensor",
            ..
        }
    );
    let is_unclear = matches!(
        error,
        TapError::Unclear {
            device: "sensor",
            ..
        }
    );
    assert!(is_late || is_unclear, "{error}");
}

#[test]
fn a_robot_that_is_not_heard_or_keeps_one_speed_is_refused() {
    let mut deaf = RIG.tapped(20);
    for tap in &mut deaf.taps[4..10] {
        tap.heights.clear();
    }
    let error = deaf.latencies().expect_err("no poses");
    assert!(
        matches!(
            error,
            TapError::Few {
                tap: 5,
                device: "robot",
                count: 0,
                ..
            }
        ),
        "{error}"
    );
    let mut level = Tapped::new(CONTACT_MM, CONTACT_MM + DEPTH_MM / 2.0);
    for _ in 0..20 {
        level.add(RIG.tap(0));
    }
    let error = level.latencies().expect_err("one speed");
    assert!(matches!(error, TapError::OneSpeed { .. }), "{error}");
    let nothing = Tapped::new(0.0, 0.1).latencies().expect_err("no taps");
    assert!(matches!(nothing, TapError::OneSpeed { .. }), "{nothing}");
}

#[test]
fn a_quarter_of_the_taps_may_be_unclear_and_is_left_out() {
    let mut tapped = RIG.tapped(20);
    let (all, _) = tapped.latencies().expect("clear edges");
    for tap in &mut tapped.taps[..5] {
        tap.frames.clear();
    }
    let (force, _) = tapped.latencies().expect("15 clear taps");
    assert!(
        (force.after_robot_ms - all.after_robot_ms).abs() < 1.0,
        "{force:?}"
    );
    assert_eq!(tapped.dropped().len(), 5);
    tapped.taps[5].frames.clear();
    let error = tapped.latencies().expect_err("14 of 20");
    assert!(matches!(error, TapError::Few { tap: 1, .. }), "{error}");
}

#[test]
fn late_taps_are_counted_and_more_than_a_fifth_are_refused_though_a_quarter_may_be_unclear() {
    // Frames of a late tap go on changing while the tip rests.
    let late = |tap: &mut TapHeard| {
        let end_s = tap.frames.last().expect("frames").0;
        for (at_s, shades) in &mut tap.frames {
            let rests_s = (*at_s - end_s + REST_S).max(0.0);
            *shades = vec![rests_s / REST_S; 3];
        }
    };
    let mut tapped = RIG.tapped(20);
    assert_eq!(tapped.late(), 0);
    tapped.taps[..4].iter_mut().for_each(late);
    assert_eq!(tapped.late(), 4);
    tapped.latencies().expect("16 clear taps");
    late(&mut tapped.taps[4]);
    let error = tapped.latencies().expect_err("a quarter is late");
    let expected = TapError::MostlyLate { late: 5, taps: 20 };
    assert_eq!(error, expected);
    let words = error.to_string();
    assert!(
        words.contains("5 of 20 taps were left out as late"),
        "{words}"
    );
}
