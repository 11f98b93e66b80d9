//! Reports of finished results, written again.

use std::fs;
use std::path::Path;

use crate::support::Bench;

/// Scene of one sensor with a few presses.
const SCENE: &str = r#"scene_version = 1
name = "small"
seed = 7
robot = { driver = "sim/robot" }
force = { driver = "sim/force-transducer" }
model = { name = "ridge", set = { size = "16x16" } }
metrics = { want = ["mae", "r2", "smape"] }
protocol = { calibration = { points = 80, indentations = 1 } }
report = { like = "taceva" }
[[study]]
name = "ViTacTip"
sensor = { driver = "sim/vitactip:reduction=16" }
"#;

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

#[test]
fn reports_of_a_run_are_written_again_without_acquiring() {
    let bench = Bench::new();
    bench.write("small.toml", SCENE);
    bench.ok("run small.toml --out run -q");
    let in_form = read(&bench.path("run/like-taceva/tables.md"));
    assert!(
        in_form.contains("Table II.") && in_form.contains("(×"),
        "{in_form}"
    );
    bench.refused(
        "report run",
        3,
        "--force replaces the reports there, --out FOLDER",
    );
    let main = bench.ok("report run --out again --like taceva --format tex -q");
    assert!(
        main.contains("\\caption{Accuracy of ViTacTip (ridge) on "),
        "{main}"
    );
    for file in [
        "scores.csv",
        "scores.tex",
        "scores-main.tex",
        "figures/predicted-1.svg",
        "figures/labels.svg",
        "like-taceva/tables.md",
        "like-taceva/tables.tex",
        "like-taceva/figures.md",
    ] {
        let [first, again] = ["run", "again"].map(|folder| read(&bench.path(folder).join(file)));
        assert_eq!(first, again, "{file}");
    }
    let page = read(&bench.path("again/report.html"));
    assert!(
        page.contains("data:image/jpeg;base64,"),
        "pictures of the recording"
    );
    // A results file alone, far from its run, has scores but no samples.
    fs::copy(bench.path("run/results.json"), bench.path("alone.json")).expect("copied");
    let ran = bench.run("report alone.json --out far");
    assert!(
        ran.code == 0 && ran.err.contains("no samples of ViTacTip"),
        "{}",
        ran.err
    );
    let remedy = "figures of samples are left out: write the table with `taceva evaluate … --samples-out NAME.samples.csv`";
    assert!(
        ran.err.contains(remedy) && !ran.err.contains("compared by"),
        "{}",
        ran.err
    );
    assert!(
        ran.err
            .contains("figures without data are not written: labels"),
        "{}",
        ran.err
    );
    assert!(!bench.path("far/figures/labels.svg").exists());
}

#[test]
fn a_report_of_one_channel_draws_that_channel_alone() {
    let bench = Bench::new();
    bench.record("data", 40);
    bench.ok("evaluate data --model ridge --split random --format json --out r.json --samples-out r.samples.csv -q");
    bench.ok("report r.json --channels Fz --out one -q");
    let drawn = read(&bench.path("one/figures/predicted-1.svg"));
    assert!(drawn.contains("true Fz") && !drawn.contains("true Px"));
    let scores = read(&bench.path("one/scores.csv"));
    assert!(scores.contains(",mae,lower,Fz,") && !scores.contains(",Px,"));
    let refused = bench.run("report r.json --channels Fq --out two");
    assert!(
        refused.code == 2
            && refused
                .err
                .contains("--channels Fq: no result has this channel"),
        "{}",
        refused.err
    );
}

#[test]
fn figures_have_the_width_and_the_letters_that_were_asked_for() {
    let bench = Bench::new();
    bench.record("data", 40);
    let words = "evaluate data --model ridge --split random --part all";
    bench.ok(&format!(
        "{words} --figures print --figure-width 88mm --figure-size 7pt --figure-font Times --out r.txt -q"
    ));
    let drawn = read(&bench.path("print/predicted-1.svg"));
    assert!(drawn.contains(" width=\"249.45pt\"") && drawn.contains("font-family:'Times'"));
    assert!(
        drawn.contains("R² = ") && drawn.contains("n = 60"),
        "{drawn}"
    );
    bench.refused(
        &format!("{words} --figure-width 88mm"),
        2,
        "add --figures FOLDER",
    );
    let wrong = bench.run(&format!("{words} --figures print --figure-width 88"));
    assert!(
        wrong.code == 2 && wrong.err.contains("such as 88mm"),
        "{}",
        wrong.err
    );
}

#[test]
fn results_of_another_version_are_refused_in_words() {
    let bench = Bench::new();
    bench.write(
        "run/results.json",
        r#"{"schema": "taceva.run/1.4", "studies": [{"provenance": {"taceva": "0.1.0"}}]}"#,
    );
    let words = "schema `taceva.run/1.4`, written by TacEva 0.1.0: expected `taceva.run/1.0`; run `taceva run …` again with this version, or without new presses `taceva evaluate` on each of its recordings";
    bench.refused("report run", 3, words);
    bench.refused(
        "report nothing",
        2,
        "nothing: no such file or folder; expected the folder of a run",
    );
    fs::create_dir(bench.path("empty")).expect("made");
    bench.refused("report empty", 2, "a folder without results.json");
    bench.write("runs/monday/results.json", "{}");
    bench.refused(
        "report runs",
        2,
        "runs: a folder of runs; did you mean runs/monday?",
    );
    bench.write("page.html", "<p>");
    bench.refused(
        "report page.html",
        2,
        "page.html is a page; name the run folder or the JSON of `evaluate --format json --out`",
    );
    bench.record("data", 20);
    bench.refused(
        "report data",
        2,
        "data is a dataset: `taceva evaluate data` computes a result",
    );
}

#[test]
fn results_without_a_score_of_the_study_get_no_empty_folder_in_its_form() {
    let bench = Bench::new();
    bench.write("t.csv", "id,point_id,Fz\n1,a,0.1\n2,b,0.2\n");
    bench.write("p.csv", "id,Fz\n1,0.11\n2,0.21\n");
    for (metrics, is_written) in [("rmse", false), ("mae", true)] {
        bench.ok(&format!(
            "score --truth t.csv --pred p.csv --metrics {metrics} --format json --out {metrics}.json -q"
        ));
        let ran = bench.run(&format!(
            "report {metrics}.json --like taceva --out of-{metrics}"
        ));
        assert_eq!(ran.code, 0, "{}", ran.err);
        let folder = bench.path(&format!("of-{metrics}/like-taceva"));
        assert_eq!(folder.exists(), is_written, "{}", ran.err);
        let words = "these results have none of its scores; the scene of `taceva run paper`";
        assert_eq!(ran.err.contains(words), !is_written, "{}", ran.err);
        assert!(bench.path(&format!("of-{metrics}/report.html")).exists());
    }
}

#[test]
fn a_report_of_one_sample_states_why_it_has_no_interval() {
    let bench = Bench::new();
    bench.write("t.csv", "id,point_id,Fz\n1,a,0.1\n");
    bench.write("p.csv", "id,Fz\n1,0.11\n");
    bench.ok("score --truth t.csv --pred p.csv --metrics mae --format json --out one.json -q");
    bench.ok("report one.json --like taceva --out one -q");
    let tables = read(&bench.path("one/like-taceva/tables.md"));
    assert!(tables.contains("Table II."), "{tables}");
    let scores = read(&bench.path("one/scores-main.tex"));
    assert!(scores.contains("without intervals ("), "{scores}");
    super::latex::assert_fits_a_column("one sample", &scores);
}

#[test]
fn the_main_table_is_chosen_in_every_format() {
    let bench = Bench::new();
    bench.record("data", 40);
    let words = "evaluate data --model ridge --split random --part all -q";
    let main = bench.ok(&format!("{words} --format tex"));
    assert!(
        main.contains("\\begin{tabular*}{\\columnwidth}") && !main.contains("rmse"),
        "{main}"
    );
    super::latex::assert_fits_a_column("evaluate", &main);
    let all = bench.ok(&format!("{words} --format tex --table all"));
    assert!(
        all.contains("rmse") && !all.contains("columnwidth"),
        "{all}"
    );
    for format in ["text", "md", "csv"] {
        let all = bench.ok(&format!("{words} --format {format}"));
        let main = bench.ok(&format!("{words} --format {format} --table main"));
        assert!(
            all.contains("rmse") && !main.contains("rmse"),
            "{format}: {main}"
        );
        assert!(main.contains("Fz"), "{format}: {main}");
    }
    bench.refused(
        "evaluate data --model ridge --format json --table main",
        2,
        "JSON has no tables",
    );
    let compared = bench.ok("compare GelSight MagicTac --format tex -q");
    assert!(
        compared.contains("as published") && compared.contains("MagicTac"),
        "{compared}"
    );
    super::latex::assert_fits_a_column("compare", &compared);
    let every = bench.ok("compare GelSight MagicTac --format tex --table all -q");
    assert!(every.contains("p by Holm"), "{every}");
}
