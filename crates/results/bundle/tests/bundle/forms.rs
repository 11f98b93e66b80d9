//! Tests of the files for other programs, which are generated from the manifest and compared with it.

use std::fs;

use serde_json::{Value, json};
use taceva_bundle::{BundleRequest, Level, Outcome, make};
use taceva_files::seal::json::reseal;

use super::Bench;

/// Files generated from the manifest.
const GENERATED: [&str; 6] = [
    "README.md",
    "CITATION.cff",
    "LICENSE",
    ".eval_results/taceva.yaml",
    "croissant.json",
    "ro-crate-metadata.json",
];
/// Generated files with the claims.
const WITH_CLAIMS: [&str; 4] = [
    "README.md",
    ".eval_results/taceva.yaml",
    "croissant.json",
    "ro-crate-metadata.json",
];

/// Name of a bundle that JSON and YAML must escape.
const NAME: &str = "Prüfstück \"7\": \\ #1";
/// Name of an author that JSON and YAML must escape.
const AUTHOR: &str = "Zoë \"Z\" O'Néill";

/// Completes `request` for a finished bundle of a laboratory.
fn finished(request: &mut BundleRequest) {
    let author = format!("{AUTHOR} <0000-0002-1825-0097>");
    request.authors = vec![author.parse().expect("an author")];
    let lab = "Lab für Tasten <https://lab.example>";
    request.organization = Some(lab.parse().expect("an organization"));
    request.licence = Some("CC-BY-4.0".to_owned());
    request.name = Some(NAME.to_owned());
}

/// Entity of the RO-Crate with the identifier `id`.
fn entity(bench: &Bench, id: &str) -> Value {
    let metadata = bench.json("ro-crate-metadata.json");
    let graph = metadata["@graph"].as_array().expect("entities");
    let mut entities = graph.iter().filter(|entity| entity["@id"] == id);
    let found = entities.next().expect(id).clone();
    assert!(entities.next().is_none(), "{id} is there twice");
    found
}

#[test]
fn each_form_holds_value_interval_unit_and_number_of_samples_of_every_claim() {
    let bench = Bench::of(finished);
    let manifest = bench.json("bundle.json");
    let described = bench.json("croissant.json");
    let (card, entries) = (
        bench.text("README.md"),
        bench.text(".eval_results/taceva.yaml"),
    );
    let card: Vec<&str> = card.lines().map(str::trim).collect();
    let claims = manifest["claims"].as_array().expect("claims");
    let mut with_interval = 0;
    for (number, claim) in claims.iter().enumerate() {
        let id = format!("#claim-{number}");
        let variable = &described["variableMeasured"][number];
        assert_eq!(*variable, entity(&bench, &id));
        assert_eq!(variable["value"], claim["value"]);
        assert_eq!(variable["unitText"], claim["unit"]);
        let words = variable["name"].as_str().expect("words");
        let value = claim["value"].as_f64().expect("a number");
        let [unit, definition] =
            ["unit", "definition"].map(|key| claim[key].as_str().expect("a text"));
        let facts = variable["description"].as_str().expect("words");
        let rest = format!("unit {unit}, n = {}, definition {definition}", claim["n"]);
        assert!(facts.contains(&rest), "{facts}");
        assert!(entries.contains(&format!("{words}: {facts}.")), "{entries}");
        assert!(entries.contains(&format!("value: {value}\n")), "{entries}");
        let mut lines = Vec::new();
        if let Some([low, high]) = claim["ci95"].as_array().map(Vec::as_slice) {
            assert_eq!(variable["minValue"], *low);
            assert_eq!(variable["maxValue"], *high);
            let [low, high] = [low, high].map(|end| end.as_f64().expect("a number"));
            assert!(facts.contains(&format!("ci95 [{low}, {high}]")), "{facts}");
            lines.extend(["ci95:".to_owned(), format!("- {low}"), format!("- {high}")]);
            with_interval += 1;
        }
        lines.extend([
            format!("definition: \"{definition}\""),
            format!("n: {}", claim["n"]),
            format!("unit: \"{unit}\""),
            format!("name: \"{words}\""),
        ]);
        let mut places = card.windows(lines.len());
        assert!(places.any(|place| place == lines), "{lines:?}");
    }
    assert!(with_interval > 3, "{with_interval} of {}", claims.len());
    let card = card.join("\n");
    for words in ["mean of truth − prediction", "computed the number again: "] {
        assert!(card.contains(words), "{card}");
    }
}

#[test]
fn a_form_that_is_edited_and_listed_again_is_damage_at_the_form() {
    let bench = Bench::of(finished);
    let manifest = bench.json("bundle.json");
    for name in GENERATED {
        let text = bench.text(name);
        let edited = format!("{text}\n");
        fs::write(bench.path(name), edited).expect("room");
        bench.relist(manifest.clone());
        let found = bench.verified(Level::Files);
        assert_eq!(found.outcome(), Outcome::Verified, "{name}");
        let found = bench.verified(Level::Form);
        assert_eq!(found.outcome(), Outcome::Damaged, "{name}");
        let paths: Vec<&str> = found.damage.iter().map(|own| own.path.as_str()).collect();
        assert_eq!(paths, [name]);
        fs::write(bench.path(name), text).expect("room");
    }
    bench.relist(manifest);
    let found = bench.verified(Level::Predictions);
    assert_eq!(found.outcome(), Outcome::Verified);
}

#[test]
fn a_file_that_is_edited_and_listed_again_differs_from_its_digest_in_the_forms() {
    let bench = Bench::new();
    let text = bench.text("environment.json");
    let edited = text.replacen("\"threads\": 1", "\"threads\": 2", 1);
    assert_ne!(edited, text);
    fs::write(bench.path("environment.json"), edited).expect("room");
    bench.relist(bench.json("bundle.json"));
    let found = bench.verified(Level::Form);
    let paths: Vec<&str> = found.damage.iter().map(|own| own.path.as_str()).collect();
    assert_eq!(paths, ["croissant.json", "ro-crate-metadata.json"]);
}

#[test]
fn a_study_with_another_origin_in_the_manifest_is_damage() {
    let bench = Bench::new();
    let mut manifest = bench.json("bundle.json");
    assert_eq!(manifest["studies"][0]["source"], "unknown");
    manifest["studies"][0]["source"] = "recorded".into();
    bench.relist(manifest);
    let found = bench.verified(Level::Form);
    let problem = &found.damage[0].problem;
    assert!(problem.contains("expected `unknown`"), "{problem}");
}

#[test]
fn a_manifest_that_states_the_origin_as_a_whole_alone_is_whole() {
    let bench = Bench::new();
    let mut manifest = bench.json("bundle.json");
    let study = manifest["studies"][0].as_object_mut().expect("a study");
    study.remove("source").expect("stated");
    bench.relist(manifest);
    let found = bench.verified(Level::Form);
    assert_eq!(found.outcome(), Outcome::Verified, "{:?}", found.damage);
}

#[test]
fn simulated_samples_and_drafts_are_named_in_every_form_with_claims() {
    let bench = Bench::of(|request| {
        for (path, space) in [(&request.result, " "), (&request.states[0], "")] {
            let text = fs::read_to_string(path).expect("a text");
            let [old, new] =
                ["unknown", "simulated"].map(|own| format!("\"source\":{space}\"{own}\""));
            assert!(text.contains(&old), "{}", path.display());
            let text = reseal(&text.replacen(&old, &new, 1), "2026-11-28", "drawn");
            fs::write(path, text.expect("JSON")).expect("room");
        }
    });
    for name in WITH_CLAIMS {
        let text = bench.text(name);
        for remark in [
            "Nothing here was measured: the samples are simulated.",
            "Draft: author or licence is missing.",
        ] {
            assert!(text.contains(remark), "{name}: {text}");
        }
    }
    let citation = bench.text("CITATION.cff");
    let is_alias = citation.contains("alias: \"not stated\"");
    assert!(is_alias && !citation.contains("name:"), "{citation}");
    let found = bench.verified(Level::Form);
    let unfinished = "Draft: author or licence is missing.";
    let is_named = found.remarks.iter().any(|remark| remark == unfinished);
    assert!(is_named, "{:?}", found.remarks);
}

#[test]
fn the_program_of_the_crate_has_the_address_of_its_repository() {
    let bench = Bench::new();
    let address = env!("CARGO_PKG_REPOSITORY");
    assert_eq!(entity(&bench, address)["url"], address);
    let run = entity(&bench, "#recomputation");
    assert_eq!(run["instrument"]["@id"], address);
    assert!(!bench.text("ro-crate-metadata.json").contains("crates.io"));
}

#[test]
fn names_with_quotes_and_umlauts_are_escaped_in_every_form() {
    let bench = Bench::of(finished);
    let described = bench.json("croissant.json");
    assert_eq!(described["name"], NAME);
    assert_eq!(described["creator"][0]["name"], AUTHOR);
    let person = entity(&bench, "https://orcid.org/0000-0002-1825-0097");
    assert_eq!(person["name"], AUTHOR);
    assert_eq!(person["affiliation"]["@id"], "https://lab.example");
    let lab = entity(&bench, "https://lab.example");
    assert_eq!(lab["name"], "Lab für Tasten");
    let root = entity(&bench, "./");
    assert_eq!(root["name"], NAME);
    assert_eq!(root["publisher"]["@id"], "https://lab.example");
    let name = r#"name: "Prüfstück \"7\": \\ #1""#;
    assert!(bench.text("README.md").contains(name));
    let author = r#"name: "Zoë \"Z\" O'Néill""#;
    assert!(bench.text("CITATION.cff").contains(author));
}

#[test]
fn tables_of_the_bundle_are_record_sets_with_the_types_of_their_columns() {
    let bench = Bench::new();
    let described = bench.json("croissant.json");
    let sets = described["recordSet"].as_array().expect("record sets");
    let fields = |set: &Value| -> Vec<[Value; 2]> {
        let fields = set["field"].as_array().expect("fields").iter();
        let fields = fields.map(|field| [field["@id"].clone(), field["dataType"].clone()]);
        fields.collect()
    };
    let [truth, prediction] = sets.as_slice() else {
        panic!("two tables: {described:#}");
    };
    let expected = [
        ["truth/id", "sc:Text"],
        ["truth/point_id", "sc:Text"],
        ["truth/Px", "sc:Float"],
        ["truth/Py", "sc:Integer"],
        ["truth/Fz", "sc:Float"],
    ];
    assert_eq!(fields(truth), expected.map(|field| field.map(Value::from)));
    assert_eq!(prediction["@id"], "prediction");
    let source = &truth["field"][2]["source"];
    let expected = json!({"fileObject": {"@id": "tables/truth.csv"}, "extract": {"column": "Px"}});
    assert_eq!(*source, expected);
    let withheld = Bench::of(|request| request.withholds_predictions = true);
    assert_eq!(withheld.json("croissant.json")["recordSet"], json!([]));
}

#[test]
fn authors_organization_and_licence_that_no_command_states_are_damage() {
    let bench = Bench::of(finished);
    let whole = bench.json("bundle.json");
    let crowd = Value::Array(vec![json!({"name": "Ada"}); 1001]);
    let author = json!({"name": "Ada", "orcid": "0000-0002-1825-0097"});
    let twice = json!([author, author]);
    let address = format!("https://{}", "x".repeat(1000));
    for (place, value, problem) in [
        ("/authors", crowd, "1001 authors"),
        ("/authors", twice, "author 2 has the ORCID of an earlier"),
        ("/authors/0/name", json!("a\u{1b}[2J"), "author 1: "),
        ("/authors/0/orcid", json!("x".repeat(1000)), "author 1: "),
        ("/organization/name", json!(""), "organization: "),
        ("/organization/url", json!(address), "organization: "),
        ("/licence", json!("ask me"), "licence: "),
        ("/licence", json!("LicenseRef-mine"), "licence: "),
    ] {
        let mut manifest = whole.clone();
        *manifest.pointer_mut(place).expect(place) = value;
        bench.relist(manifest);
        let found = bench.verified(Level::Form);
        let [damage] = found.damage.as_slice() else {
            panic!("{place}: {:?}", found.damage);
        };
        assert_eq!(damage.path, "bundle.json");
        assert!(damage.problem.starts_with(problem), "{place}: {damage}");
    }
}

#[test]
fn a_bundle_of_an_author_without_a_name_is_not_written() {
    let bench = Bench::new();
    let at = |name: &str| bench.folder.path().join(name);
    let mut request = BundleRequest::new(&at("result.json"), "2026-11-28");
    request.states = vec![at("result.state")];
    finished(&mut request);
    request.authors[0].name.clear();
    let error = make(&request, &at("nameless")).expect_err("no name");
    assert!(error.to_string().contains("author 1: "), "{error}");
    assert!(!at("nameless").exists());
}
