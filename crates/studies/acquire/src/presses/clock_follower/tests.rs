use super::*;

/// Period of the frames, s. The least delay from a stamp to the arrival is [`LEAST_S`], s.
const PERIOD_S: f64 = 0.04;
const LEAST_S: f64 = 0.012;

/// Reproducible delay of frame `number` in addition to [`LEAST_S`], s: about none for one frame in five, and up to 8 ms for the others.
fn delay_s(number: u32) -> f64 {
    match number % 5 {
        0 => 1e-5 * f64::from(number * 7919 % 13),
        _ => 1e-3 * f64::from(number * 7919 % 9),
    }
}

/// Simulated camera that sends frames to a clock follower.
struct Session {
    follower: ClockFollower,
    number: u32,
    /// Time of the camera's clock minus the true time, s.
    ahead_s: f64,
}

impl Session {
    fn begun() -> Session {
        Session {
            follower: ClockFollower::default(),
            number: 0,
            ahead_s: 0.0,
        }
    }

    /// Sends frames for `lasts_s`, s, while the clock drifts by `ppm`. Every frame is delayed by an additional `extra_s`, s. Returns the errors of
    /// the corrected stamps.
    fn take(&mut self, lasts_s: f64, ppm: f64, extra_s: f64) -> Errors {
        let (mut errors, mut last_s) = (Vec::new(), f64::NEG_INFINITY);
        let mut left_s = lasts_s;
        while left_s > 0.0 {
            left_s -= PERIOD_S;
            self.number += 1;
            self.ahead_s += PERIOD_S * ppm * 1e-6;
            let true_s = 100.0 + PERIOD_S * f64::from(self.number);
            let received_s = true_s + LEAST_S + delay_s(self.number) + extra_s;
            let stamp = Stamp {
                valid_s: true_s + self.ahead_s,
                received_s: Some(received_s),
            };
            let followed = self.follower.follow(stamp, received_s);
            assert_eq!(followed.received_s, stamp.received_s);
            assert!(followed.valid_s > last_s, "stamps keep their order");
            last_s = followed.valid_s;
            errors.push(followed.valid_s - true_s);
        }
        Errors {
            last_s: *errors.last().expect("frames"),
            greatest_s: errors
                .iter()
                .fold(0.0_f64, |most, error| most.max(error.abs())),
        }
    }

    /// Drift that a recording states, and its standard uncertainty, ppm.
    fn stated(&self) -> [f64; 2] {
        let settings = self.follower.settings();
        [DRIFT, DRIFT_U].map(|name| settings[name].parse().expect("a number"))
    }
}

/// Last and greatest error of the corrected stamps, s.
struct Errors {
    last_s: f64,
    greatest_s: f64,
}

#[test]
fn a_clock_that_drifts_by_200_ppm_for_an_hour_is_followed_to_a_millisecond() {
    for ppm in [200.0, -200.0] {
        let mut session = Session::begun();
        let errors = session.take(3600.0, ppm, 0.0);
        assert!(
            (session.ahead_s - ppm * 3600e-6).abs() < 1e-4,
            "0.72 s by itself"
        );
        assert!(errors.greatest_s < 1e-3, "{ppm}: {}", errors.greatest_s);
        let [drift, u] = session.stated();
        assert!(
            (drift - ppm).abs() < 3.0 * u.max(0.5),
            "{drift} ± {u}, {ppm}"
        );
    }
}

#[test]
fn a_clock_that_warms_up_is_followed_although_its_rate_changes() {
    let mut session = Session::begun();
    for ppm in [0.0, 40.0, 80.0, 100.0, 110.0] {
        session.take(300.0, ppm, 0.0);
    }
    let errors = session.take(600.0, 115.0, 0.0);
    assert!(errors.greatest_s < 2e-3, "{}", errors.greatest_s);
    let [drift, _] = session.stated();
    assert!((drift - 115.0).abs() < 2.0, "{drift}");
}

#[test]
fn stamps_of_a_clock_that_keeps_time_stay_as_they_are() {
    let mut session = Session::begun();
    let errors = session.take(1200.0, 0.0, 0.0);
    assert!(errors.greatest_s < 2e-4, "{}", errors.greatest_s);
    let [drift, u] = session.stated();
    assert!(drift.abs() <= 3.0 * u.max(0.1), "{drift} ± {u}");
    let mut exact = ClockFollower::default();
    for number in 0..1000_u32 {
        let stamp = Stamp {
            valid_s: 0.5 * f64::from(number),
            received_s: None,
        };
        let now_s = stamp.valid_s;
        assert_eq!(exact.follow(stamp, now_s), stamp);
    }
}

#[test]
fn minutes_in_which_every_frame_is_late_do_not_move_the_clock() {
    let mut session = Session::begun();
    session.take(200.0, 50.0, 0.0);
    let late = session.take(20.0, 50.0, 0.05);
    assert!(late.greatest_s < 2e-3, "{}", late.greatest_s);
    let after = session.take(200.0, 50.0, 0.0);
    assert!(after.last_s.abs() < 1e-3, "{}", after.last_s);
}

#[test]
fn a_change_faster_than_an_oscillator_is_not_followed_and_is_stated() {
    let mut session = Session::begun();
    let errors = session.take(20.0, 5000.0, 0.0);
    assert!((errors.last_s - 0.1).abs() < 1e-3, "{}", errors.last_s);
    let [drift, _] = session.stated();
    assert!((drift - 5000.0).abs() < 50.0, "{drift}");
}

#[test]
fn a_drift_of_a_few_noisy_frames_is_not_continued_through_a_long_pause() {
    let mut follower = ClockFollower::default();
    let mut number = 0_u32;
    let mut greatest_s: f64 = 0.0;
    for begun_s in [100.0, 704.0] {
        for place in 0..125_u32 {
            number += 1;
            let passed_s = PERIOD_S * f64::from(place);
            // Delays grow as a queue fills, and look like a drift of 600 ppm.
            let grown_s = if begun_s < 700.0 {
                6e-4 * passed_s
            } else {
                2e-3
            };
            let delay_s = grown_s + 1e-4 * f64::from(number / 7 * 37 % 11);
            let true_s = begun_s + passed_s;
            let stamp = Stamp {
                valid_s: true_s,
                received_s: Some(true_s + delay_s),
            };
            let followed = follower.follow(stamp, true_s + delay_s);
            greatest_s = greatest_s.max((followed.valid_s - true_s).abs());
        }
    }
    assert!(follower.anchor_s.is_some(), "a drift was followed");
    // Continued, it would be 0.36 s.
    assert!(greatest_s < 0.05, "{greatest_s}");
}

#[test]
fn too_few_frames_state_no_drift_and_only_a_drift_is_kept_later() {
    let mut session = Session::begun();
    session.take(1.0, 200.0, 0.0);
    assert!(session.follower.settings().is_empty());
    session.take(60.0, 200.0, 0.0);
    let mut settings = session.follower.settings();
    settings.insert("exposure_ms".to_owned(), "15".to_owned());
    let kept = measured_settings(settings);
    let names: Vec<&str> = kept.keys().map(String::as_str).collect();
    assert_eq!(names, [DRIFT, DRIFT_U]);
}
