//! Sweeps: the same table however it is made, and what is refused.

mod support;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use support::Bench;
use support::sweeps::{self, SWEEP, TASKS, bytes};

fn week() -> Bench {
    sweeps::week("")
}

fn small(bench: &Bench, changed: &[(&str, &str)]) {
    let mut text = SWEEP
        .replace("\"1-3\"", "[1]")
        .replace("[\"monday\", \"tuesday\"]", "[\"monday\"]");
    for (old, new) in changed {
        assert!(text.contains(old), "{old}");
        text = text.replace(old, new);
    }
    bench.write("which.toml", &text);
}

fn text(bench: &Bench, name: &str) -> String {
    fs::read_to_string(bench.path(name)).expect(name)
}

fn count(folder: &Path) -> usize {
    fs::read_dir(folder).map_or(0, |entries| {
        let names = entries.map(|entry| entry.expect("readable").file_name());
        names
            .filter(|name| !name.to_string_lossy().starts_with('.'))
            .count()
    })
}

#[test]
fn one_worker_two_workers_and_two_sweeps_at_once_give_the_same_bytes_and_each_task_is_made_once() {
    let bench = week();
    let out = bench.ok("sweep which.toml --out one --jobs 1 -q");
    assert!(
        out.contains(&format!("{TASKS} scored, 0 failed, 0 missing")),
        "{out}"
    );
    let reference = bytes(&bench, "one");
    let printed = out
        .lines()
        .find_map(|line| line.strip_prefix("digest   "))
        .expect(&out);
    let digest = taceva_dataset::Digest::of(&reference[0]).to_string();
    assert_eq!(printed, digest);
    bench.ok("sweep which.toml --out two --jobs 2 -q");
    assert_eq!(bytes(&bench, "two"), reference);
    // A part of the tasks first: a table of what is there, and the rest in another order.
    let part = bench.ok("sweep which.toml --out parts --jobs 2 -q --only seed=2");
    assert!(part.contains("16 scored, 0 failed, 32 missing"), "{part}");
    let both: Vec<_> = (0..2)
        .map(|_| {
            let mut command = bench.command("sweep which.toml --out parts --jobs 1 -q");
            command.stdout(Stdio::null()).spawn().expect("it starts")
        })
        .collect();
    for mut one in both {
        assert!(one.wait().expect("it ends").success());
    }
    bench.ok("sweep which.toml --out parts -q");
    assert_eq!(bytes(&bench, "parts"), reference);
    for entry in fs::read_dir(bench.path("parts/logs")).expect("logs") {
        let log = fs::read_to_string(entry.expect("readable").path()).expect("text");
        assert_eq!(log.matches("\nscored").count(), 1, "{log}");
    }
    assert_eq!(count(&bench.path("parts/claims")), 0);
    // Each frame once for each of the two sizes, whatever was learnt from it.
    assert_eq!(count(&bench.path("one/cache/2/features")), 4);
    assert_eq!(text(&bench, "one/times.csv").lines().count(), TASKS + 1);
}

#[test]
fn a_finished_sweep_is_looked_at_and_not_carried_out_again() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q");
    let times = text(&bench, "which.sweep/times.csv");
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(
        dry.contains("tasks    8, 0") && dry.contains("found    8"),
        "{dry}"
    );
    bench.ok("sweep which.toml -q");
    assert_eq!(text(&bench, "which.sweep/times.csv"), times);
    let shown = bench.ok("sweep show which.toml --by model,size --format csv");
    assert!(shown.starts_with("model,size,channel,mean,"), "{shown}");
    assert!(shown.contains("\nridge,8x8,Fz,"), "{shown}");
    let status = bench.ok("sweep status which.toml");
    assert!(status.contains("8: 8 scored, 0 failed, 0 left"), "{status}");
    bench.refused(
        "sweep show which.toml --by modell",
        2,
        "did you mean `model`?",
    );
    // More seeds: what is there is found, the rest is estimated by what was measured.
    small(&bench, &[("seeds = [1]", "seeds = [1, 2]")]);
    let dry = bench.ok("sweep which.toml --dry-run --jobs 1");
    assert!(
        dry.contains("tasks    16") && dry.contains("found    8"),
        "{dry}"
    );
    assert!(
        dry.contains("time     about") && dry.contains("disk     about"),
        "{dry}"
    );
}

#[test]
fn the_page_chooses_on_validation_parts_and_keeps_times_apart() {
    let bench = week();
    bench.ok("sweep which.toml -q");
    let page = text(&bench, "which.sweep/page.html");
    for words in [
        "Best of each question",
        "Test parts took no part in any choice",
        "95 % over contact points",
        "95 % over seeds",
        "Effect of each setting",
        "Holm",
        "Nothing here was measured",
    ] {
        assert!(page.contains(words), "{words}");
    }
    assert!(!page.contains("s a task"));
    assert!(text(&bench, "which.sweep/times.html").contains("s a task"));
    // What is chosen has the least error on validation parts of all that it was chosen among, by the table alone.
    let table = text(&bench, "which.sweep/table.csv");
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let head: Vec<String> = reader
        .headers()
        .expect("a head")
        .iter()
        .map(str::to_owned)
        .collect();
    let at = |name: &str| head.iter().position(|known| known == name).expect(name);
    let mut sums = std::collections::BTreeMap::<(String, String), f64>::new();
    for row in reader.records() {
        let row = row.expect("a row");
        if &row[at("part")] == "validation"
            && &row[at("channel")] == "Fz"
            && &row[at("dataset")] == "monday"
        {
            let of = (row[at("model")].to_owned(), row[at("set.size")].to_owned());
            *sums.entry(of).or_default() += row[at("value")].parse::<f64>().expect("a number");
        }
    }
    assert_eq!(sums.len(), 8);
    let least = sums
        .iter()
        .min_by(|left, right| left.1.total_cmp(right.1))
        .expect("eight");
    let (_, row) = page.split_once("normal force").expect("a question");
    let row = row.split("</tr>").next().expect("a row");
    let (model, size) = least.0;
    assert!(
        row.contains(&format!("{model} ")) && row.contains(&format!("size={size}")),
        "{least:?}: {row}"
    );
}

#[test]
fn a_failed_task_is_a_row_with_its_reason_and_its_log_and_the_others_go_on() {
    let bench = week();
    bench.record_nothing("nothing");
    small(&bench, &[("[\"monday\"]", "[\"monday\", \"nothing\"]")]);
    let ran = bench.run("sweep which.toml");
    assert_eq!(ran.code, 1, "{}{}", ran.out, ran.err);
    assert!(
        ran.out.contains("8 scored, 8 failed, 0 missing"),
        "{}",
        ran.out
    );
    assert!(
        ran.err.contains("failed: ridge size=12x12 of nothing") && ran.err.contains(".log"),
        "{}",
        ran.err
    );
    let table = text(&bench, "which.sweep/table.csv");
    let failed: Vec<&str> = table
        .lines()
        .filter(|line| line.contains(",failed,"))
        .collect();
    assert_eq!(failed.len(), 8);
    assert!(
        failed[0].contains("the dataset has 0 rows"),
        "{}",
        failed[0]
    );
    let key = failed[0].split(',').next().expect("a key");
    let log = text(&bench, &format!("which.sweep/logs/{key}.log"));
    assert!(log.contains("failed: ") && log.contains("0 rows"), "{log}");
    assert!(text(&bench, "which.sweep/page.html").contains("Tasks without a result"));
    // Not again by itself, and again where that is asked for.
    let attempts = |bench: &Bench| {
        text(bench, &format!("which.sweep/logs/{key}.log"))
            .matches("failed: ")
            .count()
    };
    assert_eq!(bench.run("sweep which.toml -q").code, 1);
    assert_eq!(attempts(&bench), 1);
    assert_eq!(bench.run("sweep which.toml -q --retry-failed").code, 1);
    assert_eq!(attempts(&bench), 2);
}

#[test]
fn units_are_held_to_limits_one_by_one() {
    let bench = week();
    fs::create_dir(bench.path("units")).expect("made");
    for name in ["monday", "tuesday"] {
        fs::rename(bench.path(name), bench.path("units").join(name)).expect("moved");
    }
    bench.write("limits.toml", "limits_version = 1\nname = \"line 3\"\n[[limit]]\nmetric = \"mae\"\nchannel = \"Fz\"\nunit = \"N\"\nmost = 100.0\n");
    let units = "sweep_version = 1\ndatasets = \"units/*\"\nmodels = [\"ridge\"]\nlimits = \"limits.toml\"\nmetrics = [\"accuracy\"]\nsplits = [\"by-point 40/10/50\"]\n[vary]\nsize = [\"8x8\"]\n";
    bench.write("units.toml", units);
    let out = bench.ok("sweep units.toml -q");
    assert_eq!(out.matches("pass").count(), 2, "{out}");
    let strict = text(&bench, "limits.toml").replace("100.0", "0.0");
    bench.write("limits.toml", &strict);
    let ran = bench.run("sweep units.toml -q");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert_eq!(ran.out.matches("FAIL").count(), 2, "{}", ran.out);
    assert!(text(&bench, "units.sweep/units.csv").contains("units/tuesday"));
}

#[test]
fn an_unknown_key_is_refused_with_its_line_and_the_nearest_key() {
    let bench = week();
    small(&bench, &[("seeds =", "seed =")]);
    bench.refused(
        "sweep which.toml",
        3,
        "which.toml, line 6: `seed`: unknown key, did you mean `seeds`?",
    );
    small(&bench, &[("set = {", "sett = {")]);
    bench.refused(
        "sweep which.toml",
        3,
        "`sett`: unknown key of a model, did you mean `set`?",
    );
    small(&bench, &[("size = [", "sise = [")]);
    bench.refused("sweep which.toml", 3, "did you mean `size`?");
    small(&bench, &[("\"pls\"", "\"plss\"")]);
    bench.refused("sweep which.toml", 3, "did you mean `pls`?");
    assert!(!bench.path("which.sweep").exists());
}

#[test]
fn a_grid_of_ten_million_tasks_is_refused_with_the_count() {
    let bench = week();
    small(&bench, &[("[1]", "\"1-1250000\"")]);
    bench.refused(
        "sweep which.toml",
        3,
        "a grid of 1250000 tasks for each model by its seeds alone",
    );
    let seeds: Vec<String> = (0..1250).map(|seed| seed.to_string()).collect();
    let sizes: Vec<String> = (1..=2000)
        .map(|size| format!("\"{size}x{size}\""))
        .collect();
    small(
        &bench,
        &[
            ("[1]", &format!("[{}]", seeds.join(","))),
            ("[\"8x8\", \"12x12\"]", &format!("[{}]", sizes.join(","))),
        ],
    );
    bench.refused(
        "sweep which.toml",
        3,
        "a grid of 10000000 tasks (1 datasets × 4 models × 1250 seeds",
    );
}

#[test]
fn an_empty_grid_is_refused_with_what_empties_it() {
    let bench = week();
    small(&bench, &[("seeds = [1]", "seeds = []")]);
    bench.refused(
        "sweep which.toml",
        3,
        "line 6: an empty grid: `seeds` has no entry",
    );
    small(&bench, &[("[\"monday\"]", "\"units/*\"")]);
    bench.refused("sweep which.toml", 3, "`units/*`: no folder matches");
    small(
        &bench,
        &[("[vary]", "[skip]\nwhere = [\"model != none\"]\n[vary]")],
    );
    bench.refused(
        "sweep which.toml",
        3,
        "`[skip]` leaves out all 8 combinations",
    );
    small(
        &bench,
        &[("[vary]", "[skip]\nwhere = [\"modell = ridge\"]\n[vary]")],
    );
    bench.refused(
        "sweep which.toml",
        3,
        "no task has `modell`: did you mean `model`?",
    );
}

#[test]
fn a_recording_that_changes_between_submission_and_execution_fails_its_tasks_and_says_so() {
    let bench = week();
    small(&bench, &[]);
    // Planned, and carried out by a job later.
    bench.ok("sweep which.toml -q --only model=baseline");
    fs::remove_dir_all(bench.path("monday")).expect("removed");
    bench.record_with_noise("monday", 24, 3);
    let ran = bench.run("sweep task which.sweep --tasks which.sweep/tasks.json --at 0,1");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.err
            .contains("another one than when the sweep was planned"),
        "{}",
        ran.err
    );
    let collected = bench.run("sweep collect which.toml");
    assert!(collected.out.contains("2 failed"), "{}", collected.out);
    // Planned anew it has other keys, so that no result of the former recording is taken for one of this.
    let out = bench.ok("sweep which.toml -q");
    assert!(out.contains("8 scored, 0 failed"), "{out}");
}

#[test]
fn a_result_of_another_version_or_one_that_was_changed_is_refused_by_name() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q");
    let results = bench.path("which.sweep/results");
    let first = fs::read_dir(&results)
        .expect("results")
        .next()
        .expect("one")
        .expect("readable")
        .path();
    let whole = fs::read_to_string(&first).expect("text");
    let mut json: serde_json::Value = serde_json::from_str(&whole).expect("JSON");
    json["taceva"] = "0.0.9".into();
    fs::write(&first, json.to_string()).expect("changed");
    bench.refused(
        "sweep collect which.toml",
        3,
        "was changed after it was sealed",
    );
    // As that version wrote it, sealed.
    json.as_object_mut().expect("an object").remove("seal");
    let sealed = taceva_seal::json::seal(&json.to_string()).expect("JSON");
    fs::write(&first, sealed).expect("written");
    bench.refused("sweep collect which.toml", 3, "a result of TacEva 0.0.9");
    fs::remove_file(&first).expect("removed");
    bench.ok("sweep which.toml -q");
}

#[test]
fn a_stale_claim_of_a_process_that_ended_stops_nobody() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q --only model=baseline");
    // A process that is killed with its claims held.
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

#[test]
fn a_folder_that_is_not_shared_is_named_by_the_job_that_misses_it() {
    let bench = week();
    bench.refused(
        "sweep task nowhere --tasks nowhere/tasks.json --at 0",
        3,
        "is the folder of the sweep shared with this machine?",
    );
}

#[test]
fn a_collector_that_is_started_early_makes_a_table_of_what_is_there_and_says_what_is_missing() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q --only model=baseline");
    let ran = bench.run("sweep collect which.toml");
    assert_eq!(ran.code, 1, "{}", ran.err);
    assert!(
        ran.out.contains("2 scored, 0 failed, 6 missing"),
        "{}",
        ran.out
    );
    assert_eq!(
        text(&bench, "which.sweep/table.csv")
            .matches(",missing,")
            .count(),
        6
    );
    bench.ok("sweep which.toml -q");
    bench.ok("sweep which.toml -q --out other");
    assert_eq!(bytes(&bench, "which.sweep"), bytes(&bench, "other"));
}

#[test]
fn an_absent_sbatch_is_said_in_the_words_of_the_system_and_the_scripts_stay() {
    let bench = week();
    small(&bench, &[]);
    let mut command = bench.command("sweep which.toml --on slurm -q");
    let output = command
        .env("PATH", bench.path("nothing"))
        .output()
        .expect("it runs");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert!(said.contains("sbatch: cannot be started"), "{said}");
    let script = text(&bench, "which.sweep/slurm/tasks-1.sh");
    assert!(
        script.contains("#SBATCH --array=0-7\n") && script.contains("--requeue"),
        "{script}"
    );
}

#[test]
fn the_lines_of_a_list_carried_out_by_any_program_that_starts_commands_give_the_same_bytes() {
    let bench = week();
    small(&bench, &[]);
    bench.ok("sweep which.toml -q --out here");
    let lines = bench.ok("sweep which.toml -q --on list");
    let (collect, tasks) = lines
        .trim_end()
        .rsplit_once('\n')
        .map(|(tasks, last)| (last, tasks))
        .expect("lines");
    assert_eq!(tasks.lines().count(), 8);
    let program = Path::new(env!("CARGO_BIN_EXE_taceva"))
        .parent()
        .expect("a folder");
    let path = format!(
        "{}:{}",
        program.display(),
        std::env::var("PATH").expect("a path")
    );
    // Two at once, in the reverse of their order.
    let reversed: Vec<&str> = tasks.lines().rev().collect();
    bench.write("tasks.txt", &reversed.join("\n"));
    let script = format!("xargs -P 2 -I LINE sh -c LINE < tasks.txt && {collect}");
    let mut shell = Command::new("sh");
    shell.args(["-c", &script]).current_dir(bench.path("."));
    let output = shell.env("PATH", path).output().expect("a shell");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert_eq!(bytes(&bench, "which.sweep"), bytes(&bench, "here"));
}

#[test]
fn a_sweep_that_is_interrupted_stops_cleanly_and_goes_on() {
    let bench = week();
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
    assert!(said.contains("goes on from here"), "{said}");
    assert!(count(&results) < TASKS);
    assert_eq!(count(&bench.path("which.sweep/claims")), 0);
    bench.ok("sweep which.toml -q");
    bench.ok("sweep which.toml -q --out whole");
    assert_eq!(bytes(&bench, "which.sweep"), bytes(&bench, "whole"));
}

/// As many kills as `TACEVA_SWEEP_KILLS` says, at random moments of a sweep that goes on each time.
#[test]
fn a_sweep_that_is_killed_at_random_moments_ends_with_the_same_bytes_and_counts_no_task_twice() {
    let kills = std::env::var("TACEVA_SWEEP_KILLS");
    let kills: usize = kills.map_or(6, |text| {
        text.parse().expect("TACEVA_SWEEP_KILLS is a number")
    });
    let bench = week();
    bench.ok("sweep which.toml -q --out whole");
    let reference = bytes(&bench, "whole");
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
fn a_recording_whose_header_changed_is_another_one_and_scored_anew() {
    let bench = week();
    small(&bench, &[("\"8x8\", \"12x12\"", "\"8x8\"")]);
    bench.ok("sweep which.toml -q");
    let before = text(&bench, "which.sweep/table.csv");
    let header = text(&bench, "monday/dataset.toml");
    assert!(header.contains("\"drawn\""), "{header}");
    bench.write(
        "monday/dataset.toml",
        &header.replace("\"drawn\"", "\"drawn again\""),
    );
    bench.ok("reseal monday --reason corrected -q");
    bench.ok("sweep which.toml -q");
    let after = text(&bench, "which.sweep/table.csv");
    assert!(before.contains(",drawn,"), "{before}");
    assert!(
        after.contains(",drawn again,") && !after.contains(",drawn,"),
        "{after}"
    );
}

#[test]
fn what_would_share_one_result_is_refused_by_both_names() {
    let bench = week();
    small(&bench, &[("[\"monday\"]", "[\"monday\", \"./monday\"]")]);
    bench.refused(
        "sweep which.toml",
        3,
        "`monday` and `./monday` are one recording",
    );
    small(&bench, &[("\"pls\"", "\"ridge\"")]);
    bench.refused("sweep which.toml", 3, "the model ridge is named twice");
    small(&bench, &[("size = [\"8x8\", \"12x12\"]", "seed = [1, 2]")]);
    bench.refused("sweep which.toml", 3, "`seed` varies by `seeds`");
}

#[test]
fn settings_of_a_model_that_are_no_table_are_refused_and_not_left_out() {
    let bench = week();
    small(
        &bench,
        &[("set = { neighbours = 3 }", "set = \"neighbours=3\"")],
    );
    bench.refused("sweep which.toml", 3, "`set` of the model knn: expected {");
}

#[test]
fn lines_of_a_list_are_words_of_a_shell_whatever_the_folder_is_called() {
    let bench = week();
    small(&bench, &[]);
    let mut command = bench.command("sweep which.toml --on list -q");
    let listed = command.args(["--out", "it's; touch made"]).output();
    let listed = listed.expect("it starts").stdout;
    let script = String::from_utf8(listed).expect("text");
    assert!(script.contains("'\\''s; touch made"), "{script}");
    let harmless = script.replace("taceva sweep", "true");
    let status = Command::new("sh")
        .args(["-c", &harmless])
        .current_dir(bench.path(""))
        .status();
    assert!(status.expect("sh").success());
    assert!(!bench.path("made").exists());
}

#[test]
fn a_sensor_file_that_changes_between_submission_and_execution_stops_its_tasks_and_says_so() {
    let bench = week();
    let sensor = "model = \"drawn\"\nopaque = true\n";
    bench.write("sensor.toml", sensor);
    small(
        &bench,
        &[("metrics =", "sensor = \"sensor.toml\"\nmetrics =")],
    );
    bench.ok("sweep which.toml -q --only model=baseline");
    bench.write("sensor.toml", &sensor.replace("true", "false"));
    bench.refused(
        "sweep task which.sweep --tasks which.sweep/tasks.json --at 0,1",
        3,
        "sensor.toml: it is another file than when the sweep was planned; start the sweep again",
    );
    // Planned anew no result with the former facts is taken for one with these.
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("found    0"), "{dry}");
    bench.write("sensor.toml", sensor);
    bench.ok("sweep which.toml -q");
}

#[test]
fn a_flipped_bit_of_the_list_of_tasks_or_of_an_evaluation_is_noticed() {
    let bench = week();
    small(&bench, &[("\"8x8\", \"12x12\"", "\"8x8\"")]);
    bench.ok("sweep which.toml -q");
    let list = text(&bench, "which.sweep/tasks.json");
    bench.write(
        "which.sweep/tasks.json",
        &list.replacen("\"seed\":1", "\"seed\":2", 1),
    );
    for words in ["collect which.toml", "status which.toml", "show which.toml"] {
        bench.refused(
            &format!("sweep {words}"),
            3,
            "`tasks[0].seed` was changed after it was sealed",
        );
    }
    bench.ok("sweep which.toml -q");
    let evaluations = fs::read_dir(bench.path("which.sweep/evaluations")).expect("evaluations");
    let path = evaluations.flatten().next().expect("one").path();
    let mut evaluation = fs::read(&path).expect("bytes");
    let middle = evaluation.len() / 2;
    evaluation[middle] ^= 1;
    fs::write(&path, evaluation).expect("changed");
    bench.refused(
        "sweep collect which.toml",
        3,
        "it is not what the task wrote",
    );
    // As the message says.
    let name = path.file_name().expect("a name").to_owned();
    fs::remove_file(&path).expect("removed");
    fs::remove_file(bench.path("which.sweep/results").join(name)).expect("removed");
    bench.ok("sweep which.toml -q");
    bench.ok("sweep collect which.toml");
}

#[test]
fn conditions_seeds_and_splits_that_cannot_be_meant_are_refused_at_the_start() {
    let bench = week();
    small(&bench, &[]);
    for only in ["model==ridge", "model=ridge,seed=1", "seed>1", "(seed=1)"] {
        bench.refused(
            &format!("sweep which.toml --only {only}"),
            2,
            "expected NAME = VALUE or NAME != VALUE",
        );
    }
    small(
        &bench,
        &[("[vary]", "[skip]\nwhere = [\"model == ridge\"]\n[vary]")],
    );
    bench.refused("sweep which.toml", 3, "line 10: `model == ridge`: ");
    for (old, new, message) in [
        (
            "seeds = [1]",
            "seeds = 3",
            "line 6: `seeds = 3`: expected a list such as [1, 2, 3], or the first and the last as in \"1-5\"; one seed is [3]",
        ),
        (
            "seeds = [1]",
            "seeds = [-1]",
            "line 6: `seeds`: -1: expected whole numbers from 0",
        ),
        (
            "seeds = [1]",
            "seeds = \"9223372036854775807-9223372036854775808\"",
            "to 9223372036854775807",
        ),
        (
            "by-point 50",
            "by-pont 50",
            "line 7: no split is called `by-pont",
        ),
    ] {
        small(&bench, &[(old, new)]);
        bench.refused("sweep which.toml", 3, message);
    }
    assert!(!bench.path("which.sweep").exists());
    small(
        &bench,
        &[(
            "[vary]",
            "[skip]\nwhere = [\"model = pls or model = knn and size = 8x8\"]\n[vary]",
        )],
    );
    let dry = bench.ok("sweep which.toml --dry-run");
    assert!(dry.contains("tasks    5, 3 combinations left out"), "{dry}");
}

#[test]
fn the_reason_of_a_failed_task_is_that_of_its_last_attempt_and_names_no_folder() {
    let bench = week();
    bench.record_nothing("nothing");
    small(
        &bench,
        &[
            ("[\"monday\"]", "[\"nothing\"]"),
            ("\"8x8\", \"12x12\"", "\"8x8\""),
        ],
    );
    assert_eq!(bench.run("sweep which.toml -q").code, 1);
    let table = text(&bench, "which.sweep/table.csv");
    assert!(table.contains("the dataset has 0 rows"), "{table}");
    let folder = bench.path("").to_string_lossy().into_owned();
    assert!(!table.contains(&folder), "{folder}: {table}");
    let key = table
        .lines()
        .nth(1)
        .and_then(|row| row.split(',').next())
        .expect("a key");
    let failure = format!("which.sweep/failed/{key}.json");
    bench.write(
        &failure,
        &format!("{{\"key\":\"{key}\",\"reason\":\"an old reason\"}}"),
    );
    bench.run("sweep collect which.toml");
    assert!(text(&bench, "which.sweep/table.csv").contains("an old reason"));
    assert_eq!(bench.run("sweep which.toml -q --retry-failed").code, 1);
    assert_eq!(text(&bench, "which.sweep/table.csv"), table);
}

#[test]
fn a_file_that_changed_since_its_tasks_were_listed_is_said_to_have() {
    let bench = week();
    small(&bench, &[("\"8x8\", \"12x12\"", "\"8x8\"")]);
    bench.ok("sweep which.toml -q");
    assert_eq!(bench.run("sweep status which.toml").err, "");
    small(&bench, &[("\"8x8\", \"12x12\"", "\"9x9\"")]);
    for words in ["status", "show", "collect"] {
        let ran = bench.run(&format!("sweep {words} which.toml"));
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(
            ran.err
                .contains("which.toml has changed since its tasks were listed"),
            "{}",
            ran.err
        );
    }
}

#[test]
fn models_that_were_no_candidates_and_settings_of_one_model_stand_on_the_page_by_name() {
    let bench = week();
    let twice = "{ name = \"knn\", set = { neighbours = 1 } }, { name = \"knn\"";
    small(
        &bench,
        &[
            ("\"pls\", ", ""),
            ("{ name = \"knn\"", twice),
            ("50/10/40", "60/0/40"),
        ],
    );
    bench.ok("sweep which.toml -q");
    let page = text(&bench, "which.sweep/page.html");
    let (_, names) = page
        .split_once("No candidates, as they report no such error: ")
        .expect(&page);
    assert!(names.starts_with("baseline size=8x8; "), "{page}");
    for words in ["neighbours of knn", "knn neighbours=1", "knn neighbours=3"] {
        assert!(page.contains(words), "{words}");
    }
}
