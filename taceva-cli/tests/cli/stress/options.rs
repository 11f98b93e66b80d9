//! Options of a test with faults: a reference model, and other lists of faults.

use std::fs;
use std::process::Stdio;

use super::bench;

#[test]
fn a_reference_model_adds_relative_errors_to_text_csv_and_json() {
    let bench = bench();
    bench.ok("fit seen --model ridge --set size=4x4 --out r.taceva -q");
    let words =
        "stress unseen --model m.taceva --reference r.taceva --faults exposure_low --by parameter";
    let report = bench.json(words);
    crate::schema::check("stress", &report);
    assert_eq!(report["reference"]["name"], "ridge");
    assert!(
        report["faults"][0]["relative_error"]["Fz"].is_object(),
        "{report}"
    );
    let said = bench.ok(&format!("{words} -q"));
    assert!(
        said.contains("added error relative to the reference model: "),
        "{said}"
    );
    let csv = bench.ok(&format!("{words} --format csv -q"));
    assert!(csv.contains(",relative_error,"), "{csv}");
    assert!(csv.contains(",difference_p,"), "{csv}");
    let plan = bench.ok(&format!("{words} --explain"));
    assert!(plan.contains("the same with the model r.taceva"), "{plan}");
    let alone = bench.json("stress unseen --model m.taceva --faults dust --by parameter");
    assert!(alone.get("reference").is_none());
    bench.refused(
        "stress unseen --model m.taceva --reference ridge",
        2,
        "--reference ridge: no such file",
    );
}

#[test]
fn a_verdict_names_a_shown_difference_from_the_reference_model_and_none_that_is_not_shown() {
    let bench = bench();
    bench.ok("fit seen --model ridge --set size=8x8 --set strength=20 --out weak.taceva -q");
    bench.ok("fit seen --model baseline --out constant.taceva -q");
    let beside = |reference: &str| {
        format!(
            "stress unseen --model m.taceva --reference {reference}.taceva --faults exposure_low --by parameter"
        )
    };
    let report = bench.json(&beside("weak"));
    crate::schema::check("stress", &report);
    let difference = &report["faults"][0]["difference"]["Fz"];
    assert_eq!(difference["is_shown"], true, "{difference}");
    let said = bench.ok(&format!("{} -q", beside("weak")));
    assert!(
        said.contains("the fault is shown to add more error than to the reference model"),
        "{said}"
    );
    assert!(
        said.contains("by contact point or group, p and intervals by Holm over"),
        "{said}"
    );

    let same = bench.ok(&format!("{} -q", beside("m")));
    assert!(!same.contains("the fault is shown to add"), "{same}");
    let constant = bench.ok(&format!("{} -q", beside("constant")));
    assert!(
        constant.contains("not tested: Fz: the reference model has no skill even without a fault"),
        "{constant}"
    );
    assert!(!constant.contains("fault is shown to add"), "{constant}");
}

#[test]
fn severities_above_the_end_of_skill_are_left_out_and_means_are_lower_bounds() {
    let bench = bench();
    bench.ok("fit seen --model baseline --out constant.taceva -q");
    let words = "stress unseen --model constant.taceva --stop-at-no-skill --faults dust,tear --by parameter";
    let report = bench.json(words);
    crate::schema::check("stress", &report);
    for fault in report["faults"].as_array().expect("faults") {
        assert_eq!(fault["stopped_at"], 1, "{fault}");
        assert_eq!(fault["severities"].as_array().map(Vec::len), Some(1));
    }
    let said = bench.ok(&format!("{words} -q"));
    assert!(said.contains("no skill is left at severity 1"), "{said}");
    assert!(
        said.contains("Mean degradation over all faults: ≥ "),
        "{said}"
    );
    let csv = bench.ok(&format!("{words} --format csv -q"));
    assert!(csv.contains(",stopped_at,1"), "{csv}");
    let plan = bench.ok(&format!("{words} --explain"));
    assert!(
        plan.contains("each once for each severity until no skill is left"),
        "{plan}"
    );
}

#[test]
fn one_picture_of_each_cell_is_kept_with_its_digest_beside_equal_results() {
    let bench = bench();
    let words = "stress unseen --model m.taceva --faults exposure_low,stale_frames --severity 1,5 --by parameter --format json";
    let alone = bench.ok(&format!("{words} -q"));
    let kept = bench.ok(&format!("{words} --keep-frames kept -q"));
    assert_eq!(alone, kept);
    let read = |name: &str| fs::read(bench.path(&format!("kept/{name}"))).expect(name);
    let table = String::from_utf8(read("digests.csv")).expect("UTF-8");
    let names: Vec<&str> = table
        .lines()
        .skip(1)
        .filter_map(|line| line.split(',').next())
        .collect();
    let expected = [
        "clean.png",
        "exposure_low-1.png",
        "exposure_low-5.png",
        "stale_frames-1.png",
        "stale_frames-5.png",
    ];
    assert_eq!(names, expected);
    assert!(read("clean.png").starts_with(b"\x89PNG"));
    assert_ne!(read("clean.png"), read("exposure_low-5.png"));
    bench.ok(&format!("{words} --keep-frames again -q"));
    let again = fs::read(bench.path("again/digests.csv")).expect("written");
    assert_eq!(again, table.as_bytes());
    bench.refused(
        &format!("{words} --keep-frames kept"),
        2,
        "--keep-frames kept: exists already",
    );
}

#[test]
fn pictures_that_cannot_be_written_leave_the_results_and_nothing_half_written() {
    let bench = bench();
    bench.write("blocked", "a file, where a folder is needed");
    let words =
        "stress unseen --model m.taceva --faults dust --severity 1 --by parameter -q --format json";
    let ran = bench.run(&format!(
        "{words} --out s.json --keep-frames blocked/frames"
    ));
    assert_ne!(ran.code, 0);
    assert!(
        ran.err.contains("the results are complete without it"),
        "{}",
        ran.err
    );
    let text = fs::read_to_string(bench.path("s.json")).expect("complete");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("stress", &report);
    let left: Vec<String> = fs::read_dir(bench.path("."))
        .expect("the folder")
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .to_string_lossy()
                .into_owned()
        })
        .filter(|name| name.starts_with(".taceva-staged"))
        .collect();
    assert!(left.is_empty(), "{left:?}");
}

#[test]
fn a_killed_test_leaves_a_whole_result_and_a_whole_folder_of_pictures_or_none() {
    let bench = bench();
    let words = "stress unseen --model m.taceva --by parameter -q --format json --out s.json --keep-frames kept";
    let mut command = bench.command(words);
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let mut child = child.expect("starts");
    // The pictures of sixty cells follow the result.
    while !bench.path("s.json").exists() && child.try_wait().expect("asked").is_none() {
        std::thread::yield_now();
    }
    child.kill().expect("killed");
    child.wait().expect("ended");
    let text = fs::read_to_string(bench.path("s.json")).expect("whole");
    let report: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    crate::schema::check("stress", &report);
    if bench.path("kept").exists() {
        let table = fs::read_to_string(bench.path("kept/digests.csv")).expect("whole");
        let names = table
            .lines()
            .skip(1)
            .filter_map(|line| line.split(',').next());
        let names: Vec<&str> = names.collect();
        assert_eq!(names.len(), 61, "{table}");
        assert!(
            names
                .iter()
                .all(|name| bench.path("kept").join(name).is_file())
        );
    }
}

#[test]
fn metrics_on_request_are_in_json_text_csv_and_the_plan_and_a_misspelt_one_is_refused() {
    let bench = bench();
    let words = "stress unseen --model m.taceva --faults dust --severity 1,5 --by parameter";
    let asked = format!("{words} --metrics mae,rmse,r2");
    let report = bench.json(&asked);
    crate::schema::check("stress", &report);
    let scores = [
        &report["clean"],
        &report["faults"][0]["severities"][1]["stale"],
    ];
    for score in scores {
        let metrics = score["Fz"]["metrics"].as_object().expect("metrics");
        let names: Vec<&String> = metrics.keys().collect();
        assert_eq!(names, ["r2", "rmse"]);
        assert!(metrics["r2"]["value"].is_number(), "{score}");
    }
    assert!(bench.json(words)["clean"]["Fz"].get("metrics").is_none());
    let said = bench.ok(&format!("{asked} -q"));
    let note = "r2, rmse of each channel, fault and severity are in --format csv and json.";
    assert!(said.contains(note), "{said}");
    let csv = bench.ok(&format!("{asked} --format csv -q"));
    let rows = csv.lines().filter(|row| row.contains(",Fz,rmse,"));
    let rows: Vec<&str> = rows.collect();
    assert_eq!(
        rows.len(),
        3,
        "without the fault, and two severities: {csv}"
    );
    assert!(rows.iter().all(|row| row.contains(",N,")), "{csv}");
    let plan = bench.ok(&format!("{asked} --explain"));
    assert!(plan.contains("mae, skill, rmse, r2"), "{plan}");
    bench.refused(
        &format!("{words} --metrics rmsee"),
        2,
        "metric `rmsee`: not computed for faults, did you mean `rmse`?",
    );
}

#[test]
fn recording_faults_have_their_own_list_and_name_what_they_lack() {
    let bench = bench();
    let report = bench.json("stress unseen --model m.taceva --faults recording-5 --by parameter");
    crate::schema::check("stress", &report);
    let ids: Vec<&str> = report["faults"]
        .as_array()
        .expect("faults")
        .iter()
        .filter_map(|fault| fault["id"].as_str())
        .collect();
    assert!(
        ids.contains(&"jpeg") && ids.contains(&"force_noise"),
        "{report}"
    );
    let skipped = report["skipped"].as_array().expect("skipped");
    assert_eq!(ids.len() + skipped.len(), 5, "{report}");
    let noise = report["faults"]
        .as_array()
        .expect("faults")
        .last()
        .expect("one");
    assert!(noise["severities"][0]["stimulus"].is_null(), "{noise}");
    let csv = bench.ok("stress unseen --model m.taceva --faults force_noise --format csv -q");
    assert!(csv.contains("no picture or signal changes"), "{csv}");
}
