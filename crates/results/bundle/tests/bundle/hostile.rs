//! Hostile bundles: spoiled archives, headers, JSON, names, lengths and tables. `TACEVA_HOSTILE=2000 cargo test --release -p taceva-bundle
//! hostile` sets their number.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Read as _, Write as _};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use serde_json::{Value, json};
use taceva_bundle::{Outcome, VerifyRequest, make, verify};
use taceva_files::seal::json as seal;

use super::{Bench, Draws, files};

const SEED: u64 = 20_261_129;
/// Default number of hostile bundles.
const BUNDLES: u64 = 100;
/// Length of a block of an archive.
const BLOCK: usize = 512;

/// Copy of `bytes` with up to four changes: bits, cuts, repetitions, zeros and insertions.
fn spoiled(bytes: &[u8], draws: &mut Draws) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    for _ in 0..=draws.below(4) {
        if bytes.is_empty() {
            break;
        }
        let at = draws.below(bytes.len());
        let end = (at + draws.below(700)).min(bytes.len());
        match draws.below(5) {
            0 => bytes[at] ^= 1 << draws.below(8),
            1 => bytes.truncate(at),
            2 => {
                let part = bytes[at..end].to_vec();
                drop(bytes.splice(at..at, part));
            }
            3 => bytes[at..end].fill(0),
            _ => drop(bytes.splice(at..at, *b"\xff\x00[{\"1e999")),
        }
    }
    bytes
}

/// An archive with one changed header, whose checksum is right.
fn with_header(tar: &[u8], draws: &mut Draws) -> Vec<u8> {
    let mut tar = tar.to_vec();
    let at = draws.below(tar.len() / BLOCK) * BLOCK;
    let header = &mut tar[at..at + BLOCK];
    let words: [(usize, &[u8]); 10] = [
        (0, b"../x\0"),
        (0, b"/etc/x\0"),
        (0, b"a/../../b\0"),
        (0, b"\xff\xfe\0"),
        (0, b"BUNDLE.JSON\0"),
        (124, b"77777777777\0"),
        (124, b"00000000000\0"),
        (124, b"\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff\xff"),
        (124, b"-0000000001\0"),
        (345, b"../../\0"),
    ];
    // Links, folders, devices, attributes, long names and sparse files.
    let kinds = b"125LxgS";
    let place = draws.below(words.len() + kinds.len());
    match words.get(place) {
        Some((start, word)) => header[*start..start + word.len()].copy_from_slice(word),
        None => header[156] = kinds[place - words.len()],
    }
    header[148..156].fill(b' ');
    let sum: u32 = header.iter().copied().map(u32::from).sum();
    header[148..156].copy_from_slice(format!("{sum:06o}\0 ").as_bytes());
    tar
}

fn packed(tar: &[u8]) -> Vec<u8> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::fast());
    packed.write_all(tar).expect("into memory");
    packed.finish().expect("into memory")
}

/// Replaces or removes a value somewhere in `value`.
fn change(value: &mut Value, draws: &mut Draws) {
    match value {
        Value::Object(map) if !map.is_empty() && draws.below(5) > 0 => {
            let keys: Vec<String> = map.keys().cloned().collect();
            let key = &keys[draws.below(keys.len())];
            match draws.below(8) {
                0 => drop(map.remove(key)),
                _ => change(&mut map[key], draws),
            }
            return;
        }
        Value::Array(list) if !list.is_empty() && draws.below(5) > 0 => {
            let at = draws.below(list.len());
            match draws.below(8) {
                0 => list.push(list[at].clone()),
                1 => drop(list.remove(at)),
                _ => change(&mut list[at], draws),
            }
            return;
        }
        _ => {}
    }
    let deep = (0..200).fold(Value::Null, |inner, _| Value::Array(vec![inner]));
    let words = [
        Value::Null,
        json!(true),
        json!(-1),
        json!(0),
        json!(u64::MAX),
        json!(i64::MIN),
        json!(1e308),
        json!(5e-324),
        json!(-0.0),
        json!(""),
        json!("../x"),
        json!("bundle.json"),
        json!("x".repeat(100_000)),
        json!("\u{0}\u{1b}[2J\u{202e}"),
        json!("NaN"),
        json!([]),
        json!({}),
        json!([[1, 2], null, "a"]),
        deep,
    ];
    value.clone_from(&words[draws.below(words.len())]);
}

/// CSV table with a changed cell.
fn with_cell(table: &[u8], draws: &mut Draws) -> Vec<u8> {
    let cells = [
        "", "NaN", "inf", "-1e308", "1e999", "\"", "x,y", "\u{0}", "é",
    ];
    let text = String::from_utf8_lossy(table).into_owned();
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let at = draws.below(lines.len());
    let mut own: Vec<&str> = lines[at].split(',').collect();
    let column = draws.below(own.len());
    own[column] = cells[draws.below(cells.len())];
    let line = own.join(",");
    lines[at] = line;
    lines.join("\n").into_bytes()
}

/// Spoils one file of the bundle in the folder. Updates its size and digest in the manifest, so that the file is read.
fn spoil_file(bench: &Bench, whole: &BTreeMap<PathBuf, Vec<u8>>, draws: &mut Draws) {
    for (path, bytes) in whole {
        fs::write(path, bytes).expect("room");
    }
    let mut manifest = bench.json("bundle.json");
    let place = draws.below(whole.len());
    let (path, bytes) = whole.iter().nth(place).expect("a file");
    let read: Option<Value> = serde_json::from_slice(bytes).ok();
    if path.ends_with("bundle.json") {
        manifest.as_object_mut().expect("an object").remove("seal");
        change(&mut manifest, draws);
        let text = manifest.to_string();
        let sealed = seal::seal(&text).unwrap_or(text);
        fs::write(path, sealed).expect("room");
        return;
    }
    let changed = match read {
        Some(mut value) if draws.below(4) > 0 => {
            let is_sealed = value.get("seal").is_some();
            change(&mut value, draws);
            let text = value.to_string();
            let sealed = is_sealed.then(|| seal::reseal(&text, "2026-11-29", "spoiled").ok());
            sealed.flatten().unwrap_or(text).into_bytes()
        }
        None if path.extension().is_some_and(|own| own == "csv") && draws.below(4) > 0 => {
            with_cell(bytes, draws)
        }
        _ => spoiled(bytes, draws),
    };
    fs::write(path, changed).expect("room");
    if draws.below(2) > 0 {
        // Generated files of another version are not compared, so that states and tables are read.
        manifest["taceva"] = "0.0.0".into();
    }
    bench.relist(manifest);
}

#[test]
fn no_hostile_bundle_is_a_panic_and_each_is_answered() {
    let wanted = std::env::var("TACEVA_HOSTILE").ok();
    let wanted = wanted.map_or(BUNDLES, |number| number.parse().expect("a number"));
    let bench = Bench::new();
    let paths = files(&bench.path("")).into_iter();
    let whole: BTreeMap<PathBuf, Vec<u8>> = paths
        .map(|path| (path.clone(), fs::read(&path).expect("there")))
        .collect();
    let archive = bench.folder.path().join("b.tar.gz");
    make(&bench.request, &archive).expect("a bundle");
    let bytes = fs::read(&archive).expect("there");
    let mut tar = Vec::new();
    let mut unpacked = GzDecoder::new(&bytes[..]);
    unpacked.read_to_end(&mut tar).expect("packed");
    let (mut panics, mut refused) = (Vec::new(), 0_u64);
    for number in 0..wanted {
        let mut draws = Draws(SEED.wrapping_add(number.wrapping_mul(0x9e37_79b9_7f4a_7c15)));
        let kind = draws.below(5);
        match kind {
            0 => fs::write(&archive, spoiled(&bytes, &mut draws)).expect("room"),
            1 => fs::write(&archive, packed(&with_header(&tar, &mut draws))).expect("room"),
            2 => fs::write(&archive, packed(&spoiled(&tar, &mut draws))).expect("room"),
            _ => spoil_file(&bench, &whole, &mut draws),
        }
        let folder = bench.path("");
        let mut request = VerifyRequest::new(match kind {
            0..=2 => &archive,
            _ => &folder,
        });
        request.most = 64 << 20;
        let answered = catch_unwind(AssertUnwindSafe(|| match verify(&request) {
            Ok(found) => {
                serde_json::to_string(&found).expect("JSON");
                found.outcome() != Outcome::Verified
            }
            Err(error) => !error.to_string().is_empty(),
        }));
        match answered {
            Ok(is_refused) => refused += u64::from(is_refused),
            Err(_) => panics.push(number),
        }
    }
    assert!(panics.is_empty(), "panics of the bundles {panics:?}");
    // Some changes are of no meaning, such as the time in the header of gzip.
    assert!(refused * 2 > wanted, "{refused} of {wanted} were refused");
}

#[test]
fn no_message_on_a_packed_bundle_names_the_folder_that_it_was_unpacked_into() {
    let bench = Bench::new();
    let mut manifest = bench.json("bundle.json");
    // Generated files of another version are not compared.
    manifest["taceva"] = "0.0.0".into();
    for name in ["states/0.json", "tables/truth.csv", "tables/prediction.csv"] {
        let whole = bench.text(name);
        fs::write(bench.path(name), "{}").expect("room");
        bench.relist(manifest.clone());
        let mut tar = tar::Builder::new(Vec::new());
        for path in files(&bench.path("")) {
            let own = path.strip_prefix(bench.path("")).expect("in the bundle");
            tar.append_path_with_name(&path, own).expect("into memory");
        }
        let archive = bench.folder.path().join("forged.tar.gz");
        let tar = tar.into_inner().expect("into memory");
        fs::write(&archive, packed(&tar)).expect("room");
        let found = verify(&VerifyRequest::new(&archive)).expect("readable");
        assert_ne!(found.outcome(), Outcome::Verified, "{name}");
        let found = serde_json::to_string(&found).expect("JSON");
        assert!(found.contains(name), "{found}");
        assert!(!found.contains("unpacked-bundle"), "{found}");
        fs::write(bench.path(name), whole).expect("room");
    }
}
