//! Calls to a simulated bench, and their answers.

use std::time::Duration;

use taceva_core::Specimen;

use super::{Failure, messages};

messages! {
    /// A call to a simulated bench.
    #[derive(Clone, Debug, PartialEq)]
    enum BenchCall: "a call to a bench" {
        0 => Now {},
        1 => Rest { rest: Duration },
        2 => Mount { specimen: Specimen },
        3 => NamePress { name: u64 },
        4 => Schedule { at: Duration },
        5 => Provenance {},
    }

    /// The answer to a [`BenchCall`].
    #[derive(Debug, PartialEq)]
    enum BenchAnswer: "the answer of a bench" {
        0 => Done {},
        1 => Now { now: Duration },
        2 => Provenance { text: Option<String> },
        3 => Failed { failure: Failure },
    }
}
