//! Changed files are refused by name and key until the edit is accepted, and reports show the edit.

use crate::support::{Bench, of_format};

/// Changes the first `from` in a file into `to`.
fn edit(bench: &Bench, name: &str, from: &str, to: &str) {
    let text = std::fs::read_to_string(bench.path(name)).expect("there");
    assert!(text.contains(from), "{name} holds no `{from}`: {text}");
    bench.write(name, &text.replacen(from, to, 1));
}

#[test]
fn an_edited_dataset_is_refused_by_every_command_until_it_is_accepted() {
    let bench = Bench::imported();
    bench.ok("fit data --model ridge --out model -q");
    edit(
        &bench,
        "data/dataset.toml",
        "source = \"recorded\"",
        "source = \"synthetic\"",
    );
    let message = "dataset.toml: `source` was changed after it was sealed";
    for words in [
        "evaluate data --with model",
        "check data",
        "predict data --with model --out p.csv",
        "fit data --model ridge --out other",
    ] {
        bench.refused(words, 3, message);
    }
    bench.ok("reseal data --reason drawn,not-recorded -q");
    let result = bench.json("evaluate data --with model --part all");
    assert_eq!(result["subject"]["source"], "synthetic");
    let edits = result["provenance"]["edits"].to_string();
    assert!(
        edits.contains("dataset.toml, 20") && edits.contains("drawn,not-recorded"),
        "{edits}"
    );
    let text = bench.ok("evaluate data --with model --part all -q");
    assert!(text.contains("drawn,not-recorded"), "{text}");
    bench.ok("evaluate data --with model --part all -q --html page.html --out r.txt");
    let page = std::fs::read_to_string(bench.path("page.html")).expect("written");
    assert!(page.contains("drawn,not-recorded"));
    let said = bench.run("reseal data --reason again");
    assert!(
        said.code == 0 && said.err.contains("the seal matches"),
        "{}",
        said.err
    );
}

#[test]
fn an_edit_that_cannot_be_read_is_not_accepted() {
    let bench = Bench::imported();
    edit(&bench, "data/dataset.toml", "rows = ", "rows = 1");
    let before = std::fs::read(bench.path("data/dataset.toml")).expect("there");
    bench.refused("reseal data --reason wish", 3, "left unchanged");
    assert_eq!(
        std::fs::read(bench.path("data/dataset.toml")).expect("there"),
        before
    );
    bench.refused("reseal map.toml --reason wish", 3, "map.toml");
    bench.refused("reseal nowhere --reason wish", 3, "cannot read nowhere");
}

#[test]
fn a_dataset_without_a_seal_or_of_an_earlier_format_is_refused() {
    let bench = Bench::imported();
    let text = std::fs::read_to_string(bench.path("data/dataset.toml")).expect("there");
    let (body, _) = text.split_once("\n[seal]").expect("sealed");
    bench.write("data/dataset.toml", body);
    bench.refused("check data", 3, "dataset.toml: the seal is missing");
    bench.write("data/dataset.toml", &of_format(&text, "1.4"));
    bench.refused(
        "check data",
        3,
        "format 1.4 was written by TacEva before 0.2.0",
    );
    bench.write(
        "data/dataset.toml",
        &format!("[seal]{}", text.split_once("\n[seal]").expect("sealed").1),
    );
    let ran = bench.run("check data -q");
    assert_eq!(ran.code, 3, "a seal alone: {}", ran.err);
}

#[test]
fn results_that_were_changed_are_refused_by_metric_and_channel() {
    let bench = Bench::imported();
    for name in ["a", "b"] {
        bench.ok(&format!(
            "evaluate data --model ridge --part all --format json -q --out {name}.json --samples-out {name}.samples.csv"
        ));
    }
    bench.ok("compare a.json b.json -q");
    edit(&bench, "a.json", "\"clusters\": 10", "\"clusters\": 11");
    bench.refused("compare a.json b.json", 3, "a.json: `metrics.");
    bench.ok("reseal a.json --reason recount -q");
    let compared = bench.run("compare a.json b.json --all -q");
    assert_eq!(compared.code, 0, "{}", compared.err);
    assert!(
        !compared.out.contains("the definitions"),
        "{}",
        compared.out
    );
    let first_keys = |name: &str| {
        let text = std::fs::read_to_string(bench.path(name)).expect("there");
        text.lines().take(2).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(first_keys("a.json"), first_keys("b.json"), "in their order");
    let text = std::fs::read_to_string(bench.path("b.json")).expect("there");
    let (body, _) = text.rsplit_once(",\n  \"seal\"").expect("sealed");
    bench.write("b.json", &format!("{body}\n}}\n"));
    bench.refused("compare a.json b.json", 3, "b.json: the seal is missing");
    bench.write("b.json", &text);
    let table = std::fs::read_to_string(bench.path("b.samples.csv")).expect("there");
    bench.write("b.samples.csv", &table.replacen("0.2", "0.3", 1));
    bench.refused(
        "compare a.json b.json",
        3,
        "b.samples.csv: damaged, or written for another result",
    );
}

#[test]
fn a_model_whose_number_was_changed_is_refused() {
    let bench = Bench::imported();
    bench.ok("fit data --model ridge --out model -q");
    let mut bytes = std::fs::read(bench.path("model")).expect("there");
    *bytes.last_mut().expect("a weight") ^= 1;
    std::fs::write(bench.path("model"), bytes).expect("written");
    bench.refused(
        "evaluate data --with model",
        3,
        "was changed after it was sealed",
    );
    bench.refused(
        "reseal model --reason better",
        3,
        "a model cannot be edited: fit the model again",
    );
}
