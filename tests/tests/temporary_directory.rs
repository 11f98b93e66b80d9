//! Tests of a directory for temporary files that is on another file system, is full, or belongs to another user. Also tests a home directory that is
//! not a folder.

use std::fs::Permissions;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use taceva_needs::{Need, skip};
use taceva_tests::{Form, Lab, taceva};

/// A user without rights of its own.
const NOBODY: u32 = 65_534;
/// Exit code for invalid input and for errors of the system.
const REFUSED: Option<i32> = Some(3);

/// An archive, its map and the dataset made of it, in a folder that every user may read.
struct Bench {
    folder: tempfile::TempDir,
    program: PathBuf,
}

impl Bench {
    fn new() -> Bench {
        let bench = Bench {
            folder: tempfile::tempdir().expect("a folder"),
            program: taceva(),
        };
        open_to_all(&bench.path("."), 0o755);
        let lab = Lab::drawn(Form::Png, 12);
        let file = std::fs::File::create(bench.path("lab.tar")).expect("room");
        let mut tar = tar::Builder::new(file);
        tar.append_dir_all("lab", lab.path()).expect("packed");
        tar.finish().expect("written");
        std::fs::copy(lab.map(), bench.path("map.toml")).expect("copied");
        std::fs::create_dir(bench.path("temporary")).expect("made");
        let made = bench.run("import lab.tar --map map.toml --out set");
        assert!(made.status.success(), "{}", complaint(&made));
        bench
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The program, with its temporary files in `temporary`.
    fn command(&self, words: &str) -> Command {
        let mut command = Command::new(&self.program);
        command
            .args(words.split_whitespace())
            .arg("-q")
            .current_dir(self.folder.path())
            .env("TMPDIR", self.path("temporary"))
            .env("HOME", self.folder.path())
            .stdin(Stdio::null());
        command
    }

    fn run(&self, words: &str) -> Output {
        self.command(words).output().expect("it starts")
    }
}

fn open_to_all(path: &Path, mode: u32) {
    std::fs::set_permissions(path, Permissions::from_mode(mode)).expect("own");
}

fn complaint(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn count(folder: &Path) -> usize {
    folder.read_dir().expect("there").count()
}

/// Commands that unpack into the directory of temporary files.
const UNPACKING: [&str; 2] = ["import lab.tar --draft", "check set --source lab.tar"];

#[test]
fn a_temporary_directory_on_another_file_system_changes_no_result_and_stays_empty() {
    let bench = Bench::new();
    let memory = Path::new("/dev/shm");
    let device = |path: &Path| std::fs::metadata(path).map(|facts| facts.dev()).ok();
    let here = device(&bench.path("."));
    if !memory.is_dir() || device(memory) == here {
        return skip(Need::Mount, "no other file system at /dev/shm");
    }
    let elsewhere = tempfile::tempdir_in(memory).expect("a folder in memory");
    for words in UNPACKING {
        let expected = bench.run(words);
        assert!(expected.status.success(), "{}", complaint(&expected));
        let mut command = bench.command(words);
        command.env("TMPDIR", elsewhere.path());
        let found = command.output().expect("it starts");
        assert_eq!(found.stdout, expected.stdout, "{}", complaint(&found));
        assert!(found.status.success(), "{}", complaint(&found));
        assert_eq!(count(elsewhere.path()), 0, "{words}");
    }
    assert_eq!(count(&bench.path("temporary")), 0);
}

#[test]
fn a_full_temporary_directory_is_named_with_the_remedy_and_stays_empty() {
    let bench = Bench::new();
    for words in UNPACKING {
        let mut command = Command::new("unshare");
        command
            .args(["--mount", "sh", "-c"])
            .arg("mount -t tmpfs -o size=12k tmpfs temporary || exit 99; \"$@\"; code=$?; ls -A temporary; exit $code")
            .arg("sh")
            .arg(&bench.program)
            .args(words.split_whitespace())
            .arg("-q")
            .current_dir(bench.path("."))
            .env("TMPDIR", bench.path("temporary"));
        let output = match command.output() {
            Ok(output) => output,
            Err(error) => return skip(Need::Mount, error),
        };
        let problem = complaint(&output);
        if output.status.code() == Some(99) || problem.starts_with("unshare:") {
            return skip(Need::Mount, problem);
        }
        assert_eq!(output.status.code(), REFUSED, "{words}: {problem}");
        for word in ["unpack into", "temporary", "No space left", "TMPDIR"] {
            assert!(problem.contains(word), "no `{word}` in {problem}");
        }
        let left = String::from_utf8_lossy(&output.stdout);
        assert_eq!(left, "", "{words}: {problem}");
    }
}

#[test]
fn a_temporary_directory_of_another_owner_is_used_where_it_may_be_and_named_where_not() {
    let mut bench = Bench::new();
    let temporary = bench.path("temporary");
    let is_root = std::fs::metadata("/proc/self").is_ok_and(|facts| facts.uid() == 0);
    if !is_root {
        return skip(Need::Mount, "only root makes folders of another owner");
    }
    // At a path from which every user may start it.
    bench.program = bench.path("taceva");
    std::fs::copy(taceva(), &bench.program).expect("copied");
    let as_nobody = |words: &str| {
        let mut command = bench.command(words);
        command.uid(NOBODY).gid(NOBODY);
        command.output().expect("it starts")
    };
    for words in UNPACKING {
        open_to_all(&temporary, 0o755);
        let refused = as_nobody(words);
        let problem = complaint(&refused);
        assert_eq!(refused.status.code(), REFUSED, "{words}: {problem}");
        for word in ["unpack into", "temporary", "Permission denied", "TMPDIR"] {
            assert!(problem.contains(word), "no `{word}` in {problem}");
        }
        open_to_all(&temporary, 0o1777);
        // A folder of another user at a name like ours is left alone.
        let theirs = temporary.join(".taceva-unpacked-abcdef");
        std::fs::create_dir_all(&theirs).expect("made");
        std::fs::write(theirs.join(".taceva-temporary"), "").expect("written");
        let done = as_nobody(words);
        assert!(done.status.success(), "{words}: {}", complaint(&done));
        assert_eq!(count(&temporary), 1, "{words}");
        assert!(theirs.join(".taceva-temporary").exists(), "{words}");
    }
}

#[test]
fn drafts_of_one_archive_at_once_all_succeed() {
    let bench = Bench::new();
    let words = "import lab.tar --draft";
    let expected = bench.run(words).stdout;
    let start = |_| {
        let mut command = bench.command(words);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command.spawn().expect("it starts")
    };
    let running: Vec<Child> = (0..8).map(start).collect();
    for draft in running {
        let output = draft.wait_with_output().expect("it ends");
        assert!(output.status.success(), "{}", complaint(&output));
        assert_eq!(output.stdout, expected);
    }
    assert_eq!(count(&bench.path("temporary")), 0);
}

#[test]
fn a_home_that_is_no_folder_stops_only_the_command_that_lists_the_cache() {
    let bench = Bench::new();
    for (words, code) in [
        ("import lab.tar --draft", 0),
        ("check set", 0),
        ("evaluate set --model ridge", 0),
        ("fit set --model ridge --out model", 0),
        ("catalogue list", 0),
        ("plugin list", 0),
        ("cache list", 3),
    ] {
        let mut command = bench.command(words);
        for folder in ["CACHE", "CONFIG", "DATA", "STATE"] {
            command.env_remove(format!("XDG_{folder}_HOME"));
        }
        let output = command
            .env("HOME", "/dev/null")
            .output()
            .expect("it starts");
        assert_eq!(
            output.status.code(),
            Some(code),
            "{words}: {}",
            complaint(&output)
        );
    }
}
