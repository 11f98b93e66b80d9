//! Every defect of a plugin gives a message that names it, and the host's process survives.

use std::fs;
use std::io::{Seek, SeekFrom, Write};

use taceva_core::{Args, Deadline, ErrorKind, FrameMut, Sensor};
use taceva_host::{Image, LoadProblem, ReasonKind, Session};

use crate::fixture::{ARM, EYE, Fixture, WRIST};

const SECOND: Deadline = Deadline::after(std::time::Duration::from_secs(1));

/// Error of loading the plugin built with `macros`; `None` without a C compiler.
fn load(macros: &[&str]) -> Option<(LoadProblem, String)> {
    let fixture = Fixture::built(macros)?;
    why(&fixture)
}

fn why(fixture: &Fixture) -> Option<(LoadProblem, String)> {
    let error = fixture.loaded().expect_err("it is wrong");
    let text = error.to_string();
    assert!(text.contains("libfixture.so"), "{text}");
    Some((error.into_problem(), text))
}

macro_rules! refused {
    ($name:ident: $macros:expr, $problem:pat, $words:expr) => {
        #[test]
        fn $name() {
            let Some((problem, text)) = load(&$macros) else {
                return;
            };
            assert!(matches!(problem, $problem), "{problem:?}");
            assert!(text.contains($words), "{text}");
        }
    };
}

refused!(a_wrong_magic: ["MAGIC=0x12345678u"], LoadProblem::Magic { found: 0x1234_5678 }, "begins with 0x12345678");
refused!(a_newer_major: ["MAJOR=2"], LoadProblem::Major { found: 2 }, "version 2 of the interface, but this TacEva has 1");
refused!(a_smaller_struct: ["SIZE=40"], LoadProblem::Size { found: 40, .. }, "40 bytes, expected at least");
refused!(a_missing_symbol: ["NO_SYMBOL"], LoadProblem::Symbol(_), "no `taceva_plugin_v1`");
refused!(another_id: ["ID=\"org.example.other\""], LoadProblem::Differs { .. }, "`id`: the manifest says `org.example.fixture`, the library `org.example.other`");
refused!(another_version: ["VERSION=\"2.0.0\""], LoadProblem::Differs { .. }, "`version`: the manifest says `1.0.0`");
refused!(an_id_that_is_not_utf_8: ["ID=\"\\xff\\xfe\""], LoadProblem::Text { what: "`id`" }, "not UTF-8");
refused!(an_id_at_an_address_that_is_none: ["BAD_ID"], LoadProblem::Address { what: "`id`" }, "the address of `id` is unreadable");
refused!(a_descriptor_that_lies: ["RATE_HZ=\"60\""], LoadProblem::Differs { .. }, "rate_hz: the manifest says");
refused!(a_driver_that_is_not_there: ["NO_SENSORS"], LoadProblem::Differs { .. }, "eye`: the manifest says present");
refused!(two_drivers_of_one_key: ["DRIVERS=2"], LoadProblem::Table(_), "two of its drivers have the key");
refused!(more_drivers_than_anybody_has: ["DRIVERS=4000000000u"], LoadProblem::Table(_), "a factory of 4000000000 drivers");
refused!(a_description_that_is_not_utf_8: ["SAYS_NO_TEXT"], LoadProblem::Describe(_), "not UTF-8");
refused!(a_length_that_overflows: ["SAYS_ENDLESS"], LoadProblem::Describe(_), "more than 4096 texts or 1 MiB of text");
refused!(an_init_that_fails: ["INIT_FAILS"], LoadProblem::Init(_), "its `init` failed: nothing is there");
refused!(a_factory_that_is_null: ["NO_FACTORY"], LoadProblem::Lacks { what: "factory" }, "`factory` is NULL");
refused!(an_open_that_is_null: ["NO_OPEN"], LoadProblem::Lacks { what: "open" }, "`open` is NULL");
refused!(a_table_that_is_misaligned: ["MISALIGNED"], LoadProblem::Table(_), "misaligned");

#[test]
fn a_library_that_looks_for_another_beside_itself_is_told_that_it_has_no_folder() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let Some((problem, text)) = why(&fixture.with_neighbour()) else {
        return;
    };
    assert!(
        matches!(problem, LoadProblem::BesideItself { .. }),
        "{problem:?}"
    );
    assert!(
        text.contains("libneighbour.so") && text.contains("its run path is `$ORIGIN`"),
        "{text}"
    );
}

/// Error of opening the sensor of the plugin built with `macros`; `None` without a C compiler.
fn open(macros: &[&str]) -> Option<(ErrorKind, String)> {
    let fixture = Fixture::built(macros)?;
    let error = fixture.session().sensor(&EYE, &Args::default()).map(|_| ());
    let error = error.expect_err("it is wrong");
    Some((error.kind(), error.to_string()))
}

macro_rules! not_opened {
    ($name:ident: $macros:expr, $kind:ident, $words:expr) => {
        #[test]
        fn $name() {
            let Some((kind, text)) = open(&$macros) else {
                return;
            };
            assert_eq!(kind, ErrorKind::$kind, "{text}");
            assert!(text.contains($words), "{text}");
        }
    };
}

not_opened!(a_function_pointer_that_is_null: ["NO_CAPTURE"], Unsupported, "`capture` is NULL");
not_opened!(a_close_that_is_null: ["NO_CLOSE"], Unsupported, "`close` is NULL");
not_opened!(a_table_that_ends_too_early: ["TABLE_SIZE=32"], Unsupported, "`capture` is NULL");
not_opened!(a_table_without_a_size: ["TABLE_SIZE=0"], Abi, "the size is below 8 bytes");
not_opened!(a_handle_that_is_null: ["NULL_HANDLE"], Abi, "its handle is NULL");
not_opened!(a_table_that_is_null: ["NULL_TABLE"], Abi, "the table is NULL");
not_opened!(an_ability_that_is_promised_and_absent: ["NO_EXTENSIONS"], Abi, "taceva.sensor.lighting/1");

/// Error of a capture by the plugin built with `macros`. A second call gives the same error. `None` without a C compiler.
fn capture(macros: &[&str]) -> Option<(ErrorKind, String)> {
    let fixture = Fixture::built(macros)?;
    let mut eye = fixture
        .session()
        .open_sensor(&EYE, &Args::default())
        .expect("opens");
    eye.start(SECOND).expect("starts");
    let info = eye.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    let mut ask = || {
        let into = FrameMut::new(info, &mut pixels).expect("fits");
        eye.capture(into, SECOND).expect_err("no frame")
    };
    let error = ask();
    assert_eq!(ask().kind(), error.kind());
    Some((error.kind(), error.to_string()))
}

macro_rules! no_frame {
    ($name:ident: $macros:expr, $kind:ident, $words:expr) => {
        #[test]
        fn $name() {
            let Some((kind, text)) = capture(&$macros) else {
                return;
            };
            assert_eq!(kind, ErrorKind::$kind, "{text}");
            assert!(text.contains($words), "{text}");
        }
    };
}

no_frame!(a_frame_larger_than_declared: ["TOLD_WIDTH=4000000000u"], Protocol, "4000000000×6 rgb8, expected 8×6 rgb8");
no_frame!(a_frame_whose_length_overflows: ["TOLD_LENGTH=UINT64_MAX"], Protocol, "in 18446744073709551615 bytes, expected 144");
no_frame!(a_frame_of_an_unknown_format: ["FORMAT=77"], Unsupported, "pixel format 77");
no_frame!(a_frame_without_pixels: ["NO_DATA"], Protocol, "data pointer is NULL");
no_frame!(a_frame_elsewhere_that_is_not_lent: ["NO_RELEASE"], Abi, "has no `release`");
no_frame!(a_status_that_is_none: ["STATUS=5"], Abi, "unknown status 5");
no_frame!(a_fault_of_the_device: ["STATUS=TACEVA_DEVICE_FAULT"], DeviceFault, "as it was told to");

#[test]
fn after_a_panic_the_handle_is_dead_and_every_other_lives() {
    let Some(fixture) = Fixture::built(&["STATUS=TACEVA_PANICKED"]) else {
        return;
    };
    let session = fixture.session();
    let mut eye = session.open_sensor(&EYE, &Args::default()).expect("opens");
    eye.start(SECOND).expect("starts");
    let info = eye.frame_info();
    let mut pixels = vec![0; info.byte_len().expect("small")];
    let into = FrameMut::new(info, &mut pixels).expect("fits");
    let error = eye.capture(into, SECOND).expect_err("panicked");
    assert_eq!(error.kind(), ErrorKind::Panicked);
    let error = eye.stop().expect_err("dead");
    assert_eq!(error.kind(), ErrorKind::Panicked);
    assert!(error.to_string().contains("no longer called"), "{error}");
    let mut other = session.open_sensor(&EYE, &Args::default()).expect("opens");
    other.start(SECOND).expect("lives");
}

#[test]
fn numbers_that_are_none_are_faults_of_the_device() {
    let Some(fixture) = Fixture::built(&["FORCE=NAN", "BAD_POSE"]) else {
        return;
    };
    let session = fixture.session();
    let mut wrist = session.force(&WRIST, &Args::default()).expect("opens");
    wrist.start(SECOND).expect("starts");
    let error = wrist.read(SECOND).expect_err("NaN");
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
    assert!(error.to_string().contains("`Fz` is NaN"), "{error}");
    let mut arm = session.robot(&ARM, &Args::default()).expect("opens");
    let error = arm.pose(SECOND).expect_err("NaN");
    assert_eq!(error.kind(), ErrorKind::DeviceFault);
}

#[test]
fn a_truncated_file_as_library() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let whole = fs::read(fixture.library()).expect("there");
    for part in [0, 1, 64, 200, whole.len() / 2] {
        fs::write(fixture.library(), &whole[..part]).expect("written");
        let (problem, text) = why(&fixture).expect("built");
        assert!(
            matches!(problem, LoadProblem::NotALibrary | LoadProblem::CutOff),
            "{part}: {text}"
        );
    }
}

#[test]
fn a_wrong_file_as_library() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    fs::write(fixture.library(), "not a library ".repeat(100)).expect("written");
    let (problem, text) = why(&fixture).expect("built");
    assert!(matches!(problem, LoadProblem::NotALibrary), "{text}");
}

#[test]
fn a_wrong_digest() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let promised = format!("libfixture.so\", sha256 = \"{}\"", "00".repeat(32));
    let fixture = fixture.with_manifest("libfixture.so\"", &promised);
    let (problem, text) = why(&fixture).expect("built");
    assert!(matches!(problem, LoadProblem::Digest { .. }), "{text}");
    let plugin = fixture.plugin();
    let mut library = plugin.library().expect("a library").clone();
    library.sha256 = None;
    let image = Image::read(&plugin.folder, &library).expect("a library");
    let promised = format!("libfixture.so\", sha256 = \"{}\"", image.digest());
    let fixture = fixture.with_manifest("libfixture.so\"", &promised);
    assert!(fixture.loaded().is_ok(), "the right digest");
}

#[test]
fn a_file_that_is_swapped_after_it_was_hashed() {
    let Some(fixture) = Fixture::built(&[]) else {
        return;
    };
    let plugin = fixture.plugin();
    let image =
        Image::read(&plugin.folder, plugin.library().expect("a library")).expect("a library");
    let mut file = fs::OpenOptions::new()
        .write(true)
        .open(fixture.library())
        .expect("ours");
    file.seek(SeekFrom::Start(0)).expect("a file");
    file.write_all(&[0; 4096]).expect("written in place");
    let library = taceva_host::Library::load(&image, &plugin.manifest, Box::new(|_, _, _| {}));
    assert!(library.is_ok(), "what was hashed is what is loaded");
}

/// Reason of the rejection of the manifest with `old` replaced by `new`; `None` without a C compiler.
fn not_listed(old: &str, new: &str) -> Option<(ReasonKind, String)> {
    let fixture = Fixture::built(&[])?.with_manifest(old, new);
    let plugins = fixture.found();
    let rejection = plugins.rejections.first().expect("refused");
    let trail = plugins.get("org.example.fixture").expect_err("absent");
    let text = rejection.to_string();
    assert!(
        trail.to_string().contains(&text),
        "the trail names it: {trail}"
    );
    Some((rejection.reason.kind(), text))
}

macro_rules! not_listed {
    ($name:ident: $old:expr => $new:expr, $kind:ident, $words:expr) => {
        #[test]
        fn $name() {
            let Some((kind, text)) = not_listed($old, $new) else {
                return;
            };
            assert_eq!(kind, ReasonKind::$kind, "{text}");
            assert!(text.contains($words), "{text}");
        }
    };
}

not_listed!(a_manifest_with_an_unknown_key: "license" => "licence", Manifest, "did you mean `license`?");
not_listed!(a_manifest_with_a_wrong_type: "rate_hz = 1000" => "rate_hz = true", Manifest, "line 16, column 11: invalid type");
not_listed!(a_path_with_two_dots: "libfixture.so" => "../libfixture.so", Manifest, "without `..`");
not_listed!(a_folder_instead_of_a_file: "libfixture.so" => ".", Manifest, "without `..`");
not_listed!(two_tables_that_claim_one_key: "key = \"arm\"" => "key = \"eye\"", Manifest, "two tables have the key `eye`");
not_listed!(a_manifest_for_a_newer_interface: "major = 1" => "major = 2", Abi, "version 2.0 of the interface");
