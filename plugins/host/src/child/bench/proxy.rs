//! Host-side proxy of a simulated bench in a child.

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

use taceva_core::{DriverError, DriverKey, SimulatedBench, Specimen};

use crate::child::socket::{Caller, Socket};
use crate::child::start::Child;
use crate::child::wire::{BenchAnswer, BenchCall};

pub(crate) struct BenchProxy {
    child: Arc<Child>,
    driver: DriverKey,
    calls: Mutex<Line>,
}

struct Line {
    caller: Caller,
    /// Last known time of the clock of the bench, returned after the bench is gone.
    now: Duration,
}

impl BenchProxy {
    pub(crate) fn new(child: Arc<Child>, driver: DriverKey, calls: Socket) -> BenchProxy {
        BenchProxy {
            child,
            driver,
            calls: Mutex::new(Line {
                caller: Caller::from(calls),
                now: Duration::ZERO,
            }),
        }
    }

    fn call(&self, call: &BenchCall, doing: &str) -> Result<BenchAnswer, DriverError> {
        let life = self.child.life();
        let mut line = self.calls.lock().unwrap_or_else(PoisonError::into_inner);
        let id = life.watch.begin(doing, life.patience.open);
        let answer = line.caller.ask(call, &[]);
        life.watch.end(id);
        match answer {
            Ok(BenchAnswer::Failed { failure }) => Err(failure.to_error(&self.driver)),
            Ok(answer) => {
                if let BenchAnswer::Now { now } = answer {
                    line.now = now;
                }
                Ok(answer)
            }
            Err(error) => Err(life.lost(error).of(&self.driver, doing)),
        }
    }

    fn done(&self, call: &BenchCall, doing: &str) -> Result<(), DriverError> {
        match self.call(call, doing)? {
            BenchAnswer::Done {} => Ok(()),
            _ => {
                let error = self.child.life().broke("an answer to another call");
                Err(error.of(&self.driver, doing))
            }
        }
    }
}

impl SimulatedBench for BenchProxy {
    fn now(&self) -> Duration {
        match self.call(&BenchCall::Now {}, "read the clock") {
            Ok(BenchAnswer::Now { now }) => now,
            _ => {
                let line = self.calls.lock().unwrap_or_else(PoisonError::into_inner);
                line.now
            }
        }
    }

    fn rest(&self, rest: Duration) -> Result<(), DriverError> {
        self.done(&BenchCall::Rest { rest }, "rest")
    }

    fn mount(&self, specimen: Specimen) -> Result<(), DriverError> {
        self.done(&BenchCall::Mount { specimen }, "mount a specimen")
    }

    fn name_press(&self, name: u64) -> Result<(), DriverError> {
        self.done(&BenchCall::NamePress { name }, "name a press")
    }

    fn schedule(&self, at: Duration) -> Result<(), DriverError> {
        self.done(&BenchCall::Schedule { at }, "schedule a tare")
    }

    fn provenance(&self) -> Option<String> {
        match self.call(&BenchCall::Provenance {}, "report its provenance") {
            Ok(BenchAnswer::Provenance { text }) => text,
            _ => None,
        }
    }
}
