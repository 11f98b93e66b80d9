//! TAC012: missing facts about the sensor.

use taceva_core::Clock;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC012",
    name: "unknown-facts",
    looks_for: "serial, gel, clock or reference frame that was not recorded",
    hint: "ask the person who made the recording and complete the map; reports show `unknown` until then",
    reads: None,
    find,
};

/// Remedy for a recording made by this program, which has no import map.
const OF_RECORDING: &str = "complete dataset.toml and accept the edit with `taceva reseal`; for the next recording, state `--serial` and `--gel` \
    of `taceva capture`, or `units` and `opaque` of the scene";

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let header = evidence.header;
    let has_times = evidence.table.t_s().iter().any(Option::is_some);
    let unknown: Vec<&str> = [
        ("serial", header.sensor.serial == "unknown"),
        ("gel", header.sensor.gel == "unknown"),
        ("clock", has_times && header.clock == Clock::Unknown),
        (
            "reference frame",
            header
                .frames
                .as_ref()
                .is_some_and(|frames| frames.reference.is_none()),
        ),
        ("opaque", header.sensor.opaque.known().is_none()),
    ]
    .into_iter()
    .filter_map(|(fact, is_unknown)| is_unknown.then_some(fact))
    .collect();
    if unknown.is_empty() {
        return Vec::new();
    }
    let found = Found::overall(Severity::Note, format!("unknown: {}", unknown.join(", ")));
    vec![match evidence.is_recording() {
        true => found.with_hint(OF_RECORDING),
        false => found,
    }]
}
