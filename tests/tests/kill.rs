//! Tests of programs that are killed repeatedly at random moments. Nothing is lost or duplicated, and the final result is the same.

use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use taceva_tests::recorded::{Recorded, open_whole};
use taceva_tests::{Form, Lab, Random, scratch, taceva};

const SEED: u64 = 20_261_121;
const KILLS_OF_RECORDINGS: usize = 100;
const KILLS_OF_CLOSING: usize = 40;
const KILLS_OF_IMPORTS: usize = 60;
const KILLS_OF_REPLACEMENTS: usize = 200;
const KILLS_OF_ADDITIONS: usize = 40;
const REPLACEMENTS: usize = 40;
const PICTURES: u32 = 60;

/// Facts in the lines that a killed recorder printed.
#[derive(Debug, Default)]
struct Heard {
    resumed: Option<usize>,
    acknowledged: usize,
    is_closed: bool,
}

/// Starts `command`, reads `acks` acknowledgements, waits `more` and kills it. Lines already written are read, too.
fn killed(command: &mut Command, acks: usize, more: Duration) -> Heard {
    let mut child = command
        .stdout(Stdio::piped())
        .spawn()
        .expect("the recorder was built");
    let output = child.stdout.take().expect("its output is a pipe");
    let mut lines = BufReader::new(output).lines().map_while(Result::ok);
    let mut heard = Heard::default();
    let mut count = 0;
    while count < acks {
        let Some(line) = lines.next() else { break };
        count += usize::from(hear(&line, &mut heard));
    }
    spin(more);
    kill(&mut child);
    lines.for_each(|line| {
        hear(&line, &mut heard);
    });
    heard
}

/// Adds the facts in `line` to `heard`. Returns true if the line was an acknowledgement.
fn hear(line: &str, heard: &mut Heard) -> bool {
    let number = |prefix: &str| line.strip_prefix(prefix)?.parse().ok();
    if let Some(rows) = number("RESUMED ") {
        heard.resumed = Some(rows);
    }
    let acknowledged = number("ACK ");
    heard.acknowledged = heard.acknowledged.max(acknowledged.unwrap_or(0));
    heard.is_closed |= line.starts_with("CLOSED");
    acknowledged.is_some()
}

fn kill(child: &mut Child) {
    // The program may have ended by itself.
    let _ = child.kill();
    child.wait().expect("a child that was started here");
}

/// Busy-waits: sleeping is too coarse for moments a few microseconds apart.
fn spin(time: Duration) {
    let start = Instant::now();
    while start.elapsed() < time {
        std::hint::spin_loop();
    }
}

fn micros(random: &mut Random, end: usize) -> Duration {
    Duration::from_micros(random.below(end) as u64)
}

/// Kills recorders at random moments until `kills` are done. Each kill follows at most `most_acks` acknowledgements and a delay below `window_us`,
/// µs. Checks every recording.
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn kill_recordings(recorded: &Recorded, kills: usize, most_acks: usize, window_us: usize) {
    let mut random = Random::new(SEED);
    let (mut done, mut recordings) = (0, 0);
    let mut unresumed = 0;
    while done < kills {
        recordings += 1;
        let folder = scratch();
        let target = folder.path().join("set");
        let mut acknowledged = 0;
        loop {
            let acks = random.below(most_acks + 1);
            let more = micros(&mut random, window_us);
            let heard = killed(&mut recorded.command(&target), acks, more);
            let context = format!("seed {SEED}, kill {done}: {heard:?}, before {acknowledged}");
            if let Some(rows) = heard.resumed {
                assert!(rows >= acknowledged, "lost: {context}");
            }
            acknowledged = acknowledged.max(heard.acknowledged);
            if heard.is_closed {
                let kept = recorded.check_closed(&target, recorded.most());
                assert_eq!(kept, Ok(()), "{context}");
                break;
            }
            done += 1;
            unresumed += usize::from(heard.resumed.is_none());
            if done == kills {
                let kept = recorded.check(&target, acknowledged);
                assert_eq!(kept, Ok(()), "{context}");
                break;
            }
        }
    }
    eprintln!(
        "recorders killed: {done}, {unresumed} before they had resumed, in {recordings} recordings"
    );
}

#[test]
fn a_recorder_killed_at_any_moment_loses_and_doubles_nothing() {
    // Without an acknowledgement the kill hits the start or the resumption.
    kill_recordings(&Recorded::up_to(60), KILLS_OF_RECORDINGS, 8, 1_500);
}

#[test]
fn a_recorder_killed_while_it_closes_loses_nothing() {
    kill_recordings(&Recorded::up_to(1), KILLS_OF_CLOSING, 1, 1_500);
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn an_import_killed_at_any_moment_leaves_the_whole_dataset_or_none() {
    let lab = Lab::drawn(Form::Png, PICTURES);
    let folder = scratch();
    let target = folder.path().join("set");
    assert!(import(&lab, &target).status().expect("built").success());
    let expected = open_whole(&target).expect("imported").digest();
    let entries = entries_below(folder.path());
    std::fs::remove_dir_all(&target).expect("removed");

    let mut random = Random::new(SEED);
    let (mut before, mut amid, mut whole) = (0, 0, 0);
    for number in 0..KILLS_OF_IMPORTS {
        let mut child = import(&lab, &target).spawn().expect("built");
        let awaited = random.below(entries + 1);
        while entries_below(folder.path()) < awaited && is_running(&mut child) {}
        spin(micros(&mut random, 500));
        kill(&mut child);
        if target.exists() {
            whole += 1;
            let dataset = open_whole(&target).expect("whole");
            assert_eq!(dataset.digest(), expected, "seed {SEED}, kill {number}");
            std::fs::remove_dir_all(&target).expect("removed");
        } else if entries_below(folder.path()) > 0 {
            amid += 1;
        } else {
            before += 1;
        }
    }
    eprintln!(
        "imports killed: {before} before the first file, {amid} amid, {whole} after the last"
    );
    assert!(
        amid >= KILLS_OF_IMPORTS / 4,
        "the moments were chosen badly"
    );
    assert!(import(&lab, &target).status().expect("built").success());
    assert_eq!(open_whole(&target).expect("whole").digest(), expected);
    let left: Vec<_> = folder.path().read_dir().expect("there").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn an_import_that_replaces_a_dataset_can_be_killed_at_any_moment_and_loses_none() {
    let labs = [Lab::drawn(Form::Png, 4), Lab::drawn(Form::Png, PICTURES)];
    let folder = scratch();
    let target = folder.path().join("set");
    let digests = labs.each_ref().map(|lab| {
        let imported = import(lab, &target).arg("--force").status().expect("built");
        assert!(imported.success());
        open_whole(&target).expect("imported").digest()
    });
    let mut random = Random::new(SEED);
    let (mut before, mut amid, mut after) = (0, 0, 0);
    for number in 0..KILLS_OF_REPLACEMENTS {
        let (old, new) = ((number + 1) % 2, number % 2);
        // Every second kill is late, during the exchange of names and the removal of the old one.
        let whole = entries_below(&target);
        let mut child = import(&labs[new], &target)
            .arg("--force")
            .spawn()
            .expect("built");
        let most = PICTURES as usize;
        let awaited = whole + random.below(most / 4) + (number / 2 % 2) * (most * 3 / 4);
        while entries_below(folder.path()) < awaited && is_running(&mut child) {}
        spin(micros(&mut random, 4_000));
        kill(&mut child);
        let is_clean = entries_below(folder.path()) == 1 + entries_below(&target);
        let found = open_whole(&target).map(|dataset| dataset.digest());
        let context = format!("seed {SEED}, kill {number}: {found:?}");
        match found {
            Ok(found) if found == digests[new] => after += 1,
            Ok(found) if found == digests[old] && is_clean => before += 1,
            Ok(found) if found == digests[old] => amid += 1,
            _ => panic!("lost: {context}"),
        }
        // The next turn replaces the present dataset by the other one.
        if found != Ok(digests[new]) {
            let finished = import(&labs[new], &target).arg("--force").status();
            assert!(finished.expect("built").success(), "{context}");
        }
        let left: Vec<_> = folder.path().read_dir().expect("there").collect();
        assert_eq!(left.len(), 1, "{context}: {left:?}");
    }
    eprintln!(
        "replacements killed: {before} before the first file, {amid} amid, {after} after the exchange"
    );
    assert!(amid >= KILLS_OF_REPLACEMENTS / 8 && after >= KILLS_OF_REPLACEMENTS / 8);
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn rows_that_are_added_can_be_killed_at_any_moment_and_nothing_is_lost_or_doubled() {
    let first = Lab::drawn(Form::Png, 4);
    let second = Lab::drawn_from(Form::Png, 500, PICTURES as usize);
    let folder = scratch();
    let target = folder.path().join("set");
    let extend = || {
        let mut command = Command::new(taceva());
        command
            .args(["import", "--quiet"])
            .arg(second.path())
            .arg("--map")
            .arg(second.map())
            .arg("--extend")
            .arg(&target)
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        command
    };
    let mut random = Random::new(SEED);
    let (mut before, mut amid, mut after) = (0, 0, 0);
    let (mut old, mut new) = (None, None);
    for number in 0..KILLS_OF_ADDITIONS {
        assert!(
            import(&first, &target)
                .arg("--force")
                .status()
                .expect("built")
                .success()
        );
        let old = *old.get_or_insert(open_whole(&target).expect("imported").digest());
        let whole = entries_below(&target);
        let mut child = extend().spawn().expect("built");
        let awaited = whole + random.below(PICTURES as usize + whole + 4);
        while entries_below(folder.path()) < awaited && is_running(&mut child) {}
        spin(micros(&mut random, 4_000));
        kill(&mut child);
        let is_clean = entries_below(folder.path()) == 1 + entries_below(&target);
        let context = format!("seed {SEED}, kill {number}");
        let dataset = open_whole(&target).expect(&context);
        match (dataset.digest() == old, dataset.table().rows()) {
            (true, 4) if is_clean => before += 1,
            (true, 4) => amid += 1,
            (false, 64) => {
                assert_eq!(
                    *new.get_or_insert(dataset.digest()),
                    dataset.digest(),
                    "{context}"
                );
                after += 1;
            }
            (_, rows) => panic!("{context}: {rows} rows"),
        }
        // Again: rows that are missing are added, and rows that exist are rejected.
        let was_added = dataset.digest() != old;
        drop(dataset);
        assert_eq!(
            extend().status().expect("built").success(),
            !was_added,
            "{context}"
        );
        let rows = open_whole(&target).expect(&context).table().rows();
        assert_eq!(rows, 64, "{context}");
    }
    eprintln!(
        "additions killed: {before} before the first file, {amid} amid, {after} after the exchange"
    );
    assert!(
        amid >= KILLS_OF_ADDITIONS / 8,
        "the moments were chosen badly"
    );
}

#[test]
#[expect(clippy::print_stderr, reason = "the counts are the result")]
fn readers_see_the_old_or_the_new_dataset_while_it_is_replaced() {
    let labs = [Lab::drawn(Form::Png, 5), Lab::drawn(Form::Png, 9)];
    let folder = scratch();
    let target = folder.path().join("set");
    let digests = labs.each_ref().map(|lab| {
        let imported = import(lab, &target).arg("--force").status().expect("built");
        assert!(imported.success());
        open_whole(&target).expect("imported").digest()
    });
    let is_done = std::sync::atomic::AtomicBool::new(false);
    let seen = std::thread::scope(|scope| {
        let readers: Vec<_> = (0..2)
            .map(|_| {
                scope.spawn(|| {
                    let mut seen = [0; 2];
                    while !is_done.load(std::sync::atomic::Ordering::Relaxed) {
                        // Open it and read every frame.
                        let found = open_whole(&target).map(|dataset| dataset.digest());
                        match digests.iter().position(|digest| found == Ok(*digest)) {
                            Some(which) => seen[which] += 1,
                            None => return Err(format!("{found:?}")),
                        }
                    }
                    Ok(seen)
                })
            })
            .collect();
        for number in 0..REPLACEMENTS {
            let mut import = import(&labs[number % 2], &target);
            assert!(import.arg("--force").status().expect("built").success());
        }
        is_done.store(true, std::sync::atomic::Ordering::Relaxed);
        readers
            .into_iter()
            .map(|reader| reader.join().expect("no panic"))
            .collect::<Result<Vec<_>, _>>()
    });
    let seen = seen.expect("old or new at every moment");
    eprintln!("datasets read during {REPLACEMENTS} replacements, of each: {seen:?}");
    assert!(seen.iter().all(|seen| seen.iter().all(|count| *count > 0)));
    // A process that another test has just forked holds inherited locks until it executes its program. Then the next opening cleans up.
    let mut left = Vec::new();
    for _ in 0..100 {
        drop(open_whole(&target).expect("whole"));
        left = folder.path().read_dir().expect("there").collect();
        if left.len() == 1 {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    panic!("left behind: {left:?}");
}

/// Counts files and folders at any depth; ignores those that vanish meanwhile.
fn entries_below(folder: &Path) -> usize {
    let entries = folder.read_dir().into_iter().flatten().flatten();
    entries.map(|entry| 1 + entries_below(&entry.path())).sum()
}

fn is_running(child: &mut Child) -> bool {
    child
        .try_wait()
        .expect("a child that was started here")
        .is_none()
}

fn import(lab: &Lab, target: &Path) -> Command {
    let mut command = Command::new(taceva());
    command
        .args(["import", "--quiet"])
        .arg(lab.path())
        .arg("--map")
        .arg(lab.map())
        .arg("--out")
        .arg(target)
        .stdout(Stdio::null());
    command
}
