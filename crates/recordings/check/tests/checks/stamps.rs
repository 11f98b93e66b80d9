//! Tests of missing frames, clocks of several units, and clocks that jump.

use taceva_check::{CheckReport, Severity};
use taceva_core::{Clock, Stamp};

use super::streams::{message, regular, says_nothing, stamped};
use super::{Recording, SAMPLES, codes, found};

/// Report on a recording with the time stamps `time` and without contact points.
fn without_points(time: impl Fn(u32) -> f64) -> CheckReport {
    stamped(time, |recording| {
        for sample in &mut recording.samples {
            sample.point_id = None;
        }
    })
}

#[track_caller]
fn starts(report: &CheckReport, code: &str, expected: &str) {
    let found = message(report, code);
    assert!(found.starts_with(expected), "{found}");
}

#[track_caller]
fn has_no_warning_of_times(report: &CheckReport) {
    let times = ["TAC008", "TAC023", "TAC024"];
    assert!(
        codes(report)
            .iter()
            .all(|(code, severity)| !times.contains(code) || *severity == Severity::Note),
        "{:#?}",
        report.findings
    );
}

#[test]
fn every_fourth_and_every_third_frame_that_is_dropped_is_missing_and_the_rate_has_gaps() {
    for (often, missing) in [(3, 66), (2, 99)] {
        let report = stamped(|number| regular(number + number / often), |_| {});
        starts(
            &report,
            "TAC023",
            &format!(
                "{missing} frames seem to be missing in {missing} of 199 steps, which are up to 2 times the period of 0.0310 s"
            ),
        );
        let rate = message(&report, "TAC008");
        assert!(!rate.contains("without gaps"), "{rate}");
        let frames = format!("; {missing} frames seem to be missing");
        assert!(rate.ends_with(&frames), "{rate}");
    }
}

#[test]
fn three_in_ten_frames_that_are_dropped_at_random_are_missing() {
    let is_kept = |number: &u32| {
        let number = number.wrapping_mul(2_654_435_761).rotate_left(13);
        number % 10 >= 3
    };
    let kept: Vec<u32> = (0..).filter(is_kept).take(200).collect();
    let at = |number: u32| kept[usize::try_from(number).expect("small")];
    let missing = at(SAMPLES - 1) - at(0) - (SAMPLES - 1);
    let report = stamped(|number| regular(at(number)), |_| {});
    starts(
        &report,
        "TAC023",
        &format!("{missing} frames seem to be missing in "),
    );
    assert!(!message(&report, "TAC008").contains("without gaps"));
}

#[test]
fn one_dropped_frame_is_said_in_the_singular_and_leaves_a_gap() {
    let report = stamped(|number| regular(number + u32::from(number >= 90)), |_| {});
    assert_eq!(
        message(&report, "TAC023"),
        "1 frame seems to be missing in 1 of 199 steps, which is 2 times the period of 0.0310 s"
    );
    assert_eq!(
        message(&report, "TAC008"),
        "32.2581 Hz from the median step of 0.0310 s; 1 frame seems to be missing"
    );
}

#[test]
fn steps_that_are_no_multiples_of_a_period_miss_no_frame_and_have_a_median_and_a_mean() {
    let report = stamped(
        |number| 0.007 + 0.066 * f64::from(number / 2) + 0.02 * f64::from(number % 2),
        |_| {},
    );
    says_nothing(&report, "TAC023");
    starts(
        &report,
        "TAC008",
        "50.0000 Hz from the median step of 0.0200 s, 30.",
    );
    assert!(!message(&report, "TAC008").contains("without gaps"));
    // Stamps that come up to 12 ms late.
    let uneven = |number: u32| regular(number) + 0.001 * f64::from(number * 7919 % 13);
    has_no_warning_of_times(&stamped(uneven, |_| {}));
}

#[test]
fn a_time_stamp_that_is_doubled_once_is_repeated_and_no_frame_is_missing() {
    let report = stamped(|number| regular(number - u32::from(number == 60)), |_| {});
    says_nothing(&report, "TAC023");
    assert!(
        report
            .findings
            .iter()
            .any(|finding| finding.message == "1 sample has the same time as the previous sample"),
        "{:#?}",
        report.findings
    );
}

#[test]
fn two_units_in_turn_have_a_clock_each() {
    let in_turn = |time: fn(u32) -> f64| {
        stamped(time, |recording| {
            for (number, sample) in (0_u32..).zip(&mut recording.samples) {
                sample.unit_id = Some(format!("u{}", number % 2));
            }
        })
    };
    let report = in_turn(|number| regular(number / 2));
    has_no_warning_of_times(&report);
    assert_eq!(
        message(&report, "TAC008"),
        "32.2581 Hz from the median step of 0.0310 s, without gaps"
    );
    // Frames missing in one unit are still found.
    let report = in_turn(|number| {
        let misses = number % 2 == 1 && number > 100;
        regular(number / 2 + u32::from(misses))
    });
    starts(&report, "TAC023", "1 frame seems to be missing");
}

#[test]
fn units_of_different_months_have_one_kind_of_clock_and_units_since_1970_and_since_a_start_two() {
    let in_turn = |clock: Clock, of_second: f64| {
        stamped(
            |number| {
                let begin = [1.6e9, of_second][usize::from(number % 2 == 1)];
                begin + regular(number / 2)
            },
            |recording| {
                recording.clock = clock;
                for (number, sample) in (0_u32..).zip(&mut recording.samples) {
                    sample.unit_id = Some(format!("u{}", number % 2));
                }
            },
        )
    };
    says_nothing(&in_turn(Clock::Unix, 1.65e9), "TAC024");
    let two = in_turn(Clock::Unknown, 20.0);
    starts(
        &two,
        "TAC024",
        "two clocks in one column: some tables or units have stamps since 1970",
    );
    // The stamps of one unit are no Unix times, however late those of the other are.
    let stated = in_turn(Clock::Unix, 20.0);
    assert!(
        stated
            .findings
            .iter()
            .any(|finding| finding.message.contains("is before 1990")),
        "{:#?}",
        stated.findings
    );
}

#[test]
fn a_clock_that_jumps_ahead_without_contact_points_is_noticed() {
    for (jump, longest) in [(5.0, "5.031"), (3600.0, "3600.031")] {
        let report =
            without_points(|number| regular(number) + if number < 80 { 0.0 } else { jump });
        starts(
            &report,
            "TAC024",
            &format!(
                "1 step between samples without contact points is over 100 times the usual step of 0.0310 s, {longest} s: "
            ),
        );
    }
}

#[test]
fn pauses_between_presses_scenes_and_contact_points_are_no_jumps_of_a_clock() {
    let pauses = |number: u32| regular(number) + 10.0 * f64::from(number / 20);
    says_nothing(&without_points(pauses), "TAC024");
    let once = |number: u32| regular(number) + 10.0 * f64::from(number / 100);
    let scenes = stamped(once, |recording| {
        for (number, sample) in (0_u32..).zip(&mut recording.samples) {
            sample.point_id = None;
            sample.scene_id = Some(format!("scene {}", number / 100));
        }
    });
    says_nothing(&scenes, "TAC024");
    let points = stamped(once, |recording| {
        for (number, sample) in (0_u32..).zip(&mut recording.samples) {
            sample.point_id = Some(format!("p{}", number / 100));
        }
    });
    says_nothing(&points, "TAC024");
}

#[test]
fn times_that_repeat_run_backwards_or_are_whole_seconds_are_noticed() {
    let with_times = |time: fn(u32) -> f64| {
        let mut recording = Recording::sound();
        for (number, sample) in (0..).zip(&mut recording.samples) {
            sample.stamp = Some(Stamp {
                valid_s: time(number),
                received_s: None,
            });
        }
        recording
    };
    found(
        with_times(|number| f64::from(number / 2) + 0.5),
        "TAC008",
        Severity::Warning,
    );
    found(
        with_times(|number| 0.3 * f64::from(number ^ 1)),
        "TAC008",
        Severity::Warning,
    );
    found(with_times(f64::from), "TAC008", Severity::Warning);
}

#[test]
fn a_clock_that_begins_anew_is_noticed_unless_the_machine_was_started_again_between_two_sessions() {
    let begun_anew = || {
        let mut recording = Recording::sound();
        for (number, sample) in (0..SAMPLES).zip(&mut recording.samples) {
            sample.stamp = Some(Stamp {
                valid_s: 0.031 * f64::from(number % 100) + 0.013,
                received_s: None,
            });
        }
        recording
    };
    let warns = |report: &CheckReport| codes(report).contains(&("TAC008", Severity::Warning));
    let header = "boot_id,begun_s,unit,specimen,height_mm,depth_mm,Fz_N,zero_Fx_N,zero_Fy_N,zero_Fz_N,x_felt,y_felt,picture_changed,reaction_ms,overshoot_mm,height_u_mm,Fz_u_N";
    let row =
        "1.5,1,sphere of radius 4 mm,0.1,0.2,0.06,0.0,0.0,0.3,true,true,true,6.5,0.02,0.01,0.002";
    let sessions = |boots: [&str; 2]| {
        let [one, other] = boots;
        begun_anew().check_beside("", Some(&format!("{header}\n{one},{row}\n{other},{row}\n")))
    };
    assert!(warns(&begun_anew().check("")));
    assert!(warns(&sessions(["b7", "b7"])));
    let report = sessions(["b7", "c1"]);
    assert!(!warns(&report), "{:?}", report.findings);
    let said = report
        .findings
        .iter()
        .any(|finding| finding.message.contains("2 sessions"));
    assert!(said, "{:?}", report.findings);
}

/// Report on four episodes of fifty rows, whose times are a function of the episode and the row in it.
fn episodes(time: impl Fn(u32, u32) -> f64) -> CheckReport {
    stamped(
        |number| time(number / 50, number % 50),
        |recording| {
            for (number, sample) in (0_u32..).zip(&mut recording.samples) {
                sample.point_id = Some((number / 50).to_string());
            }
        },
    )
}

#[test]
fn times_that_begin_anew_with_every_episode_go_back_nowhere_and_those_of_a_clock_that_was_set_do() {
    has_no_warning_of_times(&episodes(|_, row| regular(row)));
    // Each episode begins a little later than the one before, but before its end.
    has_no_warning_of_times(&episodes(|episode, row| {
        0.2 * f64::from(episode) + regular(row)
    }));
    let set_back = |episode: u32, row: u32| {
        let back = if episode > 1 { 50.0 } else { 0.0 };
        regular(50 * episode + row) - back
    };
    let within = |_: u32, row: u32| regular(if row < 25 { row } else { row - 20 });
    for (report, expected) in [
        (episodes(set_back), "1 sample is older"),
        (episodes(within), "4 samples are older"),
    ] {
        let older = report
            .findings
            .iter()
            .find(|finding| finding.message.contains("older"));
        let older = older.unwrap_or_else(|| panic!("{:#?}", report.findings));
        assert!(older.message.starts_with(expected), "{}", older.message);
        assert_eq!((older.code, older.severity), ("TAC008", Severity::Warning));
    }
}
