mod bench;
mod taps;

use taceva_core::{Nanometre, Phase};

use bench::{
    Bench, MOUNTED, Memory, SURFACE_MM, Sees, Session, State, begun, begun_with, one_press,
    rig_file,
};

use crate::press::{Motion, Waypoint};
use crate::rig_file::{RigFile, SignedAxes};
use crate::run::{Answer, Left, Question, RunError, SessionRecord, StopCause, TouchFault};

/// Runs a session on the test bench, with `axes` as the transducer axes of the rig file.
fn with_axes(axes: [&str; 3]) -> (Result<(), RunError>, Memory) {
    let (bench, rig) = (Bench::new(axes), rig_file(axes));
    let session = Session {
        rig: &rig,
        robot: None,
        touched: &[],
        answer: None,
    };
    let (done, log, _) = begun(&bench, session);
    (done, log)
}

/// Runs a session on a test bench with the fault that `change` introduces. Returns the cause, the place of the tip and the number of presses.
fn with_fault(change: impl FnOnce(&mut State)) -> (StopCause, Left, usize) {
    let (bench, rig) = (Bench::new(MOUNTED), rig_file(MOUNTED));
    change(&mut bench.state());
    let session = Session {
        rig: &rig,
        robot: None,
        touched: &[],
        answer: None,
    };
    let (done, log, _) = begun(&bench, session);
    let error = done.expect_err("something is wrong");
    (error.cause, error.left, log.presses)
}

#[test]
fn a_rig_that_is_as_its_file_says_is_touched_gently_and_then_pressed() {
    let (done, log) = with_axes(MOUNTED);
    done.expect("nothing is wrong");
    assert_eq!((log.presses, log.sessions.len()), (1, 1));
    let SessionRecord {
        touch,
        zero,
        pushes_felt,
        picture_changed,
        reaction_ms,
        overshoot_mm,
    } = &log.sessions[0];
    // The contact is found at 0.02 N, 0.04 mm below the surface. The tolerance is the interpolation error over one step.
    assert!((touch.height_mm - 0.17).abs() < 0.02, "{touch:?}");
    // Deep enough that the height of the contact matters little.
    assert!((touch.depth_mm - 0.3).abs() < 1e-9, "{touch:?}");
    assert!(
        (0.001..0.03).contains(&touch.height_u_mm) && touch.force_u_n < 0.1 * touch.force_n,
        "{touch:?}"
    );
    let pressed_mm = touch.height_mm + touch.depth_mm - SURFACE_MM;
    assert!(
        (touch.force_n - 0.5 * pressed_mm).abs() < 0.001,
        "{touch:?}"
    );
    assert!((zero.force[2].0 - 0.2).abs() < 0.001, "{zero:?}");
    assert_eq!((*pushes_felt, *picture_changed), ([true; 2], true));
    // Read every 2 ms and passed on at once; a halt is sent in 1 ms.
    assert!((2.9..4.0).contains(reaction_ms), "{reaction_ms} ms");
    assert!(*overshoot_mm < 0.3, "{overshoot_mm} mm");
}

#[test]
fn every_other_way_to_write_the_axes_of_the_transducer_is_refused_with_its_line_and_the_right_one()
{
    let words = ["x", "y", "z", "-x", "-y", "-z"];
    let mut refused = 0;
    for x in words {
        for y in words {
            for z in words {
                if SignedAxes::read([x, y, z]).is_err() || [x, y, z] == MOUNTED {
                    continue;
                }
                let (done, log) = with_axes([x, y, z]);
                let error = done.expect_err("the axes are wrong");
                let said = error.to_string();
                assert!(matches!(error.cause, StopCause::Rig(_)), "{said}");
                assert!(
                    said.starts_with("lab.toml, line 9: `axes` of [force]: "),
                    "{said}"
                );
                let line = "write axes = [\"x\", \"-y\", \"-z\"]";
                assert!(said.contains(line), "{x} {y} {z}: {said}");
                assert_eq!((error.left, log.presses), (Left::Clear, 0), "{said}");
                refused += 1;
            }
        }
    }
    assert_eq!(refused, 23);
}

#[test]
fn a_tip_that_finds_no_gel_names_the_origin_of_the_rig_file() {
    let (cause, left, presses) = with_fault(|state| state.surface_mm = 1e3);
    let said = cause.to_string();
    assert!(
        said.starts_with("lab.toml, line 5: no contact down to"),
        "{said}"
    );
    assert_eq!((left, presses), (Left::Clear, 0));
}

#[test]
fn a_camera_that_does_not_see_the_touch_is_refused_and_one_that_goes_on_seeing_it_too() {
    let (cause, _, presses) = with_fault(|state| state.sees = Sees::Nothing);
    assert!(
        matches!(cause, StopCause::Touch(TouchFault::Unseen { .. })),
        "{cause}"
    );
    assert_eq!(presses, 0);
    let (cause, _, presses) = with_fault(|state| state.sees = Sees::Afterwards);
    assert!(
        matches!(cause, StopCause::Touch(TouchFault::Stays { .. })),
        "{cause}"
    );
    assert_eq!(presses, 0);
}

#[test]
fn a_machine_that_reads_late_is_refused_with_what_helps() {
    // 40 ms and a period of 42 ms at 4 mm/s are 0.33 mm, more than 0.3 of 1 mm.
    let (cause, left, presses) = with_fault(|state| state.latency_s = 0.04);
    let said = cause.to_string();
    let StopCause::SlowGuard {
        reaction_ms,
        overshoot_mm,
        greatest_mm,
        speed_mm_s,
    } = cause
    else {
        panic!("{said}");
    };
    assert!((82.0..84.0).contains(&reaction_ms), "{said}");
    assert!(
        overshoot_mm > greatest_mm && (0.3 - greatest_mm).abs() < 1e-9,
        "{said}"
    );
    assert!((2.0..4.0).contains(&speed_mm_s), "{said}");
    assert!(
        said.contains("`chrt -f 10 taceva run …`") && said.contains("`speed_mm_s`"),
        "{said}"
    );
    assert_eq!((left, presses), (Left::Clear, 0));
}

#[test]
fn emulated_devices_that_are_late_for_a_while_are_waited_for_and_real_ones_are_not() {
    for (simulated, late_until_s, presses) in
        [(true, 17.0, 1), (false, 17.0, 0), (true, f64::INFINITY, 0)]
    {
        let bench = Bench::new(MOUNTED);
        bench.state().latency_s = 0.04;
        bench.state().late_until_s = late_until_s;
        let rig = RigFile {
            simulated,
            ..rig_file(MOUNTED)
        };
        let session = Session {
            rig: &rig,
            robot: None,
            touched: &[],
            answer: None,
        };
        let (done, log, _) = begun(&bench, session);
        assert_eq!(log.presses, presses, "{simulated}, {late_until_s} s");
        let cause = done.map_err(|error| error.cause).err();
        assert!(
            matches!(cause, Some(StopCause::SlowGuard { .. })) == (presses == 0),
            "{cause:?}"
        );
    }
}

#[test]
fn a_robot_is_enabled_by_its_name_before_it_moves_and_not_at_all_where_nobody_says_so() {
    let (bench, rig) = (Bench::new(MOUNTED), rig_file(MOUNTED));
    let session = |answer| Session {
        rig: &rig,
        robot: Some("lab/arm"),
        touched: &[],
        answer,
    };
    let (done, log, person) = begun(&bench, session(Some(Answer::Stop)));
    let error = done.expect_err("not enabled");
    assert!(matches!(error.cause, StopCause::Cancelled), "{error}");
    assert_eq!((error.left, log.presses), (Left::Untouched, 0));
    let asked = person.asked[0].0.to_string();
    assert!(
        asked.starts_with("`lab/arm` is about to move: up to 2 mm above the gel,"),
        "{asked}"
    );
    let (done, ..) = begun(&bench, session(None));
    let error = done.expect_err("nobody is there");
    assert!(matches!(error.cause, StopCause::Missing(_)), "{error}");
    assert_eq!(bench.state().motions, 0);
    let (done, log, person) = begun(&bench, session(Some(Answer::Done)));
    done.expect("enabled");
    assert_eq!(log.presses, 1);
    let [(enable, _, moved), (mount, height_mm, _)] = &person.asked[..] else {
        panic!("{:?}", person.asked);
    };
    assert!(matches!(enable, Question::Enable { .. }) && *moved == 0);
    // Hands come near only at or above the travel height.
    assert!(matches!(mount, Question::Mount(_)) && *height_mm <= -2.0);
}

#[test]
fn a_gel_that_is_not_touched_as_before_is_asked_about_and_one_that_is_goes_on() {
    let (bench, rig) = (Bench::new(MOUNTED), rig_file(MOUNTED));
    let session = |touched, answer| Session {
        rig: &rig,
        robot: None,
        touched,
        answer,
    };
    let (done, log, _) = begun(&bench, session(&[], None));
    done.expect("the first session");
    let touched = [log.sessions[0].touch.clone()];
    let (done, log, person) = begun(&bench, session(&touched, Some(Answer::Done)));
    done.expect("the same gel");
    assert!(
        !person
            .asked
            .iter()
            .any(|(asked, ..)| matches!(asked, Question::Resume(_))),
        "{:?}",
        person.asked
    );
    assert!((log.sessions[0].touch.depth_mm - touched[0].depth_mm).abs() < 1e-9);
    // The gel was moved by 0.25 mm, or replaced.
    for change in [
        (|state: &mut State| state.surface_mm += 0.25) as fn(&mut State),
        |state| state.stiffness = 1.3,
    ] {
        let bench = Bench::new(MOUNTED);
        change(&mut bench.state());
        let (done, log, person) = begun(&bench, session(&touched, Some(Answer::Done)));
        done.expect("somebody says that it is the same");
        assert_eq!(log.presses, 1);
        let (asked, height_mm, _) = person.asked.last().expect("asked");
        assert!(
            matches!(asked, Question::Resume(_)) && *height_mm <= -2.0,
            "{asked:?}"
        );
        let (done, log, _) = begun(&bench, session(&touched, None));
        let error = done.expect_err("nobody can be asked");
        assert!(matches!(error.cause, StopCause::Missing(_)), "{error}");
        assert_eq!(log.presses, 0);
    }
}

#[test]
fn a_transducer_whose_fx_and_fy_are_swapped_after_the_touch_is_found_in_the_next_sheared_press() {
    let mut plan = one_press();
    let planned = &mut plan.presses[0];
    planned.frames = false;
    planned.press.place = [Nanometre(0); 2];
    let waypoint = |shear: [i64; 2]| Waypoint {
        depth: Nanometre(200_000),
        shear: shear.map(Nanometre),
        phase: Phase::Load,
    };
    planned.press.motion = Motion::Indent(vec![waypoint([0, 0]), waypoint([500_000, -400_000])]);
    for (is_swapped, presses) in [(false, 1), (true, 0)] {
        let (bench, rig) = (Bench::new(MOUNTED), rig_file(MOUNTED));
        bench.state().stiffness = 4.0;
        bench.state().is_swapped = is_swapped;
        let session = Session {
            rig: &rig,
            robot: None,
            touched: &[],
            answer: None,
        };
        let (done, log, _) = begun_with(&bench, session, &plan);
        assert_eq!((log.presses, log.sessions.len()), (presses, 1));
        let cause = done.map_err(|error| (error.cause, error.left)).err();
        let is_found = matches!(cause, Some((StopCause::Shear(_), Left::Clear)));
        assert_eq!(is_found, is_swapped, "{cause:?}");
    }
}
