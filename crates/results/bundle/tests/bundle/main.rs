//! Tests that every small change of a bundle is found without a panic, and tests of forms for other programs.

mod forms;

mod hostile;

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use serde_json::Value;
use taceva_bundle::{
    BundleRequest, Level, Outcome, ScoredTables, Verdict, Verification, VerifyRequest, make, verify,
};
use taceva_core::SilentProgress;
use taceva_evaluate::{ScoreRequest, Scoring};
use taceva_files::seal::{digest_of_bytes, json};

/// Bundle of two scored tables, in a folder.
struct Bench {
    folder: tempfile::TempDir,
    request: BundleRequest,
}

impl Bench {
    /// Draft bundle with default settings.
    fn new() -> Bench {
        Bench::of(|_| {})
    }

    /// Bundle whose request was altered by `change`.
    fn of(change: impl FnOnce(&mut BundleRequest)) -> Bench {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        let mut truth = "id,point_id,Px,Py,Fz\n".to_owned();
        let mut predicted = "id,Px,Py,Fz\n".to_owned();
        for row in 0..60_u32 {
            let (x, y) = (f64::from(row % 6) - 2.5, f64::from(row / 6 % 5) - 2.0);
            let force = 0.2 + 0.1 * f64::from(row % 4);
            truth += &format!("{row},p{},{x},{y},{force}\n", row % 15);
            let off = 0.01 * (f64::from(row * 7919 % 13) - 6.0);
            predicted += &format!("{row},{},{},{}\n", x + off, y - off, force + off / 7.0);
        }
        fs::write(at("truth.csv"), truth).expect("room");
        fs::write(at("pred.csv"), predicted).expect("room");
        let request = ScoreRequest {
            truth: at("truth.csv"),
            prediction: at("pred.csv"),
            units: Vec::new(),
            periods: Vec::new(),
            key: None,
            is_independent: false,
            sensor: None,
            metrics: vec!["accuracy".to_owned()],
            allow_invalid: false,
            jobs: NonZeroUsize::MIN,
        };
        let scoring = Scoring::read(request).expect("two tables");
        let scored = scoring.run(&SilentProgress).expect("numbers");
        let result = taceva_results::sealed(&scored.report).expect("JSON");
        fs::write(at("result.json"), result).expect("room");
        let mut state = Vec::new();
        scored.state.write(&mut state).expect("into memory");
        fs::write(at("result.state"), state).expect("room");
        let mut request = BundleRequest::new(&at("result.json"), "2026-11-28");
        request.states = vec![at("result.state")];
        request.tables = Some(ScoredTables::new(&at("truth.csv"), &at("pred.csv"), None));
        change(&mut request);
        make(&request, &at("b")).expect("a bundle");
        Bench { folder, request }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join("b").join(name)
    }

    fn verified(&self, level: Level) -> Verification {
        let mut request = VerifyRequest::new(&self.path(""));
        request.level = Some(level);
        verify(&request).expect("readable")
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).expect("a text")
    }

    /// Updates size and digest of every file in `manifest`, seals the manifest and writes it.
    fn relist(&self, mut manifest: Value) {
        for file in manifest["files"].as_array_mut().expect("files") {
            let bytes = fs::read(self.path(file["path"].as_str().expect("a path"))).expect("there");
            file["size"] = bytes.len().into();
            file["sha256"] = digest_of_bytes(&bytes).into();
        }
        manifest.as_object_mut().expect("an object").remove("seal");
        let text = serde_json::to_string_pretty(&manifest).expect("JSON");
        let sealed = json::seal(&text).expect("an object");
        fs::write(self.path("bundle.json"), sealed).expect("room");
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&fs::read(self.path(name)).expect("there")).expect("JSON")
    }
}

/// Reproducible pseudo-random numbers.
struct Draws(u64);

impl Draws {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let high = usize::try_from(self.0 >> 33).expect("31 bits");
        high % end
    }
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).expect("readable") {
        let path = entry.expect("readable").path();
        match path.is_dir() {
            true => found.extend(files(&path)),
            false => found.push(path),
        }
    }
    found.sort();
    found
}

#[test]
fn a_flip_of_any_bit_is_damage_unless_the_manifest_says_the_same() {
    let bench = Bench::new();
    assert_eq!(
        bench.verified(Level::Predictions).outcome(),
        Outcome::Verified
    );
    let files = files(&bench.path(""));
    assert!(files.len() >= 10, "{files:?}");
    let manifest = bench.json("bundle.json");
    let mut draws = Draws(7);
    for number in 0..1000 {
        let path = &files[draws.below(files.len())];
        let whole = fs::read(path).expect("there");
        let mut changed = whole.clone();
        let place = draws.below(changed.len());
        changed[place] ^= 1 << draws.below(8);
        fs::write(path, &changed).expect("room");
        let outcome = bench.verified(Level::Files).outcome();
        // An exponent may be written `e` or `E`.
        let says_the_same =
            serde_json::from_slice::<Value>(&changed).is_ok_and(|own| own == manifest);
        assert!(
            outcome == Outcome::Damaged || says_the_same,
            "flip {number} at {place} of {}",
            path.display()
        );
        fs::write(path, &whole).expect("room");
    }
}

#[test]
fn an_edit_of_results_and_manifest_alike_is_found_at_the_scores() {
    let bench = Bench::new();
    let (results, manifest) = (bench.json("results.json"), bench.json("bundle.json"));
    let claims = manifest["claims"].as_array().expect("claims").len();
    let mut draws = Draws(11);
    for _ in 0..200 {
        let (mut results, mut manifest) = (results.clone(), manifest.clone());
        // Generated files of another version are not compared.
        manifest["taceva"] = "0.0.0".into();
        let at = draws.below(claims);
        let claim = manifest["claims"][at].clone();
        let new = claim["value"].as_f64().expect("a number") * 0.75 + 0.001;
        let [metric, channel] =
            ["metric", "channel"].map(|key| claim[key].as_str().expect("a name"));
        let mut number = &mut results["metrics"][metric][channel];
        if let Some(variant) = claim["variant"].as_str() {
            number = &mut number[variant];
        }
        number["value"] = new.into();
        manifest["claims"][at]["value"] = new.into();
        let text = serde_json::to_string_pretty(&results).expect("JSON");
        let text = json::reseal(&text, "2026-11-28", "forged").expect("JSON");
        fs::write(bench.path("results.json"), text).expect("room");
        bench.relist(manifest);
        let found = bench.verified(Level::Scores);
        assert_eq!(found.outcome(), Outcome::Unverified, "{claim}");
        let own = found.claims.iter();
        let differing = own.filter(|own| own.verdict == Verdict::Differs);
        let levels: Vec<Level> = differing.map(|own| own.level).collect();
        assert_eq!(levels, [Level::Scores], "{claim}");
    }
}
