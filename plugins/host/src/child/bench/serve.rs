//! Serves the simulated bench of the child's rig on its own thread.

use std::os::fd::OwnedFd;
use std::sync::Arc;

use taceva_core::{DriverError, SimulatedBench};

use crate::child::socket::Socket;
use crate::child::thread::{guarded, start};
use crate::child::wire::{BenchAnswer, BenchCall, Failure};

/// Answers calls to `bench` until the host closes its socket.
pub(in crate::child) fn serve(
    bench: Arc<dyn SimulatedBench>,
    calls: OwnedFd,
) -> Result<(), Failure> {
    let mut calls = Socket::from(calls);
    start("taceva-bench", move || {
        while let Ok((sequence, call)) = calls.receive::<(u32, BenchCall)>() {
            let answer = guarded("answer", || answer(&*bench, &call));
            let answer = answer.unwrap_or_else(|failure| BenchAnswer::Failed { failure });
            if calls.send(&(sequence, answer), &[]).is_err() {
                return;
            }
        }
    })
}

fn answer(bench: &dyn SimulatedBench, call: &BenchCall) -> BenchAnswer {
    match *call {
        BenchCall::Now {} => BenchAnswer::Now { now: bench.now() },
        BenchCall::Rest { rest } => done(bench.rest(rest)),
        BenchCall::Mount { specimen } => done(bench.mount(specimen)),
        BenchCall::NamePress { name } => done(bench.name_press(name)),
        BenchCall::Schedule { at } => done(bench.schedule(at)),
        BenchCall::Provenance {} => BenchAnswer::Provenance {
            text: bench.provenance(),
        },
    }
}

fn done(result: Result<(), DriverError>) -> BenchAnswer {
    match result {
        Ok(()) => BenchAnswer::Done {},
        Err(error) => BenchAnswer::Failed {
            failure: Failure::of(&error),
        },
    }
}
