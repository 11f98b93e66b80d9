//! Exclusive claims on work that several processes may start. The processes may run on several machines that share a folder.
//!
//! A claim is a file that is created exclusively. A claim needs only exclusive creation and renaming; network file systems may lack `flock` and
//! `fcntl` locks. While the owner lives, it writes a counter into the file. A waiting process checks with its own clock that the counter changes, so
//! clocks are never compared. A dead owner on the same machine is detected by its process id. A lost claim only costs duplicate work: the result has
//! the same bytes in any process.

use std::fs::{self, File};
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Interval between two updates of the counter.
const COUNTS_EVERY: Duration = Duration::from_secs(2);
/// Time without an update after which an owner counts as dead.
const DEAD_AFTER: Duration = Duration::from_secs(30);

/// A claim of this process. Dropping it releases the claim.
#[derive(Debug)]
pub struct Claim {
    path: PathBuf,
    owner: String,
    stop: Option<Sender<()>>,
    counting: Option<JoinHandle<()>>,
}

/// Observation of another process's claim, since the first look.
#[derive(Debug)]
pub struct Watch {
    path: PathBuf,
    seen: String,
    since: Instant,
}

/// Name that is unique among threads, processes and machines.
fn unique_name() -> String {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    format!("{}-{number}", process_name())
}

impl Claim {
    /// Creates the claim at `path`; `None` if another process has claimed it.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn take(path: &Path) -> io::Result<Option<Claim>> {
        let mut file = match File::options().write(true).create_new(true).open(path) {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                // Such an entry would never be released.
                let is_other = fs::symlink_metadata(path).is_ok_and(|found| !found.is_file());
                return match is_other {
                    true => Err(io::Error::other(format!(
                        "`{}` is a link or a folder, expected a claim: remove it",
                        path.display()
                    ))),
                    false => Ok(None),
                };
            }
            Err(error) => return Err(error),
        };
        let owner = unique_name();
        file.write_all(line(&owner, 0).as_bytes())?;
        let (stop, stopped) = channel();
        let own = owner.clone();
        // Writes to the open file, not by name, because the name may belong to another owner by now.
        let counting = std::thread::Builder::new().spawn(move || {
            let mut count = 0;
            while stopped.recv_timeout(COUNTS_EVERY) == Err(RecvTimeoutError::Timeout) {
                count += 1;
                let counted = file.seek(SeekFrom::Start(0));
                let counted = counted.and_then(|_| file.write_all(line(&own, count).as_bytes()));
                if counted.and_then(|()| file.sync_data()).is_err() {
                    return;
                }
            }
        })?;
        Ok(Some(Claim {
            path: path.to_owned(),
            owner,
            stop: Some(stop),
            counting: Some(counting),
        }))
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(counting) = self.counting.take() {
            // A panic of that thread only means that the claim was not renewed.
            drop(counting.join());
        }
        if read(&self.path).is_ok_and(|text| owner_of(&text) == self.owner) {
            // A claim that remains is detected as dead later.
            drop(fs::remove_file(&self.path));
        }
    }
}

impl Watch {
    /// Starts observing the claim at `path`.
    pub fn new(path: &Path) -> Watch {
        Watch {
            path: path.to_owned(),
            seen: read(path).unwrap_or_default(),
            since: Instant::now(),
        }
    }

    /// Removes the claim if its owner is dead: the process ended on this machine, or the counter has not changed for long. If several observers try, only one
    /// removes the claim. Returns true if this call removed the claim, or if the claim no longer exists.
    ///
    /// # Errors
    /// Errors of the file system.
    pub fn clear(&mut self) -> io::Result<bool> {
        self.clear_after(DEAD_AFTER)
    }

    fn clear_after(&mut self, dead_after: Duration) -> io::Result<bool> {
        let now = match read(&self.path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(true),
            Err(error) => return Err(error),
        };
        if now != self.seen {
            self.seen = now;
            self.since = Instant::now();
        }
        let owner = owner_of(&self.seen).to_owned();
        if !ended_here(&owner) && self.since.elapsed() < dead_after {
            return Ok(false);
        }
        // Only one observer may move the dead claim. A second one would move the claim that replaced it.
        let mark = self.path.with_file_name(format!(
            ".{}.{}.dead",
            self.path.file_name().unwrap_or_default().to_string_lossy(),
            match owner.as_str() {
                "" => "nobody",
                owner => owner,
            }
        ));
        let marked = File::options().write(true).create_new(true).open(&mark);
        match marked {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                // The process that created the mark may have ended before the rename.
                if self.since.elapsed() >= 3 * dead_after {
                    drop(fs::remove_file(&mark));
                }
                return Ok(false);
            }
            Err(error) => return Err(error),
            // The mark names its owner, so that the mark of a killed process is removed like its claims.
            Ok(mut file) => file.write_all(line(&unique_name(), 0).as_bytes())?,
        }
        let is_same = read(&self.path).is_ok_and(|text| text == self.seen);
        if is_same {
            fs::rename(&self.path, &mark)?;
        }
        fs::remove_file(&mark)?;
        Ok(is_same)
    }
}

/// Removes claims in `folder` of processes that ended on this machine, and the marker files with which these processes reserved the removal of a
/// claim.
///
/// No process waits for the claim of a finished task, so nothing else would remove it. Links and files that are not claims are kept.
pub fn clear_dead_claims(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let path = entry.path();
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        let text = is_file.then(|| read(&path).ok()).flatten();
        if text.is_some_and(|text| is_line(&text) && ended_here(owner_of(&text))) {
            // The next call removes the rest.
            drop(Watch::new(&path).clear());
        }
    }
}

/// True if `text` has the form that [`line`] writes.
fn is_line(text: &str) -> bool {
    let count = text
        .strip_suffix('\n')
        .and_then(|text| text.split_once(' '));
    count.is_some_and(|(_, count)| {
        count.len() == 20 && count.bytes().all(|byte| byte.is_ascii_digit())
    })
}

/// Content of a claim file. Its length is constant, so that it can be overwritten in place.
fn line(owner: &str, count: u64) -> String {
    format!("{owner} {count:020}\n")
}

fn owner_of(text: &str) -> &str {
    text.split(' ').next().unwrap_or_default()
}

fn read(path: &Path) -> io::Result<String> {
    let mut text = String::new();
    File::open(path)?.take(4096).read_to_string(&mut text)?;
    Ok(text)
}

/// Name of this process: `MACHINE-PROCESS-START`, with [`machine`], the process id, and the start time.
fn process_name() -> String {
    static NAME: std::sync::OnceLock<String> = std::sync::OnceLock::new();
    let name = NAME.get_or_init(|| {
        let process = std::process::id();
        let start = start_of(process).unwrap_or_else(|| {
            let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
            now.map_or_else(|_| String::new(), |now| now.as_nanos().to_string())
        });
        format!("{}-{process}-{start}", machine())
    });
    name.clone()
}

/// Boot id of this machine and id of its process namespace, in digits and letters.
fn machine() -> String {
    let boot = fs::read_to_string("/proc/sys/kernel/random/boot_id").unwrap_or_default();
    let space = fs::read_link("/proc/self/ns/pid").unwrap_or_default();
    let words = format!("{}{}", boot.trim(), space.to_string_lossy());
    words.chars().filter(char::is_ascii_alphanumeric).collect()
}

/// Start time of a process, in clock ticks since boot; `None` if unknown.
fn start_of(process: u32) -> Option<String> {
    let text = fs::read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name may contain any character, so it ends at the last bracket. The start time is the twentieth word after it.
    let (_, rest) = text.rsplit_once(')')?;
    rest.split_whitespace().nth(19).map(str::to_owned)
}

/// True if `owner` was a process of this machine and has ended.
fn ended_here(owner: &str) -> bool {
    let mut parts = owner.split('-');
    let (Some(of), Some(process), Some(start)) = (parts.next(), parts.next(), parts.next()) else {
        return false;
    };
    if of.is_empty() || of != machine() {
        return false;
    }
    let Ok(process) = process.parse() else {
        return false;
    };
    start_of(std::process::id()).is_some() && start_of(process).as_deref() != Some(start)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(unix)]
    #[test]
    fn a_link_in_the_place_of_a_claim_is_refused() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("claim");
        std::os::unix::fs::symlink(folder.path(), &path).expect("linked");
        let refused = Claim::take(&path).map(|_| ()).expect_err("no claim");
        assert!(refused.to_string().ends_with("remove it"), "{refused}");
    }

    #[test]
    fn a_claim_is_had_once_and_free_when_it_is_given_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("work");
        let held = Claim::take(&path).expect("writable").expect("free");
        assert!(Claim::take(&path).expect("readable").is_none());
        assert!(
            !Watch::new(&path).clear().expect("readable"),
            "its owner lives"
        );
        drop(held);
        assert!(Claim::take(&path).expect("writable").is_some());
    }

    #[test]
    fn the_claim_of_a_process_that_ended_here_is_dead_at_once() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("work");
        let mut child = std::process::Command::new("true")
            .spawn()
            .expect("a program");
        let process = child.id();
        child.wait().expect("ended");
        let owner = format!("{}-{process}-1-0", machine());
        fs::write(&path, line(&owner, 7)).expect("written");
        assert!(Watch::new(&path).clear().expect("readable"));
        assert!(Claim::take(&path).expect("writable").is_some());
    }

    #[test]
    fn dead_claims_of_a_folder_go_and_living_ones_and_other_files_stay() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let dead = line(&format!("{}-999999999-1-0", machine()), 3);
        let held = Claim::take(&at("held")).expect("writable");
        fs::write(at("dead"), &dead).expect("written");
        fs::write(at(".a.b.dead"), &dead).expect("written");
        fs::write(at("elsewhere"), line("elsewhere-1-1-0", 3)).expect("written");
        fs::write(at("notes"), "mine").expect("written");
        clear_dead_claims(folder.path());
        let names = fs::read_dir(folder.path()).expect("listed").flatten();
        let mut names: Vec<_> = names.map(|entry| entry.file_name()).collect();
        names.sort();
        assert_eq!(names, ["elsewhere", "held", "notes"]);
        drop(held);
    }

    #[test]
    fn the_claim_of_another_machine_is_dead_once_its_number_stands_still_whatever_the_clocks_say() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("work");
        let owner = "elsewhere-1-1-0";
        fs::write(&path, line(owner, 0)).expect("written");
        // One hour ahead, as the clock of another machine may be.
        let ahead = std::time::SystemTime::now() + Duration::from_secs(3600);
        let file = File::options().append(true).open(&path).expect("there");
        file.set_modified(ahead).expect("dated");
        let short = Duration::from_millis(80);
        let mut watch = Watch::new(&path);
        for count in 1..6 {
            std::thread::sleep(short / 4);
            fs::write(&path, line(owner, count)).expect("counted");
            assert!(
                !watch.clear_after(short * 100).expect("readable"),
                "{count}"
            );
        }
        std::thread::sleep(short * 2);
        assert!(watch.clear_after(short).expect("readable"));
        assert!(!path.exists());
    }

    #[test]
    fn of_many_who_see_a_dead_claim_one_alone_has_it_next() {
        for _ in 0..20 {
            let folder = tempfile::tempdir().expect("a folder");
            let path = folder.path().join("work");
            fs::write(&path, line(&format!("{}-999999999-1-0", machine()), 3)).expect("written");
            let had: usize = std::thread::scope(|scope| {
                let all: Vec<_> = (0..6)
                    .map(|_| {
                        scope.spawn(|| {
                            let mut watch = Watch::new(&path);
                            watch.clear().expect("readable");
                            let claim = Claim::take(&path).expect("writable");
                            std::thread::sleep(Duration::from_millis(20));
                            claim
                        })
                    })
                    .collect();
                let claims: Vec<_> = all
                    .into_iter()
                    .map(|one| one.join().expect("no panic"))
                    .collect();
                claims.iter().flatten().count()
            });
            assert_eq!(had, 1);
        }
    }
}
