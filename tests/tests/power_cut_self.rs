//! The hunt for states of a power cut finds every planted fault and accuses nobody else.

use std::process::Command;

use taceva_tests::power_cut::{Disk, State, Tally, Trace, TraceError};
use taceva_tests::toy::{HEADER, JOURNAL, Protocol, new_header, old_header, recovered};

/// What the protocol promises: what was claimed is there and whole, and nothing was invented.
fn promise(protocol: Protocol, state: &State<'_>) -> Result<(), String> {
    let claimed = state.acknowledged();
    if protocol.is_journal() {
        let found = recovered(protocol, state.file(JOURNAL).unwrap_or_default())?;
        return if found < claimed {
            Err(format!("{claimed} claimed, {found} recovered"))
        } else {
            Ok(())
        };
    }
    match state.file(HEADER) {
        Some(header) if header == new_header() => Ok(()),
        Some(header) if header == old_header() && claimed == 0 => Ok(()),
        found => Err(format!(
            "{claimed} claimed, found {:?} bytes",
            found.map(<[u8]>::len)
        )),
    }
}

fn hunt(protocol: Protocol) -> Result<Tally, TraceError> {
    let folder = tempfile::tempdir().expect("a folder");
    let watched = folder.path().canonicalize().expect("it is there");
    if !protocol.is_journal() {
        std::fs::write(watched.join(HEADER), old_header()).expect("written");
    }
    let mut command = Command::new(taceva_tests::example("taceva-tests", "toy_writer"));
    command.arg(protocol.to_string());
    let initial = Disk::load(&watched).expect("read");
    let trace = Trace::run(&command, &watched, initial)?;
    assert!(trace.status.success(), "{}", trace.complaint);
    Ok(trace.each_state(0..trace.operations.len() + 1, |state| {
        promise(protocol, state)
    }))
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn the_five_planted_faults_are_found_and_the_two_right_protocols_pass() {
    for protocol in Protocol::ALL {
        let tally = match hunt(protocol) {
            Err(TraceError::NoStrace(why)) => {
                eprintln!("skipped: {why}");
                return;
            }
            tally => tally.expect("followed"),
        };
        eprintln!("{protocol}: {tally}");
        assert!(tally.states >= 16, "{protocol}: {tally}");
        assert_eq!(
            tally.violations == 0,
            protocol.is_right(),
            "{protocol}: {tally}"
        );
    }
}
