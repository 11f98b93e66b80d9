//! Tests of power cuts at every moment of an import and of a recording: data that was reported as durable is present.

use std::ops::Range;
use std::path::Path;
use std::process::Command;

use taceva_dataset::{Digest, Recorder};
use taceva_needs::{Need, skip};
use taceva_tests::power_cut::{Counted, Disk, State, Trace, TraceError, write_tree};
use taceva_tests::recorded::{Recorded, open_whole, reference};
use taceva_tests::{Form, Lab, example, scratch, taceva};

/// Maximum number of states after a first power cut from which a second recorder is traced. Each takes a tenth of a second.
const MOST_RESUMED: usize = 80;

/// Runs `command` in the folder at `watched`; `None` if programs cannot be traced.
fn traced(command: &Command, watched: &Path, initial: Disk) -> Option<Trace> {
    match Trace::run(command, watched, initial) {
        Err(TraceError::NoStrace(why)) => {
            skip(Need::Strace, why);
            None
        }
        trace => Some(trace.expect("every call can be followed")),
    }
}

#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn assert_kept(what: &str, counted: &Counted, at_least: usize) {
    eprintln!("{what}: {counted}");
    assert_eq!(counted.violations, 0, "{what}: {counted}");
    assert!(counted.states >= at_least, "{what}: {counted}");
}

fn import(lab: &Lab, target: &Path) -> Command {
    let mut command = Command::new(taceva());
    command
        .args(["import", "--quiet", "--jobs", "2"])
        .arg(lab.path())
        .arg("--map")
        .arg(lab.map())
        .arg("--out")
        .arg(target);
    command
}

fn run(command: &mut Command) -> Result<(), String> {
    let output = command.output().map_err(|error| error.to_string())?;
    if output.status.success() {
        return Ok(());
    }
    Err(String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Checks that the dataset is absent or complete, and that an absent one can be imported.
fn whole_or_absent(lab: &Lab, target: &Path, expected: Digest) -> Result<(), String> {
    if !target.exists() {
        run(&mut import(lab, target)).map_err(|error| format!("importing again: {error}"))?;
    }
    let dataset = open_whole(target)?;
    if dataset.digest() == expected {
        Ok(())
    } else {
        Err(format!("another dataset: {}", dataset.digest()))
    }
}

#[test]
fn an_import_leaves_the_whole_dataset_or_none() {
    let lab = Lab::drawn(Form::Png, 6);
    let folder = scratch();
    let watched = folder.path();
    let target = watched.join("set");
    let initial = Disk::load(watched).expect("empty");
    let Some(trace) = traced(&import(&lab, &target), watched, initial) else {
        return;
    };
    assert!(trace.status.success(), "{}", trace.complaint);
    let expected = open_whole(&target).expect("imported").digest();
    let counted = trace.each_state(0..trace.operations.len() + 1, |state| {
        let restarted = scratch();
        let target = restarted.path().join("set");
        state
            .write_to(restarted.path())
            .expect("room for a small folder");
        let was_reported = state.printed.iter().any(|line| line.starts_with("digest"));
        if was_reported && !target.exists() {
            return Err("reported and lost".to_owned());
        }
        whole_or_absent(&lab, &target, expected)
    });
    assert_kept("import", &counted, 100);
}

#[test]
fn an_import_that_replaces_a_dataset_leaves_the_old_one_or_the_new_one_in_place() {
    let (old, new) = (Lab::drawn(Form::Png, 2), Lab::drawn(Form::Png, 3));
    let folder = scratch();
    let watched = folder.path();
    let target = watched.join("set");
    assert_eq!(run(&mut import(&old, &target)), Ok(()));
    let replaced = open_whole(&target).expect("imported").digest();
    let initial = Disk::load(watched).expect("one dataset");
    let mut command = import(&new, &target);
    command.arg("--force");
    let Some(trace) = traced(&command, watched, initial) else {
        return;
    };
    assert!(trace.status.success(), "{}", trace.complaint);
    let expected = open_whole(&target).expect("imported").digest();
    assert_old_or_new("import --force", &trace, [replaced, expected]);
}

/// Asserts that after a power cut at any operation of `trace`, the dataset is the old or the new one. It must be the new one once success was
/// reported. Nothing else may remain.
fn assert_old_or_new(command: &str, trace: &Trace, [old, new]: [Digest; 2]) {
    let counted = trace.each_state(0..trace.operations.len() + 1, |state| {
        let restarted = scratch();
        let target = restarted.path().join("set");
        state
            .write_to(restarted.path())
            .expect("room for a small folder");
        let was_reported = state.printed.iter().any(|line| line.starts_with("digest"));
        let found = open_whole(&target)?.digest();
        if found != new && (was_reported || found != old) {
            return Err(format!("in place {found}, reported: {was_reported}"));
        }
        let left = restarted.path().read_dir().expect("there").flatten();
        let left: Vec<_> = left.map(|entry| entry.file_name()).collect();
        match left.as_slice() {
            [only] if only == "set" => Ok(()),
            _ => Err(format!("left after it was opened: {left:?}")),
        }
    });
    assert_kept(command, &counted, 100);
}

/// Command that adds the pictures of `lab` to the dataset at `target`.
fn extend(lab: &Lab, target: &Path) -> Command {
    let mut command = Command::new(taceva());
    command
        .args(["import", "--quiet", "--jobs", "2"])
        .arg(lab.path())
        .arg("--map")
        .arg(lab.map())
        .arg("--extend")
        .arg(target);
    command
}

#[test]
fn rows_that_are_added_are_all_there_or_none_is_and_no_row_of_before_is_lost() {
    let first = Lab::drawn(Form::Png, 2);
    let second = Lab::drawn_from(Form::Png, 50, 3);
    let folder = scratch();
    let watched = folder.path();
    let target = watched.join("set");
    assert_eq!(run(&mut import(&first, &target)), Ok(()));
    let before = open_whole(&target).expect("imported").digest();
    let initial = Disk::load(watched).expect("one dataset");
    let Some(trace) = traced(&extend(&second, &target), watched, initial) else {
        return;
    };
    assert!(trace.status.success(), "{}", trace.complaint);
    let expected = open_whole(&target).expect("extended");
    assert_eq!(expected.table().rows(), 5);
    let expected = expected.digest();
    assert_old_or_new("import --extend", &trace, [before, expected]);
}

/// A traced recording, and the operation after which the last sample was acknowledged.
fn recording(recorded: &Recorded) -> Option<(Trace, usize)> {
    let folder = scratch();
    let watched = folder.path();
    let initial = Disk::load(watched).expect("empty");
    let trace = traced(&recorded.command(&watched.join("set")), watched, initial)?;
    assert!(trace.status.success(), "{}", trace.complaint);
    let last = format!("ACK {}", recorded.most());
    let end = (0..trace.operations.len())
        .find(|count| trace.after(*count).printed().contains(&last))
        .expect("the last sample was acknowledged");
    Some((trace, end))
}

fn try_all(recorded: &Recorded, trace: &Trace, cuts: Range<usize>) -> Counted {
    trace.each_state(cuts, |state| recovers(recorded, state, 0))
}

/// Checks that all samples are recovered that were acknowledged in this run or `before`. A closed recording must need no recovery.
fn recovers(recorded: &Recorded, state: &State<'_>, before: usize) -> Result<(), String> {
    let restarted = scratch();
    let target = restarted.path().join("set");
    state
        .write_to(restarted.path())
        .expect("room for a small folder");
    if state.printed.iter().any(|line| line.starts_with("CLOSED")) {
        return recorded.check_closed(&target, recorded.most());
    }
    recorded.check(&target, state.acknowledged().max(before))
}

#[test]
fn every_acknowledged_sample_survives_and_closing_loses_none() {
    let recorded = Recorded::up_to(12);
    let Some((trace, end)) = recording(&recorded) else {
        return;
    };
    let counted = try_all(&recorded, &trace, 0..end);
    assert_kept("recording", &counted, 100);
    let counted = try_all(&recorded, &trace, end..trace.operations.len() + 1);
    assert_kept("closing", &counted, 25);
}

#[test]
fn a_recorder_that_was_killed_and_resumed_survives_a_power_cut() {
    let recorded = Recorded::up_to(5);
    let Some((first, _)) = recording(&recorded) else {
        return;
    };
    let mut sum = Counted::default();
    for killed_after in 0..first.operations.len() {
        // Data that the killed process did not sync is still not durable when the next process starts.
        let left = first.after(killed_after);
        let folder = scratch();
        write_tree(&left.live_tree(), folder.path()).expect("room for a small folder");
        let command = recorded.command(&folder.path().join("set"));
        let Some(second) = traced(&command, folder.path(), left) else {
            return;
        };
        assert!(
            second.status.success(),
            "killed after {killed_after}: {}",
            second.complaint
        );
        let counted = try_all(&recorded, &second, 0..second.operations.len() + 1);
        sum = sum.and(counted);
    }
    assert_kept("killed, resumed and cut", &sum, 3_000);
}

#[test]
fn a_power_cut_while_a_recording_is_resumed_loses_nothing() {
    let recorded = Recorded::up_to(4);
    let Some((first, _)) = recording(&recorded) else {
        return;
    };
    let mut left = Vec::new();
    first.each_state(0..first.operations.len(), |state| {
        left.push((state.tree.clone(), state.acknowledged()));
        Ok(())
    });
    let mut sum = Counted::default();
    for (tree, acknowledged) in left.iter().step_by(left.len().div_ceil(MOST_RESUMED)) {
        let folder = scratch();
        write_tree(tree, folder.path()).expect("room for a small folder");
        let initial = Disk::load(folder.path()).expect("just written");
        let command = recorded.command(&folder.path().join("set"));
        let Some(second) = traced(&command, folder.path(), initial) else {
            return;
        };
        assert!(second.status.success(), "{}", second.complaint);
        let counted = second.each_state(0..second.operations.len() + 1, |state| {
            recovers(&recorded, state, *acknowledged)
        });
        sum = sum.and(counted);
    }
    assert_kept("cut, resumed and cut again", &sum, 2_500);
}

#[test]
fn a_reference_that_is_taken_anew_never_spoils_the_one_before() {
    let folder = scratch();
    let watched = folder.path();
    let mut command = Command::new(example("two_references"));
    command.arg(watched.join("set"));
    let initial = Disk::load(watched).expect("empty");
    let Some(trace) = traced(&command, watched, initial) else {
        return;
    };
    assert!(trace.status.success(), "{}", trace.complaint);
    let counted = trace.each_state(0..trace.operations.len() + 1, |state| {
        let restarted = scratch();
        let target = restarted.path().join("set");
        state
            .write_to(restarted.path())
            .expect("room for a small folder");
        let acknowledged = state.acknowledged();
        if acknowledged == 0 {
            return Ok(());
        }
        let recorder = Recorder::resume(&target).map_err(|error| error.to_string())?;
        recorder.close().map_err(|error| error.to_string())?;
        let dataset = open_whole(&target)?;
        let found = dataset.reference().map_err(|error| error.to_string())?;
        let is_new = found == Some(reference(2));
        if is_new || (acknowledged < 3 && found == Some(reference(1))) {
            Ok(())
        } else {
            Err(format!("{acknowledged} acknowledged, another reference"))
        }
    });
    assert_kept("reference", &counted, 40);
}
