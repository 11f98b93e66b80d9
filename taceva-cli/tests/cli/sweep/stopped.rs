//! Stopped or killed sweeps resume to the same bytes.

use std::fs;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::store::whole;
use super::{count, small, text, week};
use crate::support::sweeps::{TASKS, bytes};

#[test]
fn a_sweep_that_is_interrupted_stops_cleanly_and_goes_on() {
    let bench = whole();
    let child = bench
        .command("sweep which.toml --jobs 2")
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("it starts");
    let results = bench.path("which.sweep/results");
    while count(&results) < 2 {
        std::thread::sleep(Duration::from_millis(5));
    }
    let pid = child.id().to_string();
    Command::new("kill")
        .args(["-INT", &pid])
        .status()
        .expect("sent");
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(5), "{said}");
    assert!(said.contains("continues from here"), "{said}");
    assert!(count(&results) < TASKS);
    assert_eq!(count(&bench.path("which.sweep/claims")), 0);
    bench.ok("sweep which.toml -q");
    assert_eq!(bytes(&bench, "which.sweep"), bytes(&bench, "one"));
}

/// Kills a sweep `TACEVA_SWEEP_KILLS` times at random moments; the sweep resumes each time.
#[test]
fn a_sweep_that_is_killed_at_random_moments_ends_with_the_same_bytes_and_counts_no_task_twice() {
    let kills = std::env::var("TACEVA_SWEEP_KILLS");
    let kills: usize = kills.map_or(6, |text| {
        text.parse().expect("TACEVA_SWEEP_KILLS is a number")
    });
    let bench = whole();
    let reference = bytes(&bench, "one");
    let mut state = 20_261_125_u64;
    let (mut done, mut sweeps) = (0, 0);
    while done < kills {
        sweeps += 1;
        let folder = format!("killed-{sweeps}");
        loop {
            let words = format!("sweep which.toml -q --jobs 2 --out {folder}");
            let mut child = bench
                .command(&words)
                .stdout(Stdio::null())
                .spawn()
                .expect("it starts");
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            std::thread::sleep(Duration::from_millis((state >> 33) % 400));
            drop(child.kill());
            let status = child.wait().expect("it ended");
            done += usize::from(!status.success());
            if status.success() || done >= kills {
                break;
            }
        }
        let out = bench.ok(&format!("sweep which.toml -q --jobs 2 --out {folder}"));
        assert!(
            out.contains(&format!("{TASKS} scored, 0 failed, 0 missing")),
            "{out}"
        );
        assert_eq!(bytes(&bench, &folder), reference, "after {done} kills");
        let table = text(&bench, &format!("{folder}/table.csv"));
        let mut rows: Vec<&str> = table.lines().collect();
        let before = rows.len();
        rows.sort_unstable();
        rows.dedup();
        assert_eq!(rows.len(), before, "a row twice");
        fs::remove_dir_all(bench.path(&folder)).expect("removed");
    }
    assert!(done >= kills);
}

#[test]
fn a_stale_claim_of_a_process_that_ended_stops_nobody() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q --only model=baseline");
    // A process that is killed while it holds claims.
    let mut child = bench
        .command("sweep which.toml -q --jobs 1")
        .spawn()
        .expect("it starts");
    let claims = bench.path("which.sweep/claims");
    while count(&claims) == 0 && child.try_wait().expect("it runs").is_none() {
        std::thread::sleep(Duration::from_millis(2));
    }
    drop(child.kill());
    child.wait().expect("it ended");
    let out = bench.ok("sweep which.toml -q");
    assert!(out.contains("8 scored, 0 failed, 0 missing"), "{out}");
    assert_eq!(count(&claims), 0);
}
