//! Tests of interrupted taps.

use super::bench::{Bench, MOUNTED, Transducer, one_press, rig_file, supervised};
use crate::run::{
    Cancel, Controls, Observation, RunError, SessionSpec, TapHeard, TapListener, Tapped,
    Timekeeper as _, tap,
};

/// Test listener that counts taps. During tap number `broken_off`, the guard threads receive no readings for some time.
struct Counting {
    bench: Bench,
    broken_off: u32,
    begun: u32,
    counted: u32,
}

impl TapListener for Counting {
    fn begins(&mut self) {
        self.begun += 1;
        if self.begun == self.broken_off {
            let late_s = self.bench.now_s() + 0.06;
            let supervisor = self.bench.state().supervisor.clone();
            let supervisor = supervisor.expect("it is guarded");
            let heard = supervisor.lock().observe(&Observation::Silence, late_s);
            assert!(heard.is_err());
        }
    }

    fn ends(&mut self) -> TapHeard {
        TapHeard::default()
    }

    fn counts(&mut self) {
        self.counted += 1;
    }
}

#[test]
fn a_tap_that_silence_breaks_off_is_made_again_and_counts_once() {
    let bench = Bench::new(MOUNTED);
    let mut counting = Counting {
        bench: bench.clone(),
        broken_off: 3,
        begun: 0,
        counted: 0,
    };
    tapped(&bench, &mut counting).expect("silence ends no taps");
    let counts = (counting.begun, counting.counted);
    assert_eq!(counts, (Tapped::TAPS + 1, Tapped::TAPS));
}

/// Taps on the test bench, with `listener` as the listener of every tap.
fn tapped(bench: &Bench, listener: &mut dyn TapListener) -> Result<Tapped, RunError> {
    let mut plan = one_press();
    plan.presses[0].frames = false;
    let supervisor = supervised(bench, &plan);
    let (mut robot, mut clock) = (bench.clone(), bench.clone());
    let controls = Controls {
        clock: &mut clock,
        cancel: &Cancel::new(),
        events: &mut |_| {},
        operator: None,
    };
    let session = SessionSpec {
        rig: &rig_file(MOUNTED),
        robot: None,
        touched: &[],
    };
    let mut force = Transducer(bench.clone());
    tap(
        &plan, &mut robot, &mut force, controls, supervisor, session, listener,
    )
}
