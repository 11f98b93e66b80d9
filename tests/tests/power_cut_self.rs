//! Tests that the search for states after a power cut finds every planted bug and reports no other.

use std::process::Command;

use taceva_needs::{Need, skip};
use taceva_tests::power_cut::{Counted, Disk, State, Trace, TraceError};
use taceva_tests::toy::{HEADER, JOURNAL, Protocol, new_header, old_header, recovered};

/// Checks the promise of `protocol` in a state: data with a printed success is present and complete, and no other data exists.
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

fn hunt(protocol: Protocol) -> Result<Counted, TraceError> {
    let folder = tempfile::tempdir().expect("a folder");
    let watched = folder.path().canonicalize().expect("it is there");
    if !protocol.is_journal() {
        std::fs::write(watched.join(HEADER), old_header()).expect("written");
    }
    let mut command = Command::new(taceva_tests::example("toy_writer"));
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
        let counted = match hunt(protocol) {
            Err(TraceError::NoStrace(why)) => {
                skip(Need::Strace, why);
                return;
            }
            counted => counted.expect("followed"),
        };
        eprintln!("{protocol}: {counted}");
        assert!(counted.states >= 16, "{protocol}: {counted}");
        assert_eq!(
            counted.violations == 0,
            protocol.is_right(),
            "{protocol}: {counted}"
        );
    }
}

/// Traces `program` on a folder with the file `a` and the folder `b` with the file `c`.
fn followed(program: &str, arguments: &[&str]) -> Result<Trace, TraceError> {
    let folder = tempfile::tempdir().expect("a folder");
    let watched = folder.path().canonicalize().expect("it is there");
    std::fs::write(watched.join("a"), "one").expect("written");
    std::fs::create_dir(watched.join("b")).expect("made");
    std::fs::write(watched.join("b/c"), "two").expect("written");
    let mut command = Command::new(program);
    command.args(arguments);
    Trace::run(&command, &watched, Disk::load(&watched).expect("read"))
}

#[test]
fn programs_of_the_system_are_followed_to_the_byte() {
    for (program, arguments, left) in [
        ("mv", &["a", "b/d"][..], &["b", "b/c", "b/d"][..]),
        ("ln", &["a", "e"], &["a", "b", "b/c", "e"]),
        ("rm", &["-r", "b"], &["a"]),
        (
            "mkdir",
            &["x", "x/y", "x/y/z"],
            &["a", "b", "b/c", "x", "x/y", "x/y/z"],
        ),
        ("truncate", &["-s", "9", "a"], &["a", "b", "b/c"]),
    ] {
        // Model and disk are compared at the end of each run.
        let trace = match followed(program, arguments) {
            Err(TraceError::NoStrace(why)) => {
                skip(Need::Strace, why);
                return;
            }
            trace => trace.unwrap_or_else(|error| panic!("{program}: {error}")),
        };
        let tree = trace.after(trace.operations.len()).live_tree();
        let names: Vec<&str> = tree.keys().map(String::as_str).collect();
        assert_eq!(names, left, "{program}: {}", trace.complaint);
    }
}

#[test]
fn what_cannot_be_followed_is_refused_loudly() {
    match followed("ln", &["-s", "a", "link"]) {
        Err(TraceError::Unfollowed(what)) => assert!(what.contains("symlink"), "{what}"),
        Err(TraceError::NoStrace(why)) => skip(Need::Strace, why),
        Ok(trace) => panic!("{:?}", trace.operations),
    }
}
