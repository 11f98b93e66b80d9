//! A skip is recorded, or fails if the need is required.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::process::{Command, Output};

use taceva_needs::{LIST, Need, UnknownNeed, required, skip};

/// Test that the other tests of this file run in a separate process, with another environment.
#[test]
fn a_test_that_finds_no_gpu() {
    if std::env::var_os("TACEVA_NEEDS_TRIAL").is_some() {
        skip(Need::Gpu, "this is a trial");
    }
}

/// Runs the helper with `TACEVA_REQUIRE` set to `value`, in a folder like cargo's target folder. Returns its output and the list.
fn trial(value: &str) -> (Output, String) {
    let this = std::env::current_exe().expect("a test knows where it is");
    let folder = std::env::temp_dir().join(format!(
        "taceva-needs-{}-{}",
        std::process::id(),
        value.replace(',', "-")
    ));
    std::fs::create_dir_all(&folder).expect("room");
    std::fs::write(folder.join("CACHEDIR.TAG"), "").expect("room");
    let program = folder.join("trial-0");
    std::fs::copy(this, &program).expect("room");
    let mut command = Command::new(&program);
    command
        .arg("a_test_that_finds_no_gpu")
        .env("TACEVA_NEEDS_TRIAL", "1")
        .env("TACEVA_REQUIRE", value)
        .env_remove("TACEVA_SKIPPED");
    let output = loop {
        match command.output() {
            // A process that another test has just forked holds the copy open for writing until it executes its own program.
            Err(error) if error.kind() == ErrorKind::ExecutableFileBusy => std::thread::yield_now(),
            done => break done.expect("it runs"),
        }
    };
    let list = std::fs::read_to_string(folder.join(LIST)).unwrap_or_default();
    std::fs::remove_dir_all(folder).expect("ours");
    (output, list)
}

#[test]
fn a_skip_is_written_into_the_list() {
    let (output, list) = trial("browser,strace");
    assert!(output.status.success(), "{output:?}");
    assert_eq!(
        list,
        "gpu\tthis is a trial\ttrial\ta_test_that_finds_no_gpu\n"
    );
}

#[test]
fn a_need_that_is_required_fails_its_test_and_says_so() {
    let (output, list) = trial("browser,gpu");
    assert!(!output.status.success());
    let said = String::from_utf8_lossy(&output.stdout);
    let expected = "TACEVA_REQUIRE names `gpu`, which is missing: this is a trial";
    assert!(said.contains(expected), "{said}");
    assert_eq!(list, "");
}

#[test]
fn a_slip_in_a_requirement_fails_every_test_that_skips() {
    let (output, _) = trial("strase");
    assert!(!output.status.success());
}

#[test]
fn every_word_stands_for_its_need_and_no_other_word_for_any() {
    for need in Need::ALL {
        let found = required(Some(OsStr::new(need.word()))).expect("a word of a need");
        assert_eq!(Vec::from_iter(found), [need]);
    }
    assert_eq!(required(None), Ok([].into()));
    assert_eq!(required(Some(OsStr::new(" , "))), Ok([].into()));
    let error = required(Some(OsStr::new("strace,brwoser"))).expect_err("a slip");
    assert_eq!(error, UnknownNeed("brwoser".to_owned()));
    assert!(error.to_string().contains("expected words of browser, axe"));
}

#[test]
fn what_this_run_requires_are_needs_that_exist() {
    let value = std::env::var_os("TACEVA_REQUIRE");
    if let Err(error) = required(value.as_deref()) {
        panic!("{error}");
    }
}
