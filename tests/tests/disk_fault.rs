//! Tests of a disk that fails at the n-th call that makes data durable, or from that call on. No success is reported, no acknowledged data is lost,
//! and a working disk completes the work.

use std::path::Path;
use std::process::{Command, Output};

use taceva_needs::{Need, skip};
use taceva_tests::recorded::{Recorded, open_whole};
use taceva_tests::{Form, Lab, scratch, taceva};

/// Exit code for errors of the system.
const REFUSED: i32 = 3;

/// System calls that may fail, each with its error.
const FAULTS: [(&str, &str); 4] = [
    ("fsync,fdatasync", "EIO"),
    ("rename,renameat,renameat2", "EIO"),
    ("mkdir,mkdirat", "ENOSPC"),
    ("ftruncate,fallocate", "EIO"),
];

/// Calls that fail, by their number n.
#[derive(Clone, Copy, Debug)]
enum When {
    /// Only the n-th call fails.
    Once(usize),
    /// The n-th and all later calls fail.
    From(usize),
}

/// Runs `command` on a disk on which `calls` fail; `None` if calls cannot be intercepted.
fn refused(command: &Command, calls: &str, error: &str, when: When) -> Option<Output> {
    let when = match when {
        When::Once(number) => number.to_string(),
        When::From(number) => format!("{number}+"),
    };
    let output = Command::new("strace")
        .args(["-f", "-qq", "-o", "/dev/null", "-e"])
        .arg(format!("trace={calls}"))
        .arg("-e")
        .arg(format!("inject={calls}:error={error}:when={when}"))
        .arg(command.get_program())
        .args(command.get_args())
        .output();
    match output {
        Ok(output) if !output.stderr.starts_with(b"strace:") => Some(output),
        Ok(output) => {
            skip(Need::Strace, String::from_utf8_lossy(&output.stderr));
            None
        }
        Err(error) => {
            skip(Need::Strace, error);
            None
        }
    }
}

fn import(lab: &Lab, target: &Path) -> Command {
    let mut command = Command::new(taceva());
    command
        .args(["import", "--quiet", "--jobs", "1"])
        .arg(lab.path())
        .arg("--map")
        .arg(lab.map())
        .arg("--out")
        .arg(target);
    command
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn an_import_that_the_disk_refuses_claims_no_success() {
    let lab = Lab::drawn(Form::Png, 3);
    let mut failures = 0;
    for (calls, error) in FAULTS {
        for when in [When::Once, When::From] {
            for number in 1.. {
                let folder = scratch();
                let target = folder.path().join("set");
                let context = format!("{calls} {:?}", when(number));
                let Some(output) = refused(&import(&lab, &target), calls, error, when(number))
                else {
                    return;
                };
                if output.status.success() {
                    open_whole(&target).expect("success was claimed");
                    break;
                }
                failures += 1;
                let complaint = String::from_utf8_lossy(&output.stderr).into_owned();
                assert_eq!(
                    output.status.code(),
                    Some(REFUSED),
                    "{context}: {complaint}"
                );
                assert!(complaint.contains("cannot "), "{context}: {complaint}");
                let left: Vec<_> = folder.path().read_dir().expect("there").collect();
                assert!(left.is_empty(), "{context}: {complaint}{left:?}");
                let again = import(&lab, &target).output().expect("built");
                assert!(again.status.success(), "{context}: {again:?}");
                open_whole(&target).expect("imported where the disk works");
            }
        }
    }
    eprintln!("import: {failures} refusals of the disk");
    assert!(failures >= 20, "{failures}");
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn a_recording_that_the_disk_refuses_keeps_what_was_acknowledged() {
    let recorded = Recorded::up_to(3);
    let mut failures = 0;
    for (calls, error) in FAULTS {
        for when in [When::Once, When::From] {
            for number in 1.. {
                let folder = scratch();
                let target = folder.path().join("set");
                let context = format!("{calls} {:?}", when(number));
                let command = recorded.command(&target);
                let Some(output) = refused(&command, calls, error, when(number)) else {
                    return;
                };
                let said = String::from_utf8_lossy(&output.stdout).into_owned();
                if output.status.success() {
                    assert_eq!(recorded.check_closed(&target, recorded.most()), Ok(()));
                    break;
                }
                failures += 1;
                assert!(!said.contains("CLOSED"), "{context}: {said}");
                let acknowledged = said.lines().filter(|line| line.starts_with("ACK")).count();
                assert_eq!(recorded.check(&target, acknowledged), Ok(()), "{context}");
            }
        }
    }
    eprintln!("recording: {failures} refusals of the disk");
    assert!(failures >= 20, "{failures}");
}
